#include "embree_peer.h"
#include "embree_queries.h"
#include "embree_tracer.h"

#include <stdexcept>

namespace peregrine::bench {
namespace {

[[noreturn]] void fail() {
    throw std::runtime_error("this build has no Embree: install libembree-dev and configure again");
}

} // namespace

bool has_embree() {
    return false;
}

PeerBuild build_with_embree(std::span<const geometry::Triangle>, uint32_t, const std::string&) {
    fail();
}

std::unique_ptr<PeerDeforming> deform_with_embree(std::span<const uint32_t>,
                                                  std::span<const math::Vec3>, uint32_t, bool) {
    fail();
}

std::unique_ptr<Tracer> make_embree_tracer(const std::string&, std::span<const geometry::Triangle>,
                                           uint32_t) {
    fail();
}

std::unique_ptr<QueryContestant> make_embree_queries(const Level&, bool) {
    fail();
}

} // namespace peregrine::bench

#include "embree_peer.h"

#include <stdexcept>

namespace peregrine::bench {

bool has_embree() {
    return false;
}

PeerBuild build_with_embree(std::span<const geometry::Triangle>, uint32_t) {
    throw std::runtime_error("this build has no Embree: install libembree-dev and configure again");
}

} // namespace peregrine::bench

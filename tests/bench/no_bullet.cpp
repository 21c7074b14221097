#include "bullet_queries.h"

#include <stdexcept>

namespace peregrine::bench {

std::unique_ptr<QueryContestant> make_bullet_queries(const Level&) {
    throw std::runtime_error("this build has no Bullet: install libbullet-dev and configure again");
}

} // namespace peregrine::bench

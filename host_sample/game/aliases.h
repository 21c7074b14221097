#pragma once

// Short names for the rules of the game.
namespace peregrine::gameplay {}
namespace peregrine::three_cores {}

namespace host {

namespace gameplay = peregrine::gameplay;
namespace three_cores = peregrine::three_cores;

} // namespace host

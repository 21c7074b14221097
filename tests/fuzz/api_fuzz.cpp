// Random calls of every function of the header, with good and bad arguments, from a seed:
//     api_fuzz [first seed] [seeds] [calls each]
// Arrays are exactly as long as they must be, so that a sanitizer sees any byte too far. What is
// checked besides: a known result, a sentence after an error, no internal error, and that closest
// hit and any hit agree.
#include "fuzzer.h"

int main(int argc, char** argv) {
    const uint64_t first = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 1;
    const uint64_t seeds = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 4;
    const uint64_t calls = argc > 3 ? std::strtoull(argv[3], nullptr, 10) : 3000;
    for (uint64_t seed = first; seed < first + seeds; ++seed) {
        std::printf("seed %llu\n", static_cast<unsigned long long>(seed));
        std::fflush(stdout);
        peregrine::test::Fuzzer fuzzer(seed);
        for (uint64_t i = 0; i < calls; ++i) fuzzer.step();
    }
    return 0;
}

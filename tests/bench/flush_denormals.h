#pragma once

#if defined(__SSE__)
#include <xmmintrin.h>
#endif

namespace peregrine::bench {

// Embree asks for denormals to be flushed; the header of ours asks for the default.
class FlushDenormals {
public:
#if defined(__SSE__)
    FlushDenormals() : before_(_mm_getcsr()) { _mm_setcsr(before_ | kFlushToZero | kAreZero); }
    ~FlushDenormals() { _mm_setcsr(before_); }

private:
    static constexpr unsigned kFlushToZero = 0x8000, kAreZero = 0x0040;
    unsigned before_;
#else
    FlushDenormals() {}
    ~FlushDenormals() {}
#endif
};

} // namespace peregrine::bench

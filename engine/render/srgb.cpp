#include "render/srgb.h"

#include <cmath>
#include <limits>

namespace peregrine::render {
namespace {

double to_linear(double encoded) {
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

float smallest_float_from(double value) {
    const auto rounded = float(value);
    return double(rounded) >= value
               ? rounded
               : std::nextafter(rounded, std::numeric_limits<float>::infinity());
}

} // namespace

const SrgbEncoder& SrgbEncoder::get() {
    static const SrgbEncoder encoder;
    return encoder;
}

SrgbEncoder::SrgbEncoder() {
    threshold_[0] = 0;
    for (int code = 1; code < 256; ++code)
        threshold_[code] = smallest_float_from(to_linear((code - 0.5) / 255.0));
    threshold_[256] = std::numeric_limits<float>::infinity();
    uint32_t code = 0;
    for (uint32_t cell = 0; cell <= kCells; ++cell) {
        while (threshold_[code + 1] <= float(cell) / float(kCells)) ++code;
        first_code_[cell] = uint8_t(code);
    }
}

} // namespace peregrine::render

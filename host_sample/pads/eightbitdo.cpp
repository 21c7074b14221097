#include "eightbitdo.h"

namespace host::pads {

bool eightbitdo_has_xbox_letters(uint16_t product) {
    return product == 0x6012; // Ultimate 2
}

Mapping eightbitdo_mapping(const ReportDescriptor& descriptor, uint16_t product) {
    const bool xbox = eightbitdo_has_xbox_letters(product);
    return default_mapping(descriptor, xbox ? ButtonOrder::android : ButtonOrder::nintendo);
}

std::vector<uint8_t> eightbitdo_output(Rumble rumble) {
    return {eightbitdo_output_id, to_byte(rumble.strong), to_byte(rumble.weak), 0, 0};
}

} // namespace host::pads

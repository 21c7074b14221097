// Reports are written as the documents print them: hexadecimal, "..N" for N zeros.
#pragma once

#include <cstdint>
#include <sstream>
#include <string>
#include <vector>

#include "pads/state.h"

namespace host::pads::test {

inline std::vector<uint8_t> bytes(const std::string& text) {
    std::vector<uint8_t> result;
    std::istringstream words(text);
    for (std::string word; words >> word;) {
        if (word.starts_with(".."))
            result.insert(result.end(), std::stoul(word.substr(2)), uint8_t{0});
        else
            result.push_back(static_cast<uint8_t>(std::stoul(word, nullptr, 16)));
    }
    return result;
}

template <class... B>
Buttons buttons(B... down) {
    Buttons result;
    (result.set(down), ...);
    return result;
}

} // namespace host::pads::test

#pragma once

#include <cctype>
#include <string>

namespace host::game {

// Of the cause that an error names: "the picture ..." to "The picture ....".
inline std::string sentence(std::string cause) {
    if (!cause.empty())
        cause[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(cause[0])));
    return cause + ".";
}

} // namespace host::game

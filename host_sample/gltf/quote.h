#pragma once

#include <string>
#include <string_view>

namespace host::gltf {

// A text of the file as part of a sentence: one line, not too long, whole characters of UTF-8.
inline std::string quote(std::string_view text, size_t longest = 80) {
    const bool whole = text.size() <= longest;
    while (!whole && longest > 0 && (static_cast<unsigned char>(text[longest]) & 0xc0) == 0x80)
        --longest;
    std::string quoted(text.substr(0, longest));
    for (char& c : quoted)
        if (static_cast<unsigned char>(c) < ' ' || c == '\x7f') c = ' ';
    return whole ? quoted : quoted + "...";
}

} // namespace host::gltf

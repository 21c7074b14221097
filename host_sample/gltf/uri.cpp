#include "uri.h"

#include <algorithm>
#include <cstdint>

#include "../error.h"
#include "quote.h"

namespace host::gltf {

namespace {

constexpr std::string_view data_scheme = "data:";

char to_lower(char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

bool equal_ignoring_case(std::string_view a, std::string_view b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](char x, char y) { return to_lower(x) == to_lower(y); });
}

bool is_space(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f';
}

// -1: not a digit.
int hex_digit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    const char lower = to_lower(c);
    return lower >= 'a' && lower <= 'f' ? lower - 'a' + 10 : -1;
}

// The byte that the % at `i` stands for; -1: itself.
int escaped_byte(std::string_view text, size_t i) {
    if (i + 2 >= text.size()) return -1;
    const int high = hex_digit(text[i + 1]), low = hex_digit(text[i + 2]);
    return high < 0 || low < 0 ? -1 : 16 * high + low;
}

int base64_digit(char c) {
    if (c >= 'A' && c <= 'Z') return c - 'A';
    if (c >= 'a' && c <= 'z') return c - 'a' + 26;
    if (c >= '0' && c <= '9') return c - '0' + 52;
    if (c == '+') return 62;
    return c == '/' ? 63 : -1;
}

std::string describe(char c) {
    return c > ' ' && c < '\x7f' ? std::string("the character '") + c + "'"
                                 : "a character that is not ASCII";
}

// The padding at the end may be missing, and white space stand anywhere, as browsers take it.
std::string decode_base64(std::string text) {
    std::erase_if(text, is_space);
    for (int i = 0; i < 2 && !text.empty() && text.back() == '='; ++i) text.pop_back();
    if (text.size() % 4 == 1) throw InputError("its base64 ends within a byte");
    std::string bytes;
    bytes.reserve(text.size() / 4 * 3 + 2);
    uint32_t bits = 0;
    int count = 0;
    for (const char c : text) {
        const int digit = base64_digit(c);
        if (digit < 0) throw InputError("its base64 holds " + describe(c));
        bits = bits << 6 | static_cast<uint32_t>(digit);
        count += 6;
        if (count < 8) continue;
        count -= 8;
        bytes.push_back(static_cast<char>(bits >> count & 0xffu));
    }
    return bytes;
}

// Whether the last of the parameters in front of the comma is "base64".
bool says_base64(std::string_view header) {
    const size_t last = header.rfind(';');
    if (last == std::string_view::npos) return false;
    std::string_view word = header.substr(last + 1);
    while (!word.empty() && word.front() == ' ') word.remove_prefix(1);
    while (!word.empty() && word.back() == ' ') word.remove_suffix(1);
    return equal_ignoring_case(word, "base64");
}

} // namespace

bool is_data_uri(std::string_view uri) {
    return equal_ignoring_case(uri.substr(0, data_scheme.size()), data_scheme);
}

std::string decode_data_uri(std::string_view uri) {
    const std::string_view content = uri.substr(data_scheme.size());
    const size_t comma = content.find(',');
    if (comma == std::string_view::npos)
        throw InputError("its data URI has no comma in front of the data");
    std::string bytes = decode_percent(content.substr(comma + 1));
    return says_base64(content.substr(0, comma)) ? decode_base64(std::move(bytes)) : bytes;
}

std::string decode_percent(std::string_view text) {
    std::string decoded;
    decoded.reserve(text.size());
    for (size_t i = 0; i < text.size(); ++i) {
        const int byte = text[i] == '%' ? escaped_byte(text, i) : -1;
        decoded.push_back(byte < 0 ? text[i] : static_cast<char>(byte));
        if (byte >= 0) i += 2;
    }
    return decoded;
}

bool has_bare_percent(std::string_view text) {
    for (size_t i = 0; i < text.size(); ++i)
        if (text[i] == '%' && escaped_byte(text, i) < 0) return true;
    return false;
}

std::string describe_uri(std::string_view uri) {
    if (!is_data_uri(uri)) return quote(uri);
    const std::string_view content = uri.substr(data_scheme.size());
    const std::string_view type = content.substr(0, content.find_first_of(",;"));
    return type.empty() ? "a data URI" : "a data URI of type " + quote(type, 40);
}

} // namespace host::gltf

#pragma once

#include <string>
#include <string_view>

namespace host::gltf {

bool is_data_uri(std::string_view uri);

// The bytes of a data URI of any media type, as base64 or percent-encoded (RFC 2397). Throws
// InputError.
std::string decode_data_uri(std::string_view uri);

// Undoes percent-encoding (RFC 3986, 2.1). A % that no two hexadecimal digits follow stays.
std::string decode_percent(std::string_view text);
bool has_bare_percent(std::string_view text);

// How a sentence names what the URI names.
std::string describe_uri(std::string_view uri);

} // namespace host::gltf

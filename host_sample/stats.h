#pragma once

#include <string>

#include "session.h"

namespace host {

// The measurements of a session as JSON.
std::string describe_stats(const Session& session);

// Throws InputError if the file cannot be written.
void write_stats(const std::string& path, const Session& session);

} // namespace host

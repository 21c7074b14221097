#pragma once

#include <stdexcept>
#include <string>

namespace host {

// What the user gave cannot be used (a file, an option, a library): the text is a whole sentence
// for them.
class InputError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

// The engine refused or failed.
class EngineError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

} // namespace host

// Errors shown to users. Every one says what is wrong, what was expected and what to do (CONTRIBUTING.md).
#pragma once

#include <functional>
#include <optional>
#include <stdexcept>
#include <string>

namespace quasilux {

/// A place in an input file; line and column count from 1, 0 where unknown.
struct SourceLocation {
    std::string file;
    int line = 0;
    int column = 0;

    /// "file:line:column", leaving out what is unknown.
    std::string text() const;
};

/// Of bounded length, without what a terminal would obey: input is quoted in messages as it is.
std::string asMessage(std::string text);

/// Input that the user can mend (scene, mesh, option, output folder). The program ends with exit code 2.
class InputError : public std::runtime_error {
public:
    explicit InputError(const std::string& message) : std::runtime_error(asMessage(message)) {}
    /// The message becomes "file:line:column: message".
    InputError(const SourceLocation& where, const std::string& message)
        : InputError(where.file.empty() ? message : where.text() + ": " + message) {}
};

/// The device or its runtime failed; names the kernel or buffer, its bytes and the device. Exit code 1.
class DeviceError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// What an InputError, a DeviceError or bad_alloc that `action` throws says, as where memory does not suffice; nothing
/// if it succeeds.
std::optional<std::string> refusal(const std::function<void()>& action);
/// The same of any exception.
std::optional<std::string> failureOf(const std::function<void()>& action);

/// What bad_alloc, which knows no words, means to users.
inline constexpr const char* memoryExhausted = "the computer's memory is exhausted, try a smaller image or scene";

} // namespace quasilux

// How a command ends: its exit code, and what was thrown as a message.
#pragma once

#include <functional>
#include <string>

namespace quasilux {

constexpr int exitFailed = 1, exitBadInput = 2;

struct CommandEnd {
    int exitCode = 0;
    std::string error; ///< what was thrown; empty: nothing
};

/// Runs it; exceptions become messages and the exit codes of docs/reference/command-line.md.
CommandEnd endOf(const std::function<int()>& command);

/// The exit code of a command or of a part of it, once its standard output is written: what is to come may be ended by
/// a signal at once. Results that nobody gets are a failure; one that is named here is not lost at the end without a
/// word.
int withResultsOut(int exitCode);

} // namespace quasilux

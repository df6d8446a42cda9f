// Runs the built program from outside, in a folder of its own.
#pragma once

#include "support/read_text.h"
#include "util/temporary_folder.h"

#include <csignal>
#include <filesystem>
#include <functional>
#include <gtest/gtest.h>
#include <string>
#include <utility>
#include <vector>

namespace quasilux {

struct Outcome {
    int exitCode = -1; ///< -1: ended by a signal
    std::string output, errors;
};

/// The folder holds one small scene, scene.xml.
class CommandLineTest : public testing::Test {
protected:
    CommandLineTest();

    /// `interruptAfter` seconds, if above 0, the program gets a Ctrl-C, or another signal.
    Outcome run(const std::vector<std::string>& arguments, unsigned interruptAfter = 0, int signal = SIGINT) const;
    using Variables = std::vector<std::pair<std::string, std::string>>;
    /// `library` stands before all others (tests/shims), with these variables of the environment.
    Outcome runWith(const std::string& library, const std::vector<std::string>& arguments,
                    const Variables& variables) const;
    /// The first step of that: end() is the other.
    pid_t startWith(const std::string& library, const std::vector<std::string>& arguments,
                    const Variables& variables) const;
    /// It gets the signal once `isTime`, which is asked every few milliseconds.
    Outcome runUntil(const std::vector<std::string>& arguments, const std::function<bool()>& isTime, int signal) const;
    /// The same in two steps: what runs meanwhile, and how it ends.
    pid_t start(std::vector<std::string> arguments) const;
    Outcome end(pid_t process) const;
    /// One that has not ended by then is killed, so that what hangs fails.
    Outcome endWithin(double seconds, pid_t process) const;
    /// Runs it on a terminal of its own; all that it writes there.
    Outcome runOnTerminal(std::vector<std::string> arguments) const;

    /// Bad input: exit code 2, a message, returned, that holds `message`, nothing on stdout, and no file that was not
    /// there before.
    std::string expectRefused(const std::vector<std::string>& arguments, const std::string& message) const;

    TemporaryFolder temporary;
    std::filesystem::path root = temporary.path(), folder = root / "work";

    std::vector<std::string> filesInFolder() const;
};

} // namespace quasilux

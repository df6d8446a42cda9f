#include "support/program_runner.h"

#include "util/stopwatch.h"

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <fstream>
#include <gmock/gmock.h>
#include <pty.h>
#include <sstream>
#include <sys/wait.h>
#include <unistd.h>

namespace quasilux {

namespace fs = std::filesystem;
using testing::HasSubstr;

namespace {

void redirect(const fs::path& file, int descriptor) {
    const int target = open(file.c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0600);
    if (target < 0 || dup2(target, descriptor) < 0) _exit(122);
}

// In a process that was made for it.
[[noreturn]] void becomeProgram(std::vector<std::string>& arguments, const fs::path& folder) {
    if (chdir(folder.c_str()) != 0) _exit(120);
    arguments.insert(arguments.begin(), QUASILUX_PROGRAM);
    std::vector<char*> argv;
    for (auto& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    execv(argv[0], argv.data());
    _exit(121);
}

} // namespace

CommandLineTest::CommandLineTest() {
    fs::create_directory(folder);
    std::ofstream(folder / "scene.xml") << R"(<scene version="3.0.0">
  <sensor type="perspective">
    <float name="fov" value="40"/>
    <film type="hdrfilm"><integer name="width" value="4"/><integer name="height" value="4"/></film>
  </sensor>
  <shape type="rectangle"><emitter type="area"><rgb name="radiance" value="1"/></emitter>
    <transform name="to_world"><rotate y="1" angle="180"/><translate z="8"/></transform></shape>
</scene>
)";
}

Outcome CommandLineTest::run(const std::vector<std::string>& arguments, unsigned interruptAfter, int signal) const {
    const pid_t child = start(arguments);
    if (interruptAfter > 0) {
        sleep(interruptAfter);
        kill(child, signal);
    }
    return end(child);
}

Outcome CommandLineTest::runWith(const std::string& library, const std::vector<std::string>& arguments,
                                 const Variables& variables) const {
    return end(startWith(library, arguments, variables));
}

pid_t CommandLineTest::startWith(const std::string& library, const std::vector<std::string>& arguments,
                                 const Variables& variables) const {
    Variables all = variables;
    all.emplace_back("LD_PRELOAD", library);
    all.emplace_back("ASAN_OPTIONS", "verify_asan_link_order=0");
    for (const auto& [name, value] : all) setenv(name.c_str(), value.c_str(), 1);
    const pid_t child = start(arguments);
    for (const auto& [name, value] : all) unsetenv(name.c_str());
    return child;
}

Outcome CommandLineTest::runUntil(const std::vector<std::string>& arguments, const std::function<bool()>& isTime,
                                  int signal) const {
    const pid_t child = start(arguments);
    const Stopwatch watch;
    while (!isTime() && watch.seconds() < 120) usleep(20000);
    kill(child, signal);
    return end(child);
}

pid_t CommandLineTest::start(std::vector<std::string> arguments) const {
    const pid_t child = fork();
    if (child != 0) return child;
    redirect(root / "stdout", STDOUT_FILENO);
    redirect(root / "stderr", STDERR_FILENO);
    becomeProgram(arguments, folder);
}

Outcome CommandLineTest::end(pid_t process) const {
    int status = 0;
    waitpid(process, &status, 0);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, readText(root / "stdout"), readText(root / "stderr")};
}

Outcome CommandLineTest::endWithin(double seconds, pid_t process) const {
    const Stopwatch watch;
    siginfo_t ended{};
    while (waitid(P_PID, static_cast<id_t>(process), &ended, WEXITED | WNOHANG | WNOWAIT) == 0 && ended.si_pid == 0) {
        if (watch.seconds() > seconds) kill(process, SIGKILL);
        usleep(20000);
    }
    return end(process);
}

Outcome CommandLineTest::runOnTerminal(std::vector<std::string> arguments) const {
    int terminal = -1;
    const pid_t child = forkpty(&terminal, nullptr, nullptr, nullptr);
    if (child == 0) becomeProgram(arguments, folder);
    Outcome outcome;
    std::array<char, 4096> piece{};
    for (ssize_t count = 0; (count = read(terminal, piece.data(), piece.size())) > 0;)
        outcome.output.append(piece.data(), static_cast<size_t>(count));
    close(terminal);
    int status = 0;
    waitpid(child, &status, 0);
    outcome.exitCode = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    return outcome;
}

std::vector<std::string> CommandLineTest::filesInFolder() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
}

std::string CommandLineTest::expectRefused(const std::vector<std::string>& arguments,
                                           const std::string& message) const {
    const auto before = filesInFolder();
    const Outcome outcome = run(arguments);
    SCOPED_TRACE(testing::PrintToString(arguments));
    EXPECT_EQ(outcome.exitCode, 2);
    EXPECT_THAT(outcome.errors, HasSubstr("quasilux: error: "));
    EXPECT_THAT(outcome.errors, HasSubstr(message));
    EXPECT_EQ(outcome.output, "");
    EXPECT_EQ(filesInFolder(), before);
    return outcome.errors;
}

} // namespace quasilux

#include "view/browser.h"

#include <array>
#include <cstdlib>
#include <fcntl.h>
#include <fmt/format.h>
#include <fstream>
#include <spawn.h>
#include <unistd.h>

namespace quasilux {

namespace {

bool isSet(const char* variable) {
    const char* value = std::getenv(variable);
    return value != nullptr && *value != 0;
}

// Says nothing on our terminal.
void start(std::string program, std::string argument) {
    std::array<char*, 3> arguments{program.data(), argument.data(), nullptr};
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    for (const int stream : {STDOUT_FILENO, STDERR_FILENO})
        posix_spawn_file_actions_addopen(&actions, stream, "/dev/null", O_WRONLY, 0);
    pid_t process = 0;
    posix_spawnp(&process, program.c_str(), &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
}

} // namespace

bool hasDesktop() { return isSet("DISPLAY") || isSet("WAYLAND_DISPLAY"); }

OpenedPage::OpenedPage(const std::string& address) {
    const auto file = folder_.path() / "quasilux.html";
    std::ofstream(file) << fmt::format("<!doctype html><meta charset=\"utf-8\"><title>quasilux</title><meta "
                                       "http-equiv=\"refresh\" content=\"0;url={0}\">"
                                       "<a href=\"{0}\">{0}</a>\n",
                                       address);
    start("xdg-open", file.string());
}

} // namespace quasilux

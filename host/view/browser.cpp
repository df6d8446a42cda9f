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

// Apart from our terminal: it says nothing there, and Ctrl-C is not for it.
void start(std::string program, std::string argument) {
    std::array<char*, 3> arguments{program.data(), argument.data(), nullptr};
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        posix_spawn_file_actions_addopen(&actions, stream, "/dev/null", O_RDWR, 0);
    posix_spawnattr_t apart;
    posix_spawnattr_init(&apart);
    posix_spawnattr_setflags(&apart, POSIX_SPAWN_SETSID);
    pid_t process = 0;
    posix_spawnp(&process, program.c_str(), &actions, &apart, arguments.data(), environ);
    posix_spawnattr_destroy(&apart);
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

#include "util/messages.h"

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fmt/format.h>
#include <unistd.h>

namespace quasilux {

namespace {

constexpr int red = 31, yellow = 33; // ECMA-48, select graphic rendition

bool isColoured() {
    const char *none = std::getenv("NO_COLOR"), *terminal = std::getenv("TERM");
    const bool isWanted = none == nullptr || *none == '\0';
    return isWanted && terminal != nullptr && std::strcmp(terminal, "dumb") != 0 && isatty(STDERR_FILENO) == 1;
}

void print(const char* kind, int colour, const std::string& message) {
    const std::string start =
        isColoured() ? fmt::format("\033[1;{}m{}:\033[0m", colour, kind) : fmt::format("{}:", kind);
    printNote(start + " " + message);
}

} // namespace

void printTo(std::FILE* stream, const std::string& text) {
    std::fputs(text.c_str(), stream);
    std::fflush(stream);
    std::clearerr(stream);
}

void printNote(const std::string& message) { printTo(stderr, "quasilux: " + message + "\n"); }

void printError(const std::string& message) { print("error", red, message); }

void printWarning(const std::string& message) { print("warning", yellow, message); }

} // namespace quasilux

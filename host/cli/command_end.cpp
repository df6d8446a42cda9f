#include "cli/command_end.h"

#include "util/error.h"

#include <cerrno>
#include <cstdio>
#include <new>
#include <system_error>

namespace quasilux {

CommandEnd endOf(const std::function<int()>& command) {
    try {
        return {command(), ""};
    } catch (const InputError& error) {
        return {exitBadInput, error.what()};
    } catch (const std::bad_alloc&) {
        return {exitFailed, memoryExhausted};
    } catch (const std::exception& error) {
        return {exitFailed, error.what()};
    }
}

int withResultsOut(int exitCode) {
    if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return exitCode;
    const int why = errno;
    throw std::system_error(why, std::generic_category(), "cannot write to the standard output");
}

} // namespace quasilux

#include "cli/command_end.h"

#include "util/error.h"

#include <new>

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

} // namespace quasilux

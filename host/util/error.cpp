#include "util/error.h"

#include <new>

namespace quasilux {

std::string SourceLocation::text() const {
    std::string out = file;
    if (line > 0) {
        out += ':' + std::to_string(line);
        if (column > 0) out += ':' + std::to_string(column);
    }
    return out;
}

std::optional<std::string> refusal(const std::function<void()>& action) {
    try {
        action();
    } catch (const InputError& error) {
        return error.what();
    } catch (const DeviceError& error) {
        return error.what();
    } catch (const std::bad_alloc&) {
        return memoryExhausted;
    }
    return std::nullopt;
}

std::optional<std::string> failureOf(const std::function<void()>& action) {
    try {
        return refusal(action);
    } catch (const std::exception& error) {
        return error.what();
    }
}

} // namespace quasilux

#include "util/error.h"

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
    }
    return std::nullopt;
}

} // namespace quasilux

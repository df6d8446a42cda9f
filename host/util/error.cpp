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

std::string asMessage(std::string text) {
    constexpr size_t longest = 8000;
    if (text.size() > longest) text = text.substr(0, longest / 2) + " … " + text.substr(text.size() - longest / 2);
    for (char& letter : text)
        if (const auto code = static_cast<unsigned char>(letter);
            (code < 0x20 && letter != '\n' && letter != '\t') || code == 0x7f)
            letter = '?';
    return text;
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

#include "cli/written_files.h"

#include "util/error.h"
#include "util/messages.h"

namespace quasilux {

void WrittenFiles::write(const std::string& path, const std::function<void()>& writer) {
    if (path.empty()) return;
    attempt([&] {
        writer();
        paths_.push_back(path);
    });
}

void WrittenFiles::attempt(const std::function<void()>& action) {
    try {
        action();
    } catch (...) {
        addFailure(std::current_exception());
    }
}

void WrittenFiles::rethrow() const {
    if (failures_.empty()) return;
    for (size_t k = 1; k < failures_.size(); ++k)
        if (const auto why = failureOf([&] { std::rethrow_exception(failures_[k]); })) printError(*why);
    std::rethrow_exception(failures_.front());
}

} // namespace quasilux

#include "cli/bench_attempt.h"

#include "cli/interrupt.h"

#include <new>

namespace quasilux {

void Attempts::run(const std::string& what, const std::function<void()>& step) {
    if (interruptFlag()) return;
    try {
        step();
    } catch (const std::exception& error) {
        if (interruptFlag()) return;
        const bool isMemory = dynamic_cast<const std::bad_alloc*>(&error);
        failures_.push_back({what, isMemory ? "the computer's memory is exhausted" : error.what()});
        if (!first_) first_ = std::current_exception();
    }
}

void Attempts::rethrowFirst() const {
    if (first_) std::rethrow_exception(first_);
}

} // namespace quasilux

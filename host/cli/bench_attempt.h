// One step of a benchmark may fail without taking what the others measured with it.
#pragma once

#include "bench/bench_report.h"

#include <exception>
#include <functional>

namespace quasilux {

/// Runs the steps of a benchmark one after the other and keeps what those that fail say.
class Attempts {
public:
    explicit Attempts(std::vector<BenchFailure>& failures) : failures_(failures) {}

    /// `what` names the step. After Ctrl-C a failure is not kept: the signal meets the children of a step too.
    void run(const std::string& what, const std::function<void()>& step);

    /// Throws what the first step that failed threw; does nothing if none did.
    void rethrowFirst() const;

private:
    std::vector<BenchFailure>& failures_;
    std::exception_ptr first_;
};

} // namespace quasilux

// `quasilux bench`.
#pragma once

#include "cli/bench_options.h"

namespace quasilux {

/// Returns the exit code. Throws InputError.
int benchCommand(const BenchOptions& options);

} // namespace quasilux

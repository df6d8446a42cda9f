// `quasilux report`: scene in, one page on its lighting out.
#pragma once

#include "cli/report_options.h"

namespace quasilux {

/// Returns the exit code, as renderCommand. Throws InputError, DeviceError, and std::runtime_error where the page cannot be written.
int reportCommand(const ReportOptions& options);

} // namespace quasilux

// `quasilux doctor`: what is wrong with devices, runtimes and libraries, and what to do.
#pragma once

namespace quasilux {

/// Exit code: 0 renders will run, also where there are warnings; 1 something keeps them from it.
int doctorCommand(bool json);

} // namespace quasilux

// The program's commands: render, view, merge, compare, photometry, falsecolour, report, dgp, bench, devices, doctor,
// manual, info (docs/reference/command-line.md).
#pragma once

namespace quasilux {

/// Exit code: 0 done, 1 the device or the program failed or a comparison
/// exceeded a threshold, or the doctor found a problem, 2 bad input, 130 interrupted before the first pass.
int runCommandLine(int argc, char** argv);

} // namespace quasilux

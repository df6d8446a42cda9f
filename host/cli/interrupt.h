// Ctrl-C ends the render after the running pass; what was rendered by then is written. An OpenCL runtime that compiles
// in this process may put in a handler of its own (PoCL's LLVM does, when the device is opened), so both calls are
// repeated.
#pragma once

#include <atomic>

namespace quasilux {

/// Set by the first Ctrl-C while rendering.
const std::atomic<bool>& interruptFlag();

/// While rendering: Ctrl-C sets the flag, and a second one ends the program with exit code 130. Call it at each pass.
void catchInterrupt();

/// Before there is anything to keep: Ctrl-C ends the program at once with exit code 130. Call it again after opening
/// the device.
void exitOnInterrupt();

} // namespace quasilux

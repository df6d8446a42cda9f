// Ctrl-C ends the render after the running pass; what was rendered by then is written.
#pragma once

#include <atomic>

namespace quasilux {

/// Set by the first Ctrl-C while rendering.
const std::atomic<bool>& interruptFlag();

/// Catches Ctrl-C from now on: it sets the flag, and a second one ends the program with exit code 130. OpenCL runtimes
/// that compile in this process (PoCL, by LLVM) put in handlers of their own, so call this again after each pass.
void catchInterrupt();

/// Before there is anything to keep: Ctrl-C ends the program at once with exit code 130.
void exitOnInterrupt();

} // namespace quasilux

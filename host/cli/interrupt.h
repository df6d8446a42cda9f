// Ctrl-C (SIGINT), SIGTERM and SIGHUP end the render after the running pass; what was rendered by then is written. An
// OpenCL runtime that compiles in this process may put in a handler of its own (PoCL's LLVM does, when the device is
// opened), so both calls are repeated.
#pragma once

#include <atomic>

namespace quasilux {

/// Set by the first of these signals while rendering.
const std::atomic<bool>& interruptFlag();

/// While rendering: such a signal sets the flag, and a second one ends the program with exit code 128 + its number: a
/// second Ctrl-C at once, others from 2 s after the first on, as one cause may send several. Call it at each pass.
void catchInterrupt();

/// Before there is anything to keep: such a signal ends the program at once, with that exit code. Call it again after
/// opening the device.
void exitOnInterrupt();

/// The number of the first of these signals; 0: none has come.
int signalThatCame();

/// Exit code once all has been written: 0, also after Ctrl-C, which people use to end a render in time; 128 + the
/// number of another signal, so that a scheduler knows that the render is not done.
int exitCodeWhenWritten();
/// Where nothing could be written: 128 + the number, of Ctrl-C too; as of Ctrl-C where no signal has come.
int exitCodeWithoutResult();

} // namespace quasilux

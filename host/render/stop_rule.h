// When a render ends, how long it goes on, and when its error is to be estimated: for one device (render_loop.cpp) and
// for several (host/share/shared_render.cpp).
#pragma once

#include "render/renderer.h"

namespace quasilux {

/// Passes before an estimate of the error means anything.
inline constexpr unsigned fewestPassesForError = 4;

/// The same; where it says nothing, defaultSeconds.
StopRule withDefault(StopRule stop);

/// The film is read back for its error at most 2 % of the time, and once a second.
bool isErrorDue(double sinceLast, double costOfLast);

/// Seconds until the rule ends the render, by what it has come to; -1 where that is not known.
double secondsLeft(const StopRule& stop, const Progress& now);

} // namespace quasilux

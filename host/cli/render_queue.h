// `quasilux render` of several scenes: one after the other, several at once, or again and again as their files change.
#pragma once

#include "cli/options.h"

namespace quasilux {

/// Returns the exit code. A scene that fails does not keep others from being rendered: its error is said when it comes
/// and again at the end. Of a single scene exceptions are thrown as by renderCommand.
int renderScenes(const RenderOptions& options);

} // namespace quasilux

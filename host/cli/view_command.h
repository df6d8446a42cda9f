// quasilux view: a render that a page in the browser shows and changes (docs/reference/live-view.md).
#pragma once

#include "cli/options.h"

namespace quasilux {

/// Exit code. Throws InputError where the scene cannot be loaded to begin with; later the page says so.
int viewCommand(const RenderOptions& options);

} // namespace quasilux

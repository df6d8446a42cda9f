// What the counters of a finished render say against its image.
#pragma once

#include "render/renderer.h"

#include <string>
#include <vector>

namespace quasilux {

/// Light that is missing, or not known well enough for its error to mean anything; a sentence each.
std::vector<std::string> renderWarnings(const RenderCounters& counters, const SceneReport& report,
                                        const FilmImage& image);

} // namespace quasilux

// The scene as a render of these options has it.
#pragma once

#include "cli/options.h"

#include <memory>

namespace quasilux {

struct RenderScene {
    std::shared_ptr<Scene> scene;   ///< threads that open devices share it
    double seconds = 0;             ///< reading it
    std::optional<double> daylight; ///< skyOfDaylightFactor()
    std::vector<std::string> warnings;
};

/// Throws InputError.
RenderScene loadRenderScene(const RenderOptions& options);

} // namespace quasilux

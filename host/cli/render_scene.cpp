#include "cli/render_scene.h"

#include "cli/render_report.h"
#include "scene/loader.h"

#include <chrono>

namespace quasilux {

RenderScene loadRenderScene(const RenderOptions& options) {
    using Clock = std::chrono::steady_clock;
    const auto start = Clock::now();
    RenderScene loaded;
    loaded.scene = std::make_shared<Scene>(loadScene(options.scene, options.parameters(), options.choice()));
    if (!options.grid.empty()) measureGrid(*loaded.scene);
    loaded.seconds = std::chrono::duration<double>(Clock::now() - start).count();
    loaded.warnings = loaded.scene->warnings;
    loaded.daylight = skyOfDaylightFactor(options, *loaded.scene, loaded.warnings);
    return loaded;
}

} // namespace quasilux

#include "cli/render_scene.h"

#include "cli/render_report.h"
#include "scene/loader.h"
#include "util/stopwatch.h"

namespace quasilux {

RenderScene loadRenderScene(const RenderOptions& options) {
    const Stopwatch watch;
    RenderScene loaded;
    loaded.scene = std::make_shared<Scene>(loadScene(options.scene, options.parameters(), options.choice()));
    if (!options.grid.empty()) useGridsAsSensor(*loaded.scene);
    loaded.seconds = watch.seconds();
    loaded.warnings = loaded.scene->warnings;
    loaded.daylight = skyOfDaylightFactor(options, *loaded.scene, loaded.warnings);
    return loaded;
}

} // namespace quasilux

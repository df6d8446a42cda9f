#include "render/pass_program.h"

#include "render/method.h"

#include <fmt/format.h>

namespace quasilux {

std::string radiusOptions(unsigned classes) { return fmt::format("-DPHOTON_CLASSES={}u", classes); }

Program passProgram(Device& device, MapOrder map, const DeviceScene& scene, const RenderSettings& settings,
                    const std::string& further, const std::map<std::string, std::string>& extra) {
    Program program(device, map == MapOrder::camera ? "camera_map_pass.cl" : "photon_map_pass.cl",
                    kernelOptions(scene, settings) + further, extra);
    program.add("every_scene.cl", "");
    if (adaptsRadius(scene.features, settings))
        program.add("adaptive_radius.cl", radiusOptions(compiledClasses(scene.features, settings)));
    return program;
}

} // namespace quasilux

#include "scene/skies/daylight_factor.h"

#include "scene/skies/sky_image.h"
#include "util/error.h"

#include <fmt/format.h>
#include <numbers>

namespace quasilux {

SkyAlone keepSkyAlone(Scene& scene) {
    if (!scene.surroundings)
        throw InputError({scene.path}, "a daylight factor needs a sky: an emitter 'quasilux_cie_sky' (16 is the CIE's "
                                       "overcast one), 'quasilux_perez_sky', 'sunsky', 'envmap' or 'constant'.");
    Surroundings& sky = *scene.surroundings;
    if (sky.image && sky.image->hasSun)
        throw InputError(sky.where, fmt::format("a daylight factor is of the sky without the sun, which is a part of "
                                                "this emitter '{}'; set its sun_scale to 0.",
                                                sky.plugin));
    SkyAlone found;
    found.groundIrradiance = sky.image ? irradianceOfGround(*sky.image)
                                       : glm::dvec3(sky.radiance.r, sky.radiance.g, sky.radiance.b) * std::numbers::pi;
    if (found.groundIrradiance == glm::dvec3(0))
        throw InputError(sky.where, fmt::format("the upper half of the emitter '{}' is black, so that there is no "
                                                "daylight factor.",
                                                sky.plugin));
    found.leftOut = scene.pointEmitters.size() + scene.directionalEmitters.size();
    scene.pointEmitters.clear();
    scene.directionalEmitters.clear();
    if (sky.image) takeSunOffGround(*sky.image);
    for (ShapeDescription& shape : scene.shapes) {
        found.leftOut += shape.emitter ? 1 : 0;
        shape.emitter.reset();
    }
    return found;
}

} // namespace quasilux

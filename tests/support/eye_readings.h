// What an observer of a scene measures and sees, as `quasilux report` finds it.
#pragma once

#include "photometry/glare.h"
#include "render/renderer.h"
#include "report/figures.h"
#include "support/test_kernels.h"

namespace quasilux::test {

inline GlareSources sourcesSeenBy(const Scene& scene, const Observer& observer) {
    return glareSources(scene, observer, Occlusion(scene), false);
}

inline BatchedReadings readingsAtEye(Scene scene, const Observer& observer, EyeLight light, unsigned passes) {
    measureAtEye(scene, observer, light);
    RenderSettings settings = settingsFromScene(scene);
    settings.photonsPerPass = 20000;
    Renderer renderer(testDevice(), scene, settings);
    BatchedReadings readings(false);
    for (unsigned pass = 0; pass < passes; ++pass) {
        renderer.renderPass(pass);
        readings.add(renderer.develop());
    }
    return readings;
}

inline ObserverFigures figuresOf(const Scene& scene, const Observer& observer, unsigned passes) {
    return observerFigures(observer, sourcesSeenBy(scene, observer),
                           readingsAtEye(scene, observer, EyeLight::direct, passes),
                           readingsAtEye(scene, observer, EyeLight::all, passes));
}

} // namespace quasilux::test

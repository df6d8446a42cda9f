// A film and the record of a render for tests of files that the program writes.
#pragma once

#include "output/statistics.h"
#include "support/film_images.h"

namespace quasilux {

/// Every value of every layer differs, so that a swapped channel, row or layer shows. More rows than are written at
/// once.
inline FilmImage distinctImage() {
    FilmImage image = uniformImage(5, 150, 0, 4, 0);
    auto fill = [n = 0](std::vector<float>& values, size_t count) mutable {
        values.resize(count);
        for (auto& value : values) value = 0.125f + static_cast<float>(n++);
    };
    const size_t count = image.radiance.size();
    fill(image.radiance, count);
    fill(image.components[LIGHT_DIRECT].radiance, count);
    fill(image.components[LIGHT_QUASI_CAUSTIC].radiance, count);
    fill(image.components[FILM_EMISSION].radiance, count);
    fill(image.standardError, count);
    fill(image.bias, count);
    fill(image.biasError, count);
    return image;
}

inline RenderRecord exampleRecord() {
    RenderRecord record;
    record.scene = "box.xml";
    record.settings.bdd = 3;
    record.settings.variant = Variant::alternative;
    record.settings.direct = DirectLight::photons;
    record.settings.quasiSpecular = "glass,metal";
    record.settings.seed = 18446744073709551615u;
    record.settings.radiusScale = 0.5;
    record.settings.genericKernels = true;
    record.device.name = "Test device";
    record.device.driver = "driver 1.2";
    record.report.photonsPerPass = 4096;
    record.report.emitters = {{"lamp", "rectangle", 2.5}};
    record.report.lobes = {{"floor", "diffuse", "genuine diffuse", "wide"}};
    record.report.initialRadius["direct"] = 0.25;
    record.counters.passes = 7;
    record.counters.renderSeconds = 12.5;
    record.counters.nonFinite = 2;
    record.error.hasBias = true;
    record.error.total = {0.0625, 0.25, 0.125, 0.5, 0.75};
    record.error.components[LIGHT_DIRECT] = {0.5, 1.5, 2.5, 3.5, 4.5};
    record.kernels["tracePhotons"] = {7, 3.5};
    record.peakBufferBytes = 123456789012;
    return record;
}

} // namespace quasilux

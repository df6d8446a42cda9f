// Photons carry the emitted flux: in the closed furnace (scenes/furnace_split.xml, reflectance 0.3 genuine diffuse +
// 0.3 quasi-specular) the flux deposited by class is known in closed form, in units of the emitted flux P:
//     direct P,   quasi-caustic P (0.3 + 0.3^2 + …) = P 0.3 / 0.7,   all together P / (1 - 0.6).
// All within 4 standard errors of 12 passes (Student t with 11 degrees
// of freedom: 0.2 % a case); seeds are fixed.
#include "scene/color.h"
#include "support/render_statistics.h"
#include "support/stored_photons.h"

#include "render/method.h"

#include <cmath>
#include <gtest/gtest.h>

namespace quasilux {
namespace {

using FluxByClass = std::array<double, LIGHT_CLASSES>;

// Flux of the stored photons by class, for each of 12 passes.
std::vector<FluxByClass> storedFlux(const DeviceScene& flat, const RenderSettings& settings, unsigned paths) {
    PhotonTracing tracing;
    tracing.paths = paths;
    tracing.radius = 0.1f;
    std::vector<FluxByClass> flux;
    for (const auto& pass : tracePhotons(flat, settings, tracing)) {
        flux.emplace_back();
        for (unsigned c = 0; c < LIGHT_CLASSES; ++c)
            for (const StoredPhoton& photon : pass[c]) flux.back()[c] += mean(photon.flux);
    }
    return flux;
}

DeviceScene flattenFurnace() { return flattenScene(projectScene("furnace_split.xml")); }

MeanAndError overPasses(const std::vector<FluxByClass>& flux, unsigned lightClass) {
    std::vector<double> ofClass;
    for (const auto& pass : flux) ofClass.push_back(pass[lightClass]);
    return meanAndError(ofClass);
}

TEST(PhotonTrace, StoredFluxIsTheEmittedFluxTimesItsSeries) {
    const auto flat = flattenFurnace();
    RenderSettings settings;
    settings.direct = DirectLight::photons;
    const auto flux = storedFlux(flat, settings, 20'000);
    const double emitted = flat.emittedFlux;
    EXPECT_NEAR(emitted, 6 * 4 * 3.141592653589793, 1e-4) << "six walls of area 4 and radiance 1";

    const auto direct = overPasses(flux, LIGHT_DIRECT);
    EXPECT_NEAR(direct.mean / emitted, 1, 4 * direct.standardError / emitted);
    EXPECT_LT(direct.standardError / emitted, 3e-5) << "it scatters by the rounding of packed flux alone";
    const auto quasiCaustic = overPasses(flux, LIGHT_QUASI_CAUSTIC);
    EXPECT_NEAR(quasiCaustic.mean / emitted, 0.3 / 0.7, 4 * quasiCaustic.standardError / emitted);
    const auto diffuse = overPasses(flux, LIGHT_DIFFUSE);
    EXPECT_NEAR(diffuse.mean / emitted, 2.5 - 1 - 0.3 / 0.7, 4 * diffuse.standardError / emitted);
    EXPECT_LT(diffuse.standardError / emitted, 0.01) << "too noisy to decide anything";
    // Negative control: reflectance 3 % off would be seen.
    EXPECT_GT(std::abs(quasiCaustic.mean / emitted - 0.309 / 0.691), 4 * quasiCaustic.standardError / emitted);
}

TEST(PhotonTrace, ClassesThatNoPathCanUseAreNotStored) {
    const auto flat = flattenFurnace();
    RenderSettings settings; // direct light by emitter sampling; no specular surface in the scene
    EXPECT_EQ(photonClasses(flat.features, settings), 1u << LIGHT_QUASI_CAUSTIC | 1u << LIGHT_DIFFUSE);
    const auto flux = storedFlux(flat, settings, 1000);
    EXPECT_EQ(flux[0][LIGHT_DIRECT], 0);
    EXPECT_EQ(flux[0][LIGHT_CAUSTIC], 0);
    EXPECT_GT(flux[0][LIGHT_DIFFUSE], 0);
}

// The furnace stores 2.5 photons a path where the buffer starts with room for one: it must grow, not drop.
TEST(PhotonTrace, FullBuffersGrow) {
    const auto flat = flattenFurnace();
    RenderSettings settings;
    settings.direct = DirectLight::photons;
    const auto few = overPasses(storedFlux(flat, settings, 300), LIGHT_DIRECT),
               many = overPasses(storedFlux(flat, settings, 30'000), LIGHT_DIRECT);
    for (const MeanAndError& direct : {few, many}) EXPECT_NEAR(direct.mean, flat.emittedFlux, 4 * direct.standardError);
    EXPECT_LT(few.standardError, 3e-4 * flat.emittedFlux) << "one block of photons lost would be 0.9 %";
}

} // namespace
} // namespace quasilux

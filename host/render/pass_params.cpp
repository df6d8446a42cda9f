#include "render/pass_params.h"

#include "render/adaptive_radius.h"
#include "render/flux_unit.h"
#include "render/method.h"
#include "render/radius.h"

#include <numbers>

namespace quasilux {

namespace {

shared::SceneTables sceneTables(const DeviceScene& flat, const RenderSettings& settings) {
    shared::SceneTables tables = flat.offsets;
    tables.variant = settings.variant == Variant::alternative ? VARIANT_ALTERNATIVE : VARIANT_MAIN;
    return tables;
}

} // namespace

double firstRadiusByArea(double area, const RenderSettings& settings, unsigned photons) {
    return settings.radiusScale * initialRadius(area, photons);
}

DeviceScene flattenFor(const Scene& scene, const RenderSettings& settings, const SceneGeometry* known) {
    const unsigned photons = photonsPerPass(settings, flattenCamera(scene.sensor));
    FlattenSettings flattening;
    flattening.quasiSpecular = settings.quasiSpecular;
    flattening.photons = photons;
    flattening.overridesScene = settings.quasiSpecularOverridesScene;
    DeviceScene flat = flattenScene(scene, flattening, known);
    flat.offsets.meter.samples = meterSamples(flat, settings);
    return flat;
}

unsigned maxDepthOf(const Scene& scene) { return scene.maxDepth < 0 ? QL_NONE : static_cast<unsigned>(scene.maxDepth); }

shared::PhotonParams photonParams(const Scene& scene, const DeviceScene& flat, const RenderSettings& settings) {
    shared::PhotonParams params{};
    setNumbers(params, settings.seed);
    params.paths = photonsPerPass(settings, flat.camera);
    params.perFluxUnit = 1 / fluxUnit(flat, params.paths);
    params.maxDepth = maxDepthOf(scene);
    params.scene = sceneTables(flat, settings);
    return params;
}

// Each carries more: by the worth of one of more photons, weight windows would split all of them.
shared::PhotonParams withPaths(shared::PhotonParams params, unsigned paths) {
    const float more = static_cast<float>(params.paths) / static_cast<float>(paths);
    params.paths = paths;
    params.usualWorth *= more;
    params.perFluxUnit /= more;
    return params;
}

shared::CameraParams cameraParams(const DeviceScene& flat, const RenderSettings& settings, unsigned maxDepth) {
    shared::CameraParams params{};
    setNumbers(params, settings.seed);
    // The meter's own scattering does not count (kernels/meter.clh).
    params.bdd = settings.bdd + (meterIsGenuineDiffuse(flat.features, settings) ? 1 : 0);
    params.maxDepth = maxDepth;
    params.gathers = photonClasses(flat.features, settings) != 0;
    params.coarseness = 1;
    params.spread = 1;
    params.directSamples = 1;
    params.parts = 1;
    params.causticsByPaths = settings.caustics == CausticLight::paths;
    params.camera = flat.camera;
    params.scene = sceneTables(flat, settings);
    return params;
}

shared::CameraParams ofPass(shared::CameraParams params, unsigned pass, PassPart part) {
    setNumbers(params, uint64_t{params.seedHigh} << 32 | params.seedLow, pass, part);
    params.parts = part.count;
    return params;
}

double meanRadiance(const DeviceScene& flat) {
    return flat.surfaceArea > 0 ? flat.emittedFlux / (std::numbers::pi * flat.surfaceArea) : flat.emittedFlux;
}

} // namespace quasilux

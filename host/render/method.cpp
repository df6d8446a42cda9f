#include "render/method.h"

#include "render/film.h"

#include <algorithm>
#include <bit>
#include <fmt/format.h>

namespace quasilux {

namespace {

constexpr unsigned bit(unsigned lightClass) { return 1u << lightClass; }
constexpr unsigned photonsPerCameraPath = 6;

// Classes that can be taken at all where there is genuine diffuse and quasi-specular scattering (kernels/law.clh).
unsigned takenClasses(bool genuineDiffuse, bool quasiSpecular, Variant variant) {
    const unsigned e0 = bit(LIGHT_DIRECT) | bit(LIGHT_CAUSTIC);
    unsigned classes = 0;
    if (genuineDiffuse) classes |= e0 | bit(LIGHT_QUASI_CAUSTIC) | bit(LIGHT_DIFFUSE);
    if (quasiSpecular) classes |= variant == Variant::main ? e0 | bit(LIGHT_QUASI_CAUSTIC) : e0;
    return classes;
}

} // namespace

bool meterIsGenuineDiffuse(const Features& features, const RenderSettings& settings) {
    return features.irradianceMeter && settings.variant == Variant::main;
}

unsigned photonClasses(const Features& sceneFeatures, const RenderSettings& settings) {
    const Features features = settings.genericKernels ? Features::generic() : sceneFeatures;
    unsigned exist = 0; // classes that photons of this scene can have
    // Of some emitters genuine diffuse scattering alone takes it from photons (kernels/camera_surface.clh).
    if (settings.direct == DirectLight::photons || (sceneFeatures.directByPhotons && features.genuineDiffuse))
        exist |= bit(LIGHT_DIRECT);
    if (features.specular && settings.caustics == CausticLight::photons) exist |= bit(LIGHT_CAUSTIC);
    if (features.quasiSpecular || features.quasiSpecularMedia) exist |= bit(LIGHT_QUASI_CAUSTIC);
    if (features.genuineDiffuse || features.genuineDiffuseMedia) exist |= bit(LIGHT_DIFFUSE);
    const bool byPhotons = meterIsGenuineDiffuse(sceneFeatures, settings);
    const bool byPaths = sceneFeatures.irradianceMeter && !byPhotons;
    const unsigned surfaces =
        exist & takenClasses(features.genuineDiffuse || byPhotons, features.quasiSpecular || byPaths, settings.variant);
    const unsigned media =
        exist & takenClasses(features.genuineDiffuseMedia, features.quasiSpecularMedia, settings.variant);
    return surfaces | media << LIGHT_CLASSES;
}

unsigned compiledClasses(const Features& features, const RenderSettings& settings) {
    unsigned some = photonClasses(features, settings) | settings.furtherClasses;
    if (settings.furtherFeatures) some |= photonClasses(features.with(*settings.furtherFeatures), settings);
    return some == 0 || !features.directByPhotons ? some : some | bit(LIGHT_DIRECT);
}

namespace {

bool hasEmittersThatNoPathMeets(const Scene& scene) {
    return !scene.pointEmitters.empty() || !scene.directionalEmitters.empty() ||
           std::any_of(scene.shapes.begin(), scene.shapes.end(),
                       [](const ShapeDescription& shape) { return shape.emitter && shape.emitter->alongNormal; });
}

} // namespace

std::string whyNotCausticsByPaths(const Scene& scene, const Features& features, const RenderSettings& settings) {
    RenderSettings byPaths = settings;
    byPaths.caustics = CausticLight::paths;
    if (settings.map == MapOrder::camera) return "--map camera is there for photons";
    if (features.irradianceMeter) return "irradiance meters count photons";
    if (photonClasses(features, byPaths) != 0) {
        byPaths.genericKernels = false;
        if (settings.genericKernels && photonClasses(features, byPaths) == 0)
            return "--kernels generic takes photons of all classes; take --kernels scene";
        return "photons of other classes are in use, and need them to bring all light; take --quasi-specular all, "
               "--variant alternative and --direct emitters with it";
    }
    if (hasEmittersThatNoPathMeets(scene))
        return "the scene has emitters that no path can meet: points, parallel beams or luminaires";
    return {};
}

namespace {

// Classes of photons that are counted at an irradiance meter.
unsigned meterClasses(const Features& features, const RenderSettings& settings) {
    if (!features.irradianceMeter) return 0;
    const bool genuineDiffuse = meterIsGenuineDiffuse(features, settings);
    const unsigned taken = takenClasses(genuineDiffuse, !genuineDiffuse, settings.variant) & ~bit(LIGHT_DIFFUSE);
    return photonClasses(features, settings) & taken;
}

// Never of generic kernels: a sensor is a camera or a meter.
bool isMeter(const Features& features) { return features.radianceMeter || features.irradianceMeter; }

bool estimatesBias(bool isMeter, const RenderSettings& settings) {
    return settings.estimateBias && settings.map == MapOrder::photons && !isMeter;
}

std::string meterOptions(const Features& features, const RenderSettings& settings) {
    std::string options;
    if (isMeter(features)) options += " -DHAS_METER";
    if (features.irradianceMeter) options += " -DHAS_IRRADIANCE_METER";
    if (meterCountsPhotons(features, settings)) options += " -DHAS_METER_PHOTONS";
    return options;
}

} // namespace

bool estimatesBias(const Features& features, const RenderSettings& settings) {
    return estimatesBias(isMeter(features), settings);
}

FilmLayout filmLayout(const Features& features, const RenderSettings& settings) {
    return {settings.film.bias && estimatesBias(features, settings), settings.film.components};
}

uint64_t largestFilmBuffer(const Features& features, const RenderSettings& settings, const DeviceInfo& device) {
    const bool isInParts = settings.map == MapOrder::photons && !isMeter(features);
    return isInParts ? device.maximumAllocation : Film::inOneBuffer;
}

bool adaptsRadius(const Features& features, const RenderSettings& settings) {
    return settings.radius == RadiusChoice::adaptive && estimatesBias(features, settings) && !features.media &&
           compiledClasses(features, settings) != 0;
}

bool learns(const Features& features, const RenderSettings& settings) {
    return settings.emission == Emission::guided && compiledClasses(features, settings) != 0;
}

bool mayTakeDirectFromPhotons(const Features& features, const RenderSettings& settings) {
    return settings.direct == DirectLight::emitters && settings.map == MapOrder::photons && !isMeter(features) &&
           !features.media && (features.genuineDiffuse || settings.furtherClasses != 0) && !settings.genericKernels &&
           settings.emission == Emission::guided &&
           (features.emitterTypes.contains(EMITTER_CONSTANT) || features.emitterTypes.contains(EMITTER_ENVMAP));
}

bool meterCountsPhotons(const Features& features, const RenderSettings& settings) {
    return meterClasses(features, settings) != 0;
}

bool meterCountsCaustics(const Features& features, const RenderSettings& settings) {
    return (meterClasses(features, settings) & ~bit(LIGHT_DIRECT)) != 0;
}

Features compiledFeatures(const DeviceScene& scene, const RenderSettings& settings) {
    if (settings.genericKernels) return scene.features.with(Features::generic());
    return settings.furtherFeatures ? scene.features.with(*settings.furtherFeatures) : scene.features;
}

bool sharesSamples(const Features& features, const RenderSettings& settings) {
    return features.sharedFilter && settings.map == MapOrder::photons && !isMeter(features);
}

bool storesDepth(const DeviceScene& scene, const RenderSettings& settings) {
    return compiledFeatures(scene, settings).depthLimit;
}

std::string kernelOptions(const DeviceScene& scene, const RenderSettings& settings) {
    std::string options = compiledFeatures(scene, settings).options() + ' ' + bvhOptions(scene.bvh);
    options += fmt::format(" -DPHOTON_CLASSES={}u", compiledClasses(scene.features, settings));
    options += meterOptions(scene.features, settings);
    if (settings.direct == DirectLight::emitters) options += " -DDIRECT_BY_EMITTERS";
    if (estimatesBias(scene.features, settings)) options += " -DESTIMATE_BIAS=1";
    if (learns(scene.features, settings)) options += " -DLEARNS";
    if (adaptsRadius(scene.features, settings)) options += " -DADAPTIVE_RADIUS";
    if (sharesSamples(scene.features, settings)) options += " -DSHARES_SAMPLES";
    if (settings.energyBalance) options += " -DENERGY_BALANCE";
    return options + settings.controlOptions;
}

unsigned photonsForPixels(const shared::Camera& camera, unsigned fewest) {
    const uint64_t wanted = uint64_t(photonsPerCameraPath) * camera.width * camera.height;
    return static_cast<unsigned>(std::clamp<uint64_t>(wanted, fewest, 4'000'000));
}

unsigned photonsPerPass(const RenderSettings& settings, const shared::Camera& camera) {
    if (settings.photonsPerPass > 0) return settings.photonsPerPass;
    return photonsForPixels(camera, 20'000);
}

// A path costs about what a photon costs. Where photons are counted, theirs or the paths' may be the larger variance:
// with half of the time for each it is at most twice that of the best shares; so where all paths meet one place, as
// those of a ray. Elsewhere photons lie about their hits all over the scene, and have little of it.
unsigned meterSamples(const DeviceScene& scene, const RenderSettings& settings) {
    const shared::Meter& meter = scene.offsets.meter;
    if (meter.kind == METER_NONE) return 1;
    const bool photonsMatter =
        settings.map == MapOrder::camera || meter.kind == METER_RAY || meterCountsPhotons(scene.features, settings);
    const uint64_t pixels = uint64_t{meter.width} * meter.height,
                   paths = uint64_t{photonsMatter ? 1u : 4u} * photonsPerPass(settings, scene.camera);
    return static_cast<unsigned>(std::bit_floor(std::max<uint64_t>(paths / pixels, 1)));
}

} // namespace quasilux

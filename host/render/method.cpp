#include "render/method.h"

#include <algorithm>
#include <fmt/format.h>

namespace quasilux {

namespace {

constexpr unsigned bit(unsigned lightClass) { return 1u << lightClass; }
constexpr unsigned photonsPerCameraPath = 6;

} // namespace

unsigned photonClasses(const Features& sceneFeatures, const RenderSettings& settings) {
    const Features features = settings.genericKernels ? Features::generic() : sceneFeatures;
    const bool anyTakes = features.genuineDiffuse || features.quasiSpecular;
    unsigned classes = 0;
    if (settings.direct == DirectLight::photons && anyTakes) classes |= bit(LIGHT_DIRECT);
    if (features.specular && anyTakes) classes |= bit(LIGHT_CAUSTIC);
    // The alternative variant never takes Eqc with F_qs, so it needs a genuine diffuse lobe to take it.
    const bool takesQuasiCaustic = features.genuineDiffuse || settings.variant == Variant::main;
    if (features.quasiSpecular && takesQuasiCaustic) classes |= bit(LIGHT_QUASI_CAUSTIC);
    if (features.genuineDiffuse) classes |= bit(LIGHT_DIFFUSE);
    return classes;
}

Features compiledFeatures(const DeviceScene& scene, const RenderSettings& settings) {
    return settings.genericKernels ? Features::generic() : scene.features;
}

std::string kernelOptions(const DeviceScene& scene, const RenderSettings& settings) {
    std::string options = compiledFeatures(scene, settings).options() + ' ' + bvhOptions(scene.bvh);
    options += fmt::format(" -DPHOTON_CLASSES={}u", photonClasses(scene.features, settings));
    if (settings.direct == DirectLight::emitters) options += " -DDIRECT_BY_EMITTERS";
    if (settings.variant == Variant::alternative) options += " -DLAW_ALTERNATIVE";
    if (settings.lawRule != LawRule::right)
        options += fmt::format(" -DLAW_RULE={}", static_cast<int>(settings.lawRule));
    return options;
}

unsigned photonsPerPass(const RenderSettings& settings, const shared::Camera& camera) {
    if (settings.photonsPerPass > 0) return settings.photonsPerPass;
    const uint64_t wanted = uint64_t(photonsPerCameraPath) * camera.width * camera.height;
    return static_cast<unsigned>(std::clamp<uint64_t>(wanted, 20'000, 4'000'000));
}

} // namespace quasilux

// At which level the phase functions of the media are split.
#include "prepare/split.h"

#include "prepare/split_list.h"
#include "scene/quasi_specular.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace quasilux {

namespace {

constexpr double inverseFourPi = 0.07957747154594767;
constexpr float infinity = std::numeric_limits<float>::infinity();

/// Henyey & Greenstein 1941, sr^-1, of 1 - cos of the angle to the peak; `g` >= 0.
double henyeyGreenstein(double g, double oneMinusCos) {
    const double denominator = (1 - g) * (1 - g) + 2 * g * oneMinusCos;
    return inverseFourPi * (1 - g) * (1 + g) / (denominator * std::sqrt(denominator));
}

/// 1 - cos below which the share `u` of the HG function lies (Witt 1977, eq. 19, solved for 1 - cos).
double henyeyGreensteinQuantile(double g, double u) {
    const double denominator = 1 - g + 2 * g * (1 - u);
    return (1 - g) * u * ((1 - g) * (1 + g) / denominator + 1 - g) / denominator;
}

/// sr^-1; the angle is counted from the peak, be it forwards or backwards.
double phaseValue(const MediumDescription& medium, double oneMinusCos) {
    if (medium.phase == PHASE_HG) return henyeyGreenstein(std::abs(medium.g), oneMinusCos);
    if (medium.phase == PHASE_RAYLEIGH) return 0.75 * inverseFourPi * (1 + (1 - oneMinusCos) * (1 - oneMinusCos));
    return inverseFourPi;
}

/// The integral of min(p, level) over the sphere, by the midpoint rule over equal shares of the HG function of the
/// medium (of the uniform density for the other phase functions), so that a narrow peak is resolved too.
double genuineDiffuseShare(const MediumDescription& medium, double level) {
    constexpr int steps = 4096;
    const double g = medium.phase == PHASE_HG ? std::abs(medium.g) : 0;
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
        const double oneMinusCos = henyeyGreensteinQuantile(g, (i + 0.5) / steps);
        sum += std::min(phaseValue(medium, oneMinusCos), level) / henyeyGreenstein(g, oneMinusCos);
    }
    return sum / steps;
}

MediumDecision allQuasiSpecular(const std::string& why) { return {0, 0, why}; }
MediumDecision allGenuineDiffuse(const std::string& why) { return {infinity, 1, why}; }

MediumDecision byLevel(const MediumDescription& medium, double level, const std::string& by) {
    const double highest = phaseValue(medium, 0);
    if (highest <= level)
        return allGenuineDiffuse(
            fmt::format("{}: all of it is genuine diffuse, its phase function stays below {:.3g} per sr", by, level));
    const double share = genuineDiffuseShare(medium, level);
    return {
        static_cast<float>(level), share,
        fmt::format("{}: level {:.3g} per sr: {:.3g} % of the scattering is genuine diffuse", by, level, 100 * share)};
}

/// The level that `auto` chooses, unless so little lies above it that following it would not pay.
MediumDecision byAuto(const MediumDescription& medium) {
    MediumDecision decision = byLevel(medium, autoPhaseLevel, "auto");
    if (decision.genuineDiffuseShare > autoDiffuseShare)
        return {infinity, 1,
                fmt::format("auto: all of it is genuine diffuse, less than {:.3g} % of the scattering lies "
                            "above {:.3g} per sr",
                            100 * (1 - autoDiffuseShare), autoPhaseLevel)};
    return decision;
}

MediumDecision byScene(const MediumDescription& medium) {
    switch (medium.quasiSpecular.kind) {
    case QuasiSpecularChoice::Kind::yes:
        return allQuasiSpecular("the scene: yes");
    case QuasiSpecularChoice::Kind::no:
        return allGenuineDiffuse("the scene: no");
    case QuasiSpecularChoice::Kind::level:
        return byLevel(medium, medium.quasiSpecular.level, "the scene");
    case QuasiSpecularChoice::Kind::automatic:
    case QuasiSpecularChoice::Kind::lobes: // the loader gives lists to bsdfs only
        break;
    }
    return byAuto(medium);
}

MediumDecision decide(const MediumDescription& medium, const std::string& setting, const std::vector<std::string>& list,
                      bool overridesScene) {
    if (medium.quasiSpecular.stated && (!overridesScene || setting == "auto")) return byScene(medium);
    if (setting == "none") return allGenuineDiffuse("setting: none");
    if (setting == "all") return allQuasiSpecular("setting: all");
    if (isPhaseLevel(setting)) return byLevel(medium, parsePhaseLevel(setting, {}), "setting");
    if (std::find(list.begin(), list.end(), medium.id) != list.end()) return allQuasiSpecular("setting: listed");
    return byAuto(medium);
}

} // namespace

std::vector<MediumDecision> decideMediumSplit(const Scene& scene, const std::string& setting, bool overridesScene) {
    const std::vector<std::string> list = listedIds(scene, setting);
    std::vector<MediumDecision> decisions;
    decisions.reserve(scene.media.size());
    for (const auto& medium : scene.media) decisions.push_back(decide(medium, setting, list, overridesScene));
    return decisions;
}

} // namespace quasilux

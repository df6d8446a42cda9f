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

/// sr^-1, of 1 - cos of the angle between the directions of propagation.
double partValue(const PhasePartDescription& part, double oneMinusCos) {
    switch (part.phase) {
    case PHASE_HG:
        return henyeyGreenstein(std::abs(part.g), part.g < 0 ? 2 - oneMinusCos : oneMinusCos);
    case PHASE_RAYLEIGH:
        return 0.75 * inverseFourPi * (1 + (1 - oneMinusCos) * (1 - oneMinusCos));
    case PHASE_TABULATED: {
        const double place = (2 - oneMinusCos) / 2 * static_cast<double>(part.values.size() - 1);
        const size_t i = std::min(static_cast<size_t>(std::max(place, 0.0)), part.values.size() - 2);
        const double f = std::clamp(place - static_cast<double>(i), 0.0, 1.0);
        return part.values[i] + f * (part.values[i + 1] - part.values[i]);
    }
    default:
        return inverseFourPi;
    }
}

std::vector<PhasePartDescription> partsOf(const MediumDescription& medium) {
    if (medium.phase == PHASE_MIXED) return medium.phaseParts;
    return {{medium.phase, medium.g, 1, {}}};
}

double phaseValue(const std::vector<PhasePartDescription>& parts, double oneMinusCos) {
    double sum = 0;
    for (const auto& part : parts) sum += part.weight * partValue(part, oneMinusCos);
    return sum;
}

/// Every function is convex in the cosine, or linear between the entries of a table: so is their sum.
double highestValue(const std::vector<PhasePartDescription>& parts) {
    double highest = std::max(phaseValue(parts, 0), phaseValue(parts, 2));
    for (const auto& part : parts)
        for (size_t i = 0; i < part.values.size(); ++i) {
            const double steps = static_cast<double>(part.values.size() - 1);
            highest = std::max(highest, phaseValue(parts, 2 - 2 * static_cast<double>(i) / steps));
        }
    return highest;
}

/// The integral of min(p, level) over the sphere, by the midpoint rule: part by part over equal shares of its HG
/// function, so that a narrow peak is resolved too, over the uniform density for others.
double genuineDiffuseShare(const std::vector<PhasePartDescription>& parts, double level) {
    constexpr int steps = 4096;
    double share = 0;
    for (const auto& part : parts) {
        const double g = part.phase == PHASE_HG ? std::abs(part.g) : 0;
        double sum = 0;
        for (int i = 0; i < steps; ++i) {
            const double toPeak = henyeyGreensteinQuantile(g, (i + 0.5) / steps);
            const double oneMinusCos = part.g < 0 && g > 0 ? 2 - toPeak : toPeak;
            const double p = phaseValue(parts, oneMinusCos);
            const double own = parts.size() == 1 ? p : partValue(part, oneMinusCos);
            if (p > 0) sum += std::min(p, level) / p * own / henyeyGreenstein(g, toPeak);
        }
        share += part.weight * sum / steps;
    }
    return share;
}

MediumDecision allQuasiSpecular(const std::string& why) { return {0, 0, why}; }
MediumDecision allGenuineDiffuse(const std::string& why) { return {infinity, 1, why}; }

MediumDecision byLevel(const MediumDescription& medium, double level, const std::string& by) {
    const std::vector<PhasePartDescription> parts = partsOf(medium);
    const double highest = highestValue(parts);
    if (highest <= level)
        return allGenuineDiffuse(
            fmt::format("{}: all of it is genuine diffuse, its phase function stays below {:.3g} per sr", by, level));
    const double share = genuineDiffuseShare(parts, level);
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

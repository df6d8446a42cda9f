#include "auto/candidates.h"

#include "prepare/device_scene.h"
#include "prepare/split.h"
#include "render/method.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace quasilux {

namespace {

constexpr size_t mostSingleLobes = 4;
constexpr unsigned fewestPhotonsAtStart = 2560; // halved and doubled without a remainder

struct Split {
    std::vector<BsdfDecision> bsdfs;
    std::vector<MediumDecision> media;
};

Split splitOf(const Scene& scene, const RenderSettings& settings) {
    return {decideSplit(scene, settings.quasiSpecular, settings.quasiSpecularFromCommandLine),
            decideMediumSplit(scene, settings.quasiSpecular, settings.quasiSpecularFromCommandLine)};
}

template <typename Visit>
void forEachLobe(const Split& split, const Visit& visit) {
    for (const auto& bsdf : split.bsdfs)
        for (const auto* side : {&bsdf.front, &bsdf.back})
            for (const auto& lobe : *side) visit(lobe.scattering);
}

// What the kernels are compiled for; the level itself is data to them.
struct Scatterings {
    bool diffuseLobes = false, quasiSpecularLobes = false, diffuseMedia = false, quasiSpecularMedia = false;

    explicit Scatterings(const Split& split) {
        forEachLobe(split, [&](unsigned scattering) {
            diffuseLobes |= scattering == SCATTER_GENUINE_DIFFUSE;
            quasiSpecularLobes |= scattering == SCATTER_QUASI_SPECULAR;
        });
        for (const auto& medium : split.media) {
            diffuseMedia |= medium.level > 0;
            quasiSpecularMedia |= !std::isinf(medium.level);
        }
    }
};

// With nothing genuine diffuse the main variant is the standard method with BDD 0, as if everything were
// (docs/theory.md).
bool isStandard(const Scatterings& has, Variant variant) {
    return variant == Variant::main && !has.diffuseLobes && !has.diffuseMedia;
}

// The same for splits that come to the same image with this variant and BDD.
std::string splitKey(const Split& split, Variant variant, unsigned bdd) {
    const bool standard = bdd == 0 && isStandard(Scatterings(split), variant);
    std::string key;
    forEachLobe(split, [&](unsigned scattering) {
        const bool becomesDiffuse = standard && scattering == SCATTER_QUASI_SPECULAR;
        key += fmt::format("{} ", becomesDiffuse ? unsigned{SCATTER_GENUINE_DIFFUSE} : scattering);
    });
    for (const auto& medium : split.media)
        key += fmt::format("{} ", standard ? std::numeric_limits<float>::infinity() : medium.level);
    return key;
}

// ID.LOBE of lobes that are neither delta nor Lambert, each once.
std::vector<std::string> singleLobes(const Scene& scene) {
    std::vector<std::string> names;
    for (const auto& bsdf : scene.bsdfs)
        for (const auto* side : {&bsdf.front, &bsdf.back})
            for (const auto& lobe : *side) {
                const std::string name = bsdf.id + '.' + lobe.name;
                if (lobe.device.scattering == SCATTER_SPECULAR || lobe.device.type == LOBE_LAMBERT) continue;
                if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
            }
    if (names.size() < 2 || names.size() > mostSingleLobes) names.clear();
    return names;
}

std::vector<RenderSettings> otherSplits(const RenderSettings& from, const Scene& scene, bool variantIsFree) {
    std::vector<std::string> splits{"auto"};
    if (!scene.media.empty()) splits.insert(splits.end(), {"level:0.1", "level:0.3", "level:0.03"});
    splits.insert(splits.end(), {"none", "all"});
    for (const auto& lobe : singleLobes(scene)) splits.push_back(lobe);
    std::vector<std::string> known{splitKey(splitOf(scene, from), from.variant, from.bdd)};
    std::vector<RenderSettings> found;
    for (const auto& split : splits) {
        RenderSettings next = from;
        next.quasiSpecular = split;
        next.quasiSpecularFromCommandLine = true;
        const Split decided = splitOf(scene, next);
        const Scatterings has(decided);
        // Following everything is the alternative variant's alone: with the main one, it would be found in two steps
        // only. With nothing followed the variants are one, and its candidate has been there before.
        if (variantIsFree && isStandard(has, next.variant)) next.variant = Variant::alternative;
        if (variantIsFree && !has.quasiSpecularLobes && !has.quasiSpecularMedia) next.variant = Variant::main;
        const std::string key = splitKey(decided, next.variant, next.bdd);
        if (std::find(known.begin(), known.end(), key) != known.end()) continue;
        known.push_back(key);
        found.push_back(next);
    }
    return found;
}

bool isFree(Coordinate coordinate, const Freedom& freedom) {
    const bool free[] = {freedom.split, freedom.bdd, freedom.variant, freedom.photons, freedom.radius};
    return free[static_cast<size_t>(coordinate)];
}

} // namespace

RenderSettings searchStart(const RenderSettings& settings, const Scene& scene, const Freedom& freedom,
                           const StopRule& stop) {
    RenderSettings start = settings;
    if (freedom.photons && settings.photonsPerPass == 0 && whyNotSearched(scene, settings, stop).empty())
        start.photonsPerPass = photonsForPixels(flattenCamera(scene.sensor), fewestPhotonsAtStart);
    return start;
}

std::vector<RenderSettings> neighbours(Coordinate coordinate, const RenderSettings& from, unsigned photons,
                                       const Scene& scene, const Freedom& freedom) {
    if (!isFree(coordinate, freedom)) return {};
    RenderSettings next = from;
    switch (coordinate) {
    case Coordinate::bdd:
        next.bdd = from.bdd == 0 ? 1 : 0;
        return {next};
    case Coordinate::split:
        return otherSplits(from, scene, freedom.variant);
    case Coordinate::variant: {
        const Scatterings has(splitOf(scene, from));
        if (!has.quasiSpecularLobes && !has.quasiSpecularMedia) return {}; // the variants are one
        next.variant = from.variant == Variant::main ? Variant::alternative : Variant::main;
        // With nothing genuine diffuse, the other variant is a candidate of splits.
        if (freedom.split && (isStandard(has, from.variant) || isStandard(has, next.variant))) return {};
        return {next};
    }
    case Coordinate::photons: {
        RenderSettings fewer = from;
        next.photonsPerPass = static_cast<unsigned>(photonsStep * photons);
        fewer.photonsPerPass = std::max(1u, static_cast<unsigned>(photons / photonsStep));
        return {next, fewer};
    }
    case Coordinate::radius: {
        RenderSettings smaller = from;
        next.radiusScale = from.radiusScale * radiusStep;
        smaller.radiusScale = from.radiusScale / radiusStep;
        return {next, smaller};
    }
    }
    return {};
}

std::array<Coordinate, 5> searchOrder(const RenderSettings& start) {
    using enum Coordinate;
    return start.bdd > 0 ? std::array{bdd, split, variant, photons, radius}
                         : std::array{split, variant, photons, radius, bdd};
}

std::vector<std::string> firstCandidates(const Freedom& freedom, const RenderSettings& start, unsigned photons,
                                         const Scene& scene) {
    std::vector<std::string> texts;
    for (const Coordinate coordinate : searchOrder(start)) {
        for (const auto& next : neighbours(coordinate, start, photons, scene, freedom))
            texts.push_back(text(next, next.photonsPerPass > 0 ? next.photonsPerPass : photons));
    }
    return texts;
}

std::string kernelKey(const RenderSettings& settings, const Scene& scene) {
    const Scatterings has(splitOf(scene, settings));
    return fmt::format("{} {} {} {} {}", name(settings.variant), has.diffuseLobes, has.quasiSpecularLobes,
                       has.diffuseMedia, has.quasiSpecularMedia);
}

std::string text(const RenderSettings& settings, unsigned photons) {
    return fmt::format("BDD {}, {}, split {}, {} photons/pass, radius {:.3g}", settings.bdd, name(settings.variant),
                       settings.quasiSpecular, photons, settings.radiusScale);
}

} // namespace quasilux

#include "auto/candidates.h"

#include "prepare/split.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace quasilux {

namespace {

constexpr size_t mostSingleLobes = 4;

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

std::string splitKey(const Split& split) {
    std::string key;
    forEachLobe(split, [&](unsigned scattering) { key += fmt::format("{} ", scattering); });
    for (const auto& medium : split.media) key += fmt::format("{} ", medium.level);
    return key;
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

std::vector<RenderSettings> otherSplits(const RenderSettings& from, const Scene& scene) {
    std::vector<std::string> splits{"auto"};
    if (!scene.media.empty()) splits.insert(splits.end(), {"level:0.1", "level:0.3", "level:0.03"});
    splits.insert(splits.end(), {"none", "all"});
    for (const auto& lobe : singleLobes(scene)) splits.push_back(lobe);
    std::vector<std::string> known{splitKey(splitOf(scene, from))};
    std::vector<RenderSettings> found;
    for (const auto& split : splits) {
        RenderSettings next = from;
        next.quasiSpecular = split;
        next.quasiSpecularFromCommandLine = true;
        const std::string key = splitKey(splitOf(scene, next));
        if (std::find(known.begin(), known.end(), key) != known.end()) continue;
        known.push_back(key);
        found.push_back(next);
    }
    return found;
}

} // namespace

std::vector<RenderSettings> neighbours(Coordinate coordinate, const RenderSettings& from, unsigned photons,
                                       const Scene& scene) {
    RenderSettings next = from;
    switch (coordinate) {
    case Coordinate::bdd:
        next.bdd = from.bdd == 0 ? 1 : 0;
        return {next};
    case Coordinate::split:
        return otherSplits(from, scene);
    case Coordinate::variant: {
        const Scatterings has(splitOf(scene, from));
        if (!has.quasiSpecularLobes && !has.quasiSpecularMedia) return {}; // the variants are one
        next.variant = from.variant == Variant::main ? Variant::alternative : Variant::main;
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

bool isFree(Coordinate coordinate, const Freedom& freedom) {
    const bool free[] = {freedom.split, freedom.bdd, freedom.variant, freedom.photons, freedom.radius};
    return free[static_cast<size_t>(coordinate)];
}

std::vector<std::string> firstCandidates(const Freedom& freedom, const RenderSettings& start, unsigned photons,
                                         const Scene& scene) {
    std::vector<std::string> texts;
    for (const Coordinate coordinate : searchOrder(start)) {
        if (!isFree(coordinate, freedom)) continue;
        for (const auto& next : neighbours(coordinate, start, photons, scene))
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

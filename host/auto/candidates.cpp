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
    return {decideSplit(scene, settings.quasiSpecular, settings.quasiSpecularOverridesScene),
            decideMediumSplit(scene, settings.quasiSpecular, settings.quasiSpecularOverridesScene)};
}

template <typename Visit>
void forEachLobe(const Split& split, const Visit& visit) {
    for (const auto& bsdf : split.bsdfs)
        for (const auto* side : {&bsdf.front, &bsdf.back})
            for (const auto& lobe : *side) visit(lobe.scattering);
}

// What there is of each kind of scattering; the level itself is data to the kernels.
struct Scatterings {
    bool diffuseLobes = false, quasiSpecularLobes = false, specularLobes = false;
    bool diffuseMedia = false, quasiSpecularMedia = false;

    explicit Scatterings(const Split& split) {
        forEachLobe(split, [&](unsigned scattering) {
            diffuseLobes |= scattering == SCATTER_GENUINE_DIFFUSE;
            quasiSpecularLobes |= scattering == SCATTER_QUASI_SPECULAR;
            specularLobes |= scattering == SCATTER_SPECULAR;
        });
        for (const auto& medium : split.media) {
            diffuseMedia |= medium.level > 0;
            quasiSpecularMedia |= !std::isinf(medium.level);
        }
    }
    bool anyQuasiSpecular() const { return quasiSpecularLobes || quasiSpecularMedia; }
};

Features featuresOf(const Scatterings& has) {
    Features features;
    features.genuineDiffuse = has.diffuseLobes;
    features.quasiSpecular = has.quasiSpecularLobes;
    features.specular = has.specularLobes;
    features.genuineDiffuseMedia = has.diffuseMedia;
    features.quasiSpecularMedia = has.quasiSpecularMedia;
    return features;
}

// Of photons that some camera path can use.
unsigned classesOf(const Scatterings& has, const RenderSettings& settings) {
    return photonClasses(featuresOf(has), settings);
}

// Can camera paths find the caustic light, and is there any? How much is seen in the film's components.
bool mayFindCaustics(const Scene& scene, const RenderSettings& settings) {
    if (!settings.film.components || settings.caustics == CausticLight::paths) return false;
    const Scatterings has(splitOf(scene, settings));
    return has.specularLobes && whyNotCausticsByPaths(scene, featuresOf(has), settings).empty();
}

// With nothing genuine diffuse the main variant is the standard method with BDD 0, as if everything were
// (docs/method/theory.md).
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
                if (lobe.device.scattering == SCATTER_SPECULAR || LOBE_IS_BROAD(lobe.device.type)) continue;
                if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
            }
    if (names.size() < 2 || names.size() > mostSingleLobes) names.clear();
    return names;
}

// In the order in which they are tried, as short renders have no time for all: what follows everything, by the
// alternative variant plain path tracing, which a short render in open light should never miss; those that follow as
// much as possible; then those that follow little, which seldom win.
std::vector<std::string> firstSplits(const Scene& scene, const RenderSettings& start) {
    std::vector<std::string> splits{start.quasiSpecular, "all", "auto"};
    if (!scene.media.empty()) splits.insert(splits.end(), {"level:0.1", "level:0.3", "level:0.03"});
    return splits;
}

std::vector<std::string> lastSplits(const Scene& scene) {
    std::vector<std::string> splits = singleLobes(scene);
    splits.push_back("none");
    return splits;
}

// The same method may have several names; `known` has the keys of those met so far.
class MethodList {
public:
    MethodList(const Scene& scene, std::vector<RenderSettings>& methods) : scene_(scene), methods_(methods) {}

    void add(const RenderSettings& settings) {
        const Split split = splitOf(scene_, settings);
        const Scatterings has(split);
        const bool variantsAreOne = !has.anyQuasiSpecular() || (settings.bdd == 0 && isStandard(has, settings.variant));
        // BDD counts genuine diffuse events, and those of the standard method.
        const bool bddMatters = has.diffuseLobes || has.diffuseMedia || settings.variant == Variant::main;
        const std::string key =
            fmt::format("{} {} {} {}", bddMatters ? settings.bdd : 0, variantsAreOne ? "" : name(settings.variant),
                        name(settings.caustics), splitKey(split, settings.variant, settings.bdd));
        if (std::find(known_.begin(), known_.end(), key) != known_.end()) return;
        known_.push_back(key);
        methods_.push_back(settings);
    }

private:
    const Scene& scene_;
    std::vector<RenderSettings>& methods_;
    std::vector<std::string> known_;
};

// The main one may be much noisier than short trials show, and is seldom the better one.
std::vector<Variant> variantsOf(const RenderSettings& start, const Freedom& freedom) {
    if (!freedom.variant) return {start.variant};
    return {Variant::alternative, Variant::main};
}

} // namespace

RenderSettings searchStart(const RenderSettings& settings, const Scene& scene, const Freedom& freedom,
                           const StopRule& stop) {
    if (!whyNotSearched(scene, settings, stop).empty()) return settings;
    RenderSettings start = settings;
    if (freedom.photons && settings.photonsPerPass == 0)
        start.photonsPerPass = photonsForPixels(flattenCamera(scene.sensor), fewestPhotonsAtStart);
    for (const auto& method : methods(settings, scene, freedom))
        start.furtherClasses |= classesOf(Scatterings(splitOf(scene, method)), method);
    return start;
}

std::vector<RenderSettings> methods(const RenderSettings& start, const Scene& scene, const Freedom& freedom) {
    std::vector<RenderSettings> found;
    MethodList list(scene, found);
    list.add(start);
    // Where paths can find the caustics they mostly should: first of both, as short renders have no time for all.
    const auto add = [&](const RenderSettings& method) {
        if (freedom.caustics && mayFindCaustics(scene, method)) {
            RenderSettings byPaths = method;
            byPaths.caustics = CausticLight::paths;
            list.add(byPaths);
        }
        list.add(method);
    };
    const auto addSplits = [&](std::vector<std::string> splits) {
        if (!freedom.split) splits = {start.quasiSpecular};
        for (const unsigned bdd : freedom.bdd ? std::vector{0u, 1u} : std::vector{start.bdd})
            for (const Variant variant : variantsOf(start, freedom))
                for (const auto& split : splits) {
                    // That comes to the standard method, which is among those tried last.
                    if (bdd == 0 && split == "all" && variant == Variant::main && freedom.variant) continue;
                    RenderSettings method = start;
                    method.bdd = bdd;
                    method.variant = variant;
                    if (split != start.quasiSpecular) {
                        method.quasiSpecular = split;
                        method.quasiSpecularOverridesScene = true;
                    }
                    add(method);
                }
    };
    addSplits(firstSplits(scene, start));
    addSplits(lastSplits(scene));
    return found;
}

std::vector<RenderSettings> numbersBeside(const RenderSettings& from, unsigned photons, const Freedom& freedom) {
    std::vector<RenderSettings> found;
    const auto add = [&](double photonsFactor, double radiusFactor) {
        RenderSettings next = from;
        if (photonsFactor != 1) next.photonsPerPass = std::max(1u, static_cast<unsigned>(photonsFactor * photons));
        next.radiusScale *= radiusFactor;
        found.push_back(next);
    };
    if (freedom.photons)
        for (const double factor : {1 / photonsStep, photonsStep}) add(factor, 1);
    if (freedom.radius)
        for (const double factor : {1 / radiusStep, radiusStep}) add(1, factor);
    return found;
}

std::vector<std::string> firstCandidates(const Freedom& freedom, const RenderSettings& start, unsigned photons,
                                         const Scene& scene) {
    auto candidates = methods(start, scene, freedom);
    candidates.erase(candidates.begin());
    const auto numbers = numbersBeside(start, photons, freedom);
    candidates.insert(candidates.end(), numbers.begin(), numbers.end());
    std::vector<std::string> texts;
    texts.reserve(candidates.size());
    for (const auto& next : candidates)
        texts.push_back(text(next, next.photonsPerPass > 0 ? next.photonsPerPass : photons));
    return texts;
}

std::string text(const RenderSettings& settings, unsigned photons) {
    std::string method = fmt::format("BDD {}, {}, split {}, {} photons/pass, radius {:.3g}", settings.bdd,
                                     name(settings.variant), settings.quasiSpecular, photons, settings.radiusScale);
    if (settings.caustics == CausticLight::paths) method += ", caustics by paths";
    const bool isAdaptive = settings.cameraSampling == CameraSampling::adaptive;
    if (settings.cameraPaths == 1) return method;
    return fmt::format("{}, {} camera paths{}", method, settings.cameraPaths, isAdaptive ? " (adaptive)" : "");
}

} // namespace quasilux

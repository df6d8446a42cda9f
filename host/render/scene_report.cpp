#include "render/scene_report.h"

#include "render/learned_scene.h"
#include "render/method.h"
#include "util/checksum.h"
#include "util/error.h"

#include <cmath>

namespace quasilux {

namespace {

std::string scatteringName(unsigned scattering) {
    if (scattering == SCATTER_SPECULAR) return "specular";
    return scattering == SCATTER_QUASI_SPECULAR ? "quasi-specular" : "genuine diffuse";
}

void describeLobes(const Bsdf& bsdf, const char* side, const std::vector<LobeDescription>& lobes,
                   const std::vector<LobeDecision>& decisions, SceneReport& report) {
    for (size_t k = 0; k < lobes.size(); ++k)
        report.lobes.push_back(
            {bsdf.id, lobes[k].name + side, scatteringName(decisions[k].scattering), decisions[k].why});
}

void describeMedia(const Scene& scene, const DeviceScene& flat, const RenderSettings& settings, SceneReport& report) {
    for (size_t k = 0; k < flat.media.size(); ++k) {
        SceneReport::MediumRow row;
        row.medium = scene.media[k].id;
        row.level = flat.mediumSplit[k].level;
        row.why = flat.mediumSplit[k].why;
        row.kernelRadius = settings.radiusScale * flat.media[k].kernelRadius[LIGHT_DIFFUSE];
        row.kernelHalfHeight = settings.radiusScale * flat.media[k].kernelHalfHeight[LIGHT_DIFFUSE];
        report.media.push_back(row);
    }
}

} // namespace

std::string slotName(unsigned slot) {
    return slot < LIGHT_CLASSES ? componentName(slot) : "volume " + componentName(slot - LIGHT_CLASSES);
}

void requireSame(const SceneChecksums& expected, const SceneChecksums& found) {
    std::string parts;
    for (const auto& [part, checksum] : expected)
        if (const auto other = found.find(part); other == found.end() || other->second != checksum)
            parts += (parts.empty() ? "" : "; ") + part;
    if (!parts.empty()) throw InputError("the scene is another one, it differs in: " + parts);
}

SceneChecksums checksumsOf(const DeviceScene& flat, int maxDepth) {
    Checksum geometry, materials, camera;
    geometry.add(flat.bvh.nodes);
    geometry.add(flat.bvh.blocks);
    materials.add(flat.tables);
    camera.add(&flat.camera, sizeof flat.camera);
    camera.add(&flat.offsets, sizeof flat.offsets);
    camera.add(&maxDepth, sizeof maxDepth);
    camera.add(&flat.features.hiddenEmitters, sizeof flat.features.hiddenEmitters);
    camera.add(&flat.features.countedPassages, sizeof flat.features.countedPassages);
    camera.add(&flat.features.hiddenBeyondPassages, sizeof flat.features.hiddenBeyondPassages);
    return {{"geometry", geometry.text()},
            {"materials, textures or emitters", materials.text()},
            {"camera, film or depth", camera.text()}};
}

SceneReport describeScene(const Scene& scene, const DeviceScene& flat, const RenderSettings& settings) {
    SceneReport report;
    report.warnings = flat.warnings;
    report.triangles = flat.triangles;
    report.spheres = flat.spheres;
    report.patches = flat.patches;
    report.borderSegments = flat.borderSegments;
    report.instances = flat.instances;
    report.features = compiledFeatures(flat, settings).names();
    for (size_t k = 0; flat.emitters.hasLight && k < flat.emitters.emitters.size(); ++k)
        report.emitters.push_back({flat.emitters.ids[k], emitterTypeName(flat.emitters.emitters[k].type),
                                   flat.emitters.power[k], flat.emitters.radiance[k]});
    for (size_t k = 0; k < scene.bsdfs.size(); ++k) {
        describeLobes(scene.bsdfs[k], "", scene.bsdfs[k].front, flat.split[k].front, report);
        describeLobes(scene.bsdfs[k], " (behind)", scene.bsdfs[k].back, flat.split[k].back, report);
    }
    report.photonsPerPass = photonsPerPass(settings, flat.camera);
    describeMedia(scene, flat, settings, report);
    for (unsigned slot = 0; slot < PHOTON_SLOTS; ++slot)
        if (photonClasses(flat.features, settings) >> slot & 1) report.photonClasses.push_back(slotName(slot));
    return report;
}

SceneReport::Learned describeLearned(const LearnedScene& learned, const shared::RadiusField& field, unsigned photons) {
    const LearnedTables& tables = learned.tables;
    SceneReport::Learned row;
    row.isGuided = tables.guide.isGuided;
    row.leaves = tables.guide.leaves.size();
    for (const auto& source : tables.guide.sources) row.openings += source.halfU > 0;
    row.aims = tables.aims.size();
    for (const bool byPhotons : tables.directByPhotons) row.emittersByPhotons += byPhotons;
    row.hasWeightWindows = learned.usualWorth > 0;
    row.lightOfPhotons = learned.lightOfPhotons;
    if (learned.effectiveShare >= 0) row.effectivePhotons = learned.effectiveShare * photons;
    for (unsigned k = 0; field.octaves > 0 && k <= field.octaves; ++k)
        row.radiusFactors.emplace_back(field.nearest * std::exp2(k), field.factor[k]);
    row.seconds = learned.seconds;
    return row;
}

} // namespace quasilux

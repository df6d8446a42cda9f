#include "prepare/device_scene.h"

#include "prepare/border_surface.h"
#include "prepare/direct_sharing.h"
#include "prepare/filter_table.h"
#include "prepare/scene_geometry.h"
#include "prepare/scene_tables.h"
#include "util/bit_words.h"

#include <cmath>
#include <cstring>
#include <fmt/format.h>

namespace quasilux {

namespace {

/// Whether surfaces go round it; those that only stand in it end it nowhere.
bool hasBorder(const Scene& scene, unsigned medium) {
    return std::any_of(scene.shapes.begin(), scene.shapes.end(),
                       [&](const ShapeDescription& shape) { return shape.interior == medium; });
}

void findMediumFeatures(const Scene& scene, const std::vector<shared::Medium>& media, const EmitterTables& emitters,
                        const MediumPlacement& placement, Features& features) {
    features.media = !media.empty();
    for (const auto& medium : media) {
        features.phases.insert(medium.phase);
        features.chromaticMedia |= medium.sigmaT.r != medium.sigmaT.g || medium.sigmaT.r != medium.sigmaT.b;
        features.heterogeneousMedia |= medium.extinctionGrid != 0;
        features.genuineDiffuseMedia |= medium.level > 0;
        features.quasiSpecularMedia |= std::isfinite(medium.level);
    }
    // Fog without a border, which only the camera or a meter says it stands in.
    std::vector<unsigned> origins = placement.grids;
    origins.push_back(placement.camera);
    for (const unsigned medium : origins)
        features.directInMedia |= medium < MEDIUM_UNCHANGED && !hasBorder(scene, medium);
    // What neither is null nor has holes lets no direct light pass: it comes as caustic photons.
    for (const auto& emitter : emitters.emitters) features.directInMedia |= emitter.medium != MEDIUM_NONE;
    for (const auto& shape : scene.shapes)
        features.directInMedia |=
            scene.bsdfs[static_cast<size_t>(shape.bsdf)].letsPass() && (shape.interior || shape.exterior);
}

Features findFeatures(const Scene& scene, const MaterialTables& materials, const EmitterTables& emitters,
                      const std::vector<shared::Medium>& media, const MediumPlacement& placement,
                      const std::vector<BorderTree>& borders) {
    Features features;
    for (const auto& lobe : materials.lobes) {
        features.lobes.insert(lobe.type);
        features.genuineDiffuse |= lobe.scattering == SCATTER_GENUINE_DIFFUSE;
        features.quasiSpecular |= lobe.scattering == SCATTER_QUASI_SPECULAR;
        features.specular |= lobe.scattering == SCATTER_SPECULAR && !LOBE_PASSES(lobe.type);
        features.textures |= lobe.reflectanceTexture != 0 || lobe.transmittanceTexture != 0 || lobe.weightCount > 0;
        features.lobeWeights |= lobe.weightCount > 0;
        features.indexTextures |= lobe.etaTexture != 0 || lobe.kTexture != 0;
        features.lowCoats |= lobe.type == LOBE_ROUGHCOATEDLAMBERT && lobe.alphaV != 0;
    }
    for (const auto& weight : materials.weights) features.weightFunctions |= weight.function != WEIGHT_VALUE;
    for (const auto& material : materials.materials)
        features.manyLobes |= std::max(material.frontCount, material.backCount) > LOBES_MAX;
    for (const auto& bsdf : scene.bsdfs) features.anisotropy |= bsdf.isAnisotropic();
    features.relief = !materials.reliefs.empty();
    features.alphaTextures = !materials.roughness.empty();
    features.textures |= features.relief || features.alphaTextures || features.indexTextures;
    for (const auto& emitter : emitters.emitters) {
        features.emitterTypes.insert(emitter.type);
        features.emitterTextures |= emitter.texture > 0;
        features.areaTextures |= emitter.texture > 0 && emitter.shape != QL_NONE;
    }
    features.lightTree = !emitters.lightTree.empty();
    findMediumFeatures(scene, media, emitters, placement, features);
    for (const auto& shape : scene.shapes) {
        features.spheres |= shape.sphere.has_value();
        features.cornerNormals |= !shape.mesh.cornerNormals.empty();
        features.nullPrimitives |= scene.bsdfs[static_cast<size_t>(shape.bsdf)].isNull;
    }
    features.borders =
        std::any_of(borders.begin(), borders.end(), [](const BorderTree& tree) { return tree.segmentCount > 0; });
    features.instances = !scene.instances.empty();
    features.depthLimit = scene.maxDepth >= 0;
    features.hiddenEmitters = hidesEmitters(scene);
    features.countedPassages =
        scene.countsPassages && (features.depthLimit || features.hiddenEmitters) &&
        (features.nullPrimitives || features.lobes.count(LOBE_PASSAGE) > 0 || features.lobes.count(LOBE_PANE) > 0);
    features.hiddenBeyondPassages = features.hiddenEmitters && features.countedPassages && scene.hidesBeyondPassages;
    features.orthographicCamera = scene.sensor.orthographic;
    features.fisheyeCamera = scene.sensor.fisheye != FISHEYE_NONE;
    features.thinLens = scene.sensor.apertureRadius > 0;
    features.filterTable = needsFilterTable(scene.sensor);
    features.sharedFilter = gainsBySharing(scene.sensor);
    features.radianceMeter = scene.sensor.meter == MeterKind::ray;
    features.irradianceMeter = isIrradiance(scene.sensor.meter);
    return features;
}

// The lobe of an irradiance meter: what it reflects is what arrives. Returns its index.
unsigned appendWhite(std::vector<shared::Lobe>& lobes) {
    shared::Lobe white{};
    white.type = LOBE_LAMBERT;
    white.scattering = SCATTER_GENUINE_DIFFUSE;
    white.reflectance = {1, 1, 1};
    lobes.push_back(white);
    return static_cast<unsigned>(lobes.size() - 1);
}

// The density radius stays below half the radius of curvature, where a surface is close to its tangent plane.
std::vector<float> patchRadii(const SurfaceBorders& borders) {
    std::vector<float> radii;
    for (unsigned k = 0; k < borders.patchCount; ++k) {
        const float curvature = borders.patchCurvature[k];
        radii.push_back(curvature > 0 ? 0.5f / curvature : INFINITY);
    }
    return radii;
}

// What is learned follows the scene's tables: room for it, so that these are not moved for it.
constexpr size_t wordsToSpare = 1 << 22;

// Last and without a copy of their own: large textures are most of a scene.
unsigned appendTexels(const std::vector<Texels>& images, SceneTableWriter& tables) {
    size_t texels = 0;
    for (const Texels& image : images) texels += image.size();
    tables.reserve(texels * sizeof(Rgb) / sizeof(uint32_t) + wordsToSpare);
    const unsigned first = tables.append(std::vector<Rgb>{});
    for (const std::vector<Rgb>& image : images) tables.append(image);
    return first;
}

/// `Places`: where they are said, of the world or of a group.
template <typename Places>
void appendBorders(const SurfaceBorders& borders, const BorderTree& tree, SceneTableWriter& tables, Places& places) {
    places.borderLeaves = tables.append(tree.leaves);
    places.borderNodes = tables.append(tree.nodes);
    places.borderNodeCount = static_cast<unsigned>(tree.nodes.size());
    places.patchNodes = tables.append(tree.nodeOfPatch);
    places.patchRadius = tables.append(patchRadii(borders));
}

/// Borders of the world and of groups, and the instances of these.
void appendAllBorders(const Scene& scene, const SceneGeometry& geometry, SceneTableWriter& tables, SceneTree& tree,
                      shared::SceneTables& offsets) {
    const SurfaceBorders& borders = geometry.borders;
    appendBorders(borders, geometry.borderTrees.front(), tables, offsets);
    std::vector<shared::ShapeGroup> groups(borders.groups.size());
    for (size_t k = 0; k < groups.size(); ++k)
        appendBorders(borders.groups[k], geometry.borderTrees[k + 1], tables, groups[k]);
    appendInstances(scene, borders, groups, tree);
    offsets.patchCount = borders.patchCount;
    offsets.instances = tree.firstInstance;
    offsets.instanceCount = static_cast<unsigned>(scene.instances.size());
    offsets.instanceRoot = tree.instanceRoot;
}

void appendTextures(const Scene& scene, const TextureTables& textures, SceneTableWriter& tables, DeviceScene& out) {
    out.offsets.textures = tables.append(textures.textures);
    out.offsets.uvs = tables.append(flattenUvs(scene));
    out.offsets.attributes = tables.append(textures.attributes);
    out.features.nestedTextures = textures.areNested;
    out.features.meshAttributes = textures.haveAttributes;
    out.features.textureVolumes = textures.haveVolumes;
}

void appendEmitters(EmitterTables& emitters, SceneTableWriter& tables, shared::SceneTables& offsets) {
    offsets.emitters = tables.append(emitters.emitters);
    offsets.emitterTriangles = tables.append(emitters.triangles);
    offsets.environment = tables.append(emitters.environment);
    emitters.environment = {}; // it is large
    offsets.goniograms = tables.append(emitters.goniograms);
    offsets.emitterCount = static_cast<unsigned>(emitters.emitters.size());
    offsets.lightTree = tables.append(emitters.lightTree);
    offsets.lightTreeCount = emitters.countInTree();
}

/// `lobe`: of an irradiance meter.
void appendMeter(const MeterTables& meter, unsigned lobe, SceneTableWriter& tables, shared::SceneTables& offsets) {
    offsets.meter = meter.meter;
    offsets.meter.lobe = lobe;
    offsets.meter.primitives = meter.grids.empty() ? tables.append(meter.primitives) : tables.append(meter.grids);
}

// For reports.
void countParts(const Scene& scene, const SceneGeometry& geometry, DeviceScene& out) {
    for (const auto& shape : scene.shapes) {
        out.triangles += shape.mesh.triangles.size();
        out.spheres += shape.sphere ? 1 : 0;
    }
    out.patches = geometry.borders.patchCount;
    for (const SurfaceBorders& group : geometry.borders.groups) out.patches += group.patchCount;
    for (const BorderTree& tree : geometry.borderTrees) out.borderSegments += tree.segmentCount;
    out.instances = scene.instances.size();
    for (const double power : out.emitters.power) out.emittedFlux += power;
}

unsigned shapeOfPrimitive(const Scene& scene, unsigned primitive) {
    unsigned shape = 0;
    while (primitive >= primitiveCount(scene.shapes[shape])) primitive -= primitiveCount(scene.shapes[shape++]);
    return shape;
}

std::string warningOfOverlap(const Scene& scene, const SurfaceBorders& borders) {
    const auto& first = scene.shapes[shapeOfPrimitive(scene, borders.overlap->first)];
    const auto& second = scene.shapes[shapeOfPrimitive(scene, borders.overlap->second)];
    const glm::dvec3 place = borders.overlap->place + scene.origin;
    return fmt::format("{}: shapes '{}' and '{}' lie in one plane, face the same way and overlap near ({:.6g}, {:.6g}, "
                       "{:.6g}): which of them a ray meets is left to rounding, and light there comes out wrong. "
                       "Remove one of them, or move it by a thousandth of its size.",
                       second.where.text(), first.id, second.id, place.x, place.y, place.z);
}

std::vector<std::string> findWarnings(const Scene& scene, const SurfaceBorders& borders) {
    std::vector<std::string> warnings;
    if (borders.overlap) warnings.push_back(warningOfOverlap(scene, borders));
    const auto& fog = scene.sensor.medium;
    if (fog && !hasBorder(scene, *fog) && !scene.media[*fog].extinction &&
        (scene.surroundings || !scene.directionalEmitters.empty()))
        warnings.push_back(fmt::format("{}: the sensor stands in a medium without a border, and light from outside of "
                                       "the scene (sky, parallel light) has no way through it: photons begin at the "
                                       "scene, shadow rays never arrive. Give the medium a border, such as a large "
                                       "sphere with bsdf 'null' and the medium as its interior.",
                                       scene.sensor.where.text()));
    return warnings;
}

void setDirectByPhotons(DeviceScene& scene, const std::vector<bool>& byPhotons) {
    auto& emitters = scene.emitters.emitters;
    std::vector<shared::Emitter> sampled;
    size_t sampledByAll = 0;
    for (size_t k = 0; k < emitters.size(); ++k) {
        emitters[k].directByPhotons = k < byPhotons.size() && byPhotons[k];
        sampledByAll += !emitters[k].directByPhotons;
        // Quasi-specular lobes sample the others, too.
        if (!emitters[k].directByPhotons || scene.hasBroadQuasiSpecular) sampled.push_back(emitters[k]);
    }
    std::memcpy(scene.tables.data() + scene.offsets.emitters, emitters.data(),
                emitters.size() * sizeof(shared::Emitter));
    scene.offsets.emittersSampled = static_cast<unsigned>(sampledByAll);
    scene.offsets.directSharing = directSharing(sampled, scene.surfaceArea, scene.features.irradianceMeter);
}

} // namespace

void setLearned(DeviceScene& scene, const LearnedTables& learned) {
    scene.tables.resize(scene.sceneWords);
    SceneTableWriter tables(std::move(scene.tables));
    scene.offsets.learned.leaves = tables.append(learned.guide.leaves);
    scene.offsets.learned.leafCount = static_cast<unsigned>(learned.guide.leaves.size());
    scene.offsets.learned.sources = tables.append(learned.guide.sources);
    scene.offsets.learned.importance = learned.importance;
    const bool isKnown = !learned.importanceCells.empty();
    scene.offsets.learned.importance.cells = isKnown ? tables.append(learned.importanceCells) : QL_NONE;
    auto& grid = scene.offsets.learned.importance;
    grid.seen = learned.seenCells.empty() ? QL_NONE : tables.append(learned.seenCells);
    grid.seenMask = static_cast<unsigned>(bitsOfWord * learned.seenCells.size() - 1);
    scene.offsets.learned.aims = tables.append(learned.aims);
    scene.offsets.learned.aimCount = static_cast<unsigned>(learned.aims.size());
    scene.offsets.learned.aimSets = static_cast<unsigned>(
        std::count_if(learned.aims.begin(), learned.aims.end(), [](const auto& aim) { return aim.count > 0; }));
    scene.offsets.learned.lights = learned.lights.empty() ? QL_NONE : tables.append(learned.lights);
    scene.offsets.learned.laterLights = static_cast<unsigned>(learned.laterLights.size() / LIGHT_CHOICES);
    tables.append(learned.laterLights); // each as many places behind its own
    scene.offsets.learned.lightBlockSize = learned.lightBlockSize;
    scene.offsets.learned.lightBlockColumns =
        (scene.camera.width + learned.lightBlockSize - 1) / learned.lightBlockSize;
    scene.offsets.learned.directEnvironment = learned.directEnvironment;
    scene.tables = std::move(tables).take();
    setDirectByPhotons(scene, learned.directByPhotons);
    scene.isGuided = learned.guide.isGuided;
    scene.typicalFlux = learned.guide.typicalFlux;
}

DeviceScene flattenScene(const Scene& scene, const FlattenSettings& settings, const SceneGeometry* known) {
    DeviceScene out;
    out.split = decideSplit(scene, settings.quasiSpecular, settings.overridesScene);
    out.mediumSplit = decideMediumSplit(scene, settings.quasiSpecular, settings.overridesScene);
    const auto placement = placeMedia(scene);
    const auto media = flattenMedia(scene, out.mediumSplit, settings.photons);
    out.media = media.media;
    out.emitters = flattenEmitters(scene, placement);
    auto materials = flattenMaterials(scene, out.split);
    const unsigned meterLobe = isIrradiance(scene.sensor.meter) ? appendWhite(materials.lobes) : QL_NONE;
    SceneGeometry own;
    if (!known) own = prepareGeometry(scene);
    const SceneGeometry& geometry = known ? *known : own;
    SceneTree tree; // instances are written into it
    if (known)
        tree = known->tree;
    else
        tree = std::move(own.tree);
    out.warnings = findWarnings(scene, geometry.borders);
    out.surfaceArea = scatteringArea(scene);
    out.hasBroadQuasiSpecular =
        std::any_of(materials.lobes.begin(), materials.lobes.end(), [](const shared::Lobe& lobe) {
            return LOBE_IS_BROAD(lobe.type) && lobe.scattering == SCATTER_QUASI_SPECULAR;
        });
    out.features = findFeatures(scene, materials, out.emitters, out.media, placement, geometry.borderTrees);
    out.offsets.directSharing = directSharing(out.emitters.emitters, out.surfaceArea, out.features.irradianceMeter);
    out.features.sharingLambert = out.offsets.directSharing & DIRECT_SHARING_LAMBERT;
    out.features.sharingMedia = out.features.media && out.offsets.directSharing & DIRECT_SHARING_MEDIA;

    SceneTableWriter tables;
    out.offsets.primitives = tables.append(flattenPrimitiveInfo(scene, geometry.borders));
    out.offsets.shapes = tables.append(flattenShapes(scene, out.emitters.emitterOfShape, placement));
    out.offsets.cornerNormals = tables.append(flattenCornerNormals(scene));
    out.offsets.materials = tables.append(materials.materials);
    out.offsets.lobes = tables.append(materials.lobes);
    const TextureTables textures = flattenTextures(scene, materials, out.emitters);
    appendTextures(scene, textures, tables, out);
    out.offsets.media = appendMedia(media, tables);
    out.offsets.reliefs = tables.append(materials.reliefs);
    out.offsets.roughness = tables.append(materials.roughness);
    out.offsets.lobeWeights = tables.append(materials.weights);
    out.offsets.mediumPlanes = tables.append(media.planes);
    appendEmitters(out.emitters, tables, out.offsets);
    appendMeter(flattenMeter(scene, placement.camera, placement.grids), meterLobe, tables, out.offsets);
    const unsigned filterSteps = tables.append(filterTable(scene.sensor));
    appendAllBorders(scene, geometry, tables, tree, out.offsets);
    out.bvh = std::move(tree.bvh);
    out.offsets.texels = appendTexels(textures.images, tables);
    out.tables = std::move(tables).take();
    out.sceneWords = out.tables.size();
    out.camera = flattenCamera(scene.sensor, placement.camera);
    out.camera.filterSteps = filterSteps;
    LearnedTables nothing;
    nothing.guide = plainGuide(out.emitters);
    setLearned(out, nothing);
    countParts(scene, geometry, out);
    return out;
}

} // namespace quasilux

// Scene in, plain arrays of the kernels' structs out; no device needed. One function per table.
#pragma once

#include "pass_types.h"
#include "prepare/borders.h"
#include "prepare/bvh.h"
#include "prepare/features.h"
#include "prepare/guide_tables.h"
#include "prepare/media.h"
#include "prepare/split.h"

namespace quasilux {

class SceneTableWriter;
struct SceneGeometry;

struct EmitterTables {
    std::vector<shared::Emitter> emitters;
    std::vector<shared::EmitterTriangle> triangles;
    std::vector<shared::LightNode> lightTree; ///< over all but distant ones (light_tree.h); empty: there are few
    std::vector<uint32_t> environment;        ///< a shared::EnvironmentMap with its tables, or empty: there is none
    std::vector<uint32_t> goniograms;         ///< a shared::GoniogramTable with its tables for each luminaire type
    std::vector<unsigned> emitterOfShape;     ///< by shape, QL_NONE for none
    std::vector<double> power;                ///< W, mean of R, G, B
    std::vector<double> radiance; ///< mean of R, G, B, over what it sends; 0 where no path can meet the emitter
    std::vector<std::string> ids;
    bool hasLight = true; ///< false: the only one stands in for those that the scene lacks

    /// Emitters in the tree, the first ones; 0: there is none.
    unsigned countInTree() const { return static_cast<unsigned>((lightTree.size() + 1) / 2); }
};

struct DeviceScene {
    Bvh bvh;
    std::vector<uint32_t> tables;
    shared::SceneTables offsets{};
    shared::Camera camera{};
    Features features; // the meter is described by offsets.meter
    // For people:
    size_t triangles = 0, spheres = 0, patches = 0, borderSegments = 0, instances = 0;
    double surfaceArea = 0;             ///< of everything that scatters, scene units squared
    bool hasBroadQuasiSpecular = false; ///< some lobe as broad as Lambert's is followed like a mirror
    double emittedFlux = 0;             ///< W, mean of R, G, B
    size_t sceneWords = 0;              ///< of the tables, before what was learned
    bool isGuided = false;              ///< GuideTables::isGuided
    double typicalFlux = 0;             ///< GuideTables::typicalFlux
    EmitterTables emitters;
    std::vector<BsdfDecision> split;
    std::vector<MediumDecision> mediumSplit;
    std::vector<shared::Medium> media; ///< as in the tables
    std::vector<std::string> warnings; ///< "file:line:column: …": what comes out wrong as the scene is
};

struct FlattenSettings {
    std::string quasiSpecular = "auto"; ///< as decideSplit takes it
    unsigned photons = 0;               ///< emitted in a pass
    bool overridesScene = false;
};
/// `known`: prepareGeometry() of a scene with the same shapes, bsdfs and media; null: it is prepared here. The result is
/// the same.
DeviceScene flattenScene(const Scene& scene, const FlattenSettings& settings = {},
                         const SceneGeometry* known = nullptr);

/// Takes what was learned of the scene into its tables, instead of what they had.
struct LearnedTables {
    GuideTables guide;
    std::vector<bool> directByPhotons;       ///< by emitter, or empty: none
    std::vector<shared::LightChoice> lights; ///< LIGHT_CHOICES for each block of pixels, or empty: nothing is known
    std::vector<shared::LightChoice> laterLights; ///< the same for later events of the paths (laterLightBlock)
    unsigned lightBlockSize = 1;
    unsigned directEnvironment = 0;        ///< shared::Learned
    std::vector<shared::AimSource> aims;   ///< openings at which scattered photons are aimed
    shared::ImportanceGrid importance{};   ///< without `cells`
    std::vector<uint32_t> importanceCells; ///< none: nothing is known
    std::vector<uint32_t> seenCells;       ///< a power of two of words; none: nothing is known
};
void setLearned(DeviceScene& scene, const LearnedTables& learned);

/// Pieces of it, each a table.
std::vector<BvhPrimitive> flattenPrimitives(const Scene& scene, std::span<const ShapeDescription> shapes);
std::vector<shared::PrimitiveInfo> flattenPrimitiveInfo(const Scene& scene, const SurfaceBorders& borders);
std::vector<shared::Shape> flattenShapes(const Scene& scene, const std::vector<unsigned>& emitterOfShape,
                                         const MediumPlacement& placement);
std::vector<shared::Packed3> flattenCornerNormals(const Scene& scene);
struct MaterialTables {
    std::vector<shared::Material> materials;
    std::vector<shared::Lobe> lobes;
    std::vector<shared::LobeWeight> weights;
    std::vector<shared::Relief> reliefs;
    std::vector<shared::RoughnessLevels> roughness;
};
MaterialTables flattenMaterials(const Scene& scene, const std::vector<BsdfDecision>& split);
struct TextureTables {
    std::vector<shared::Texture> textures;
    std::vector<Texels> images;       ///< whose texels follow each other; shared with the scene, as they may be large
    std::vector<uint32_t> attributes; ///< and volumes, as shared::Texture has them
    bool areNested = false;           ///< some are within others
    bool haveAttributes = false, haveVolumes = false;
};
/// Only textures that `materials` or `emitters` use bring texels and attributes.
TextureTables flattenTextures(const Scene& scene, const MaterialTables& materials, const EmitterTables& emitters);
/// Whether layers of the image go by texture coordinates, so that all shapes show theirs.
bool hasUvLayers(const Scene& scene);
/// Words of a textured shape in the table of flattenUvs; 0 for others.
unsigned uvWords(const Scene& scene, const ShapeDescription& shape);
std::vector<float> flattenUvs(const Scene& scene);
EmitterTables flattenEmitters(const Scene& scene, const MediumPlacement& placement);
shared::Camera flattenCamera(const Sensor& sensor, unsigned medium = MEDIUM_NONE);
struct MeterTables {
    shared::Meter meter{}; ///< offsets into the scene tables, `lobe` and `samples` (render/method.h) are left open
    std::vector<shared::MeterPrimitive> primitives; ///< or of METER_GRID:
    std::vector<shared::MeterGrid> grids;
};
/// Where irradiance is measured; `medium` as flattenCamera takes it. Kind METER_NONE for a camera.
MeterTables flattenMeter(const Scene& scene, unsigned medium = MEDIUM_NONE,
                         const std::vector<unsigned>& gridMedia = {});
struct MediumTables {
    std::vector<shared::Medium> media;
    std::vector<shared::MediumPlane> planes;
    std::vector<shared::VolumeGrid> grids; ///< by volume of the scene; media name them by 1 + index until appendMedia
    std::vector<shared::PhasePart> parts;
    std::vector<float> values; ///< of grids and parts; their firstValue is an index until appendMedia
};
/// `photons` are emitted in a pass: they decide the first size of density kernels.
MediumTables flattenMedia(const Scene& scene, const std::vector<MediumDecision>& split, unsigned photons);
/// Media and what they refer to, each by its distance from the record that names it.
unsigned appendMedia(MediumTables media, SceneTableWriter& tables);
double scatteringArea(const Scene& scene);
/// Whether the camera looks through shapes that emit; irradiance meters do not.
bool hidesEmitters(const Scene& scene);
/// Whether a shape is no more than a place that light passes: a `null` bsdf that bounds no medium, and that no path
/// counts.
bool passesLight(const Scene& scene, const ShapeDescription& shape);

} // namespace quasilux

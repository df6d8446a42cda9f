// Scene in, plain arrays of the kernels' structs out; no device needed. One function per table.
#pragma once

#include "pass_types.h"
#include "prepare/borders.h"
#include "prepare/bvh.h"
#include "prepare/features.h"
#include "prepare/split.h"

#include <functional>

namespace quasilux {

struct EmitterTables {
    std::vector<shared::Emitter> emitters;
    std::vector<shared::EmitterTriangle> triangles;
    std::vector<unsigned> emitterOfShape; ///< by shape, QL_NONE for none
    std::vector<double> power;            ///< W, mean of R, G, B
    std::vector<std::string> ids;
};

struct DeviceScene {
    Bvh bvh;
    std::vector<uint32_t> tables;
    shared::SceneTables offsets{};
    shared::Camera camera{};
    Features features;
    // For people:
    size_t triangles = 0, spheres = 0, patches = 0, borderSegments = 0;
    double surfaceArea = 0; ///< of everything that scatters, scene units squared
    double emittedFlux = 0; ///< W, mean of R, G, B
    EmitterTables emitters;
    std::vector<BsdfDecision> split;
};

struct FlattenSettings {
    std::string quasiSpecular = "auto"; ///< as decideSplit takes it
    bool overridesScene = false;
    std::function<double(double area)>
        largestRadius; ///< of the density estimate, from the surface area: indexes the borders
};
DeviceScene flattenScene(const Scene& scene, const FlattenSettings& settings);

/// Pieces of it, each a table.
std::vector<BvhPrimitive> flattenPrimitives(const Scene& scene);
std::vector<shared::PrimitiveInfo> flattenPrimitiveInfo(const Scene& scene, const SurfaceBorders& borders);
std::vector<shared::Shape> flattenShapes(const Scene& scene, const std::vector<unsigned>& emitterOfShape);
std::vector<shared::Packed3> flattenCornerNormals(const Scene& scene);
struct MaterialTables {
    std::vector<shared::Material> materials;
    std::vector<shared::Lobe> lobes;
};
MaterialTables flattenMaterials(const Scene& scene, const std::vector<BsdfDecision>& split);
struct TextureTables {
    std::vector<shared::Texture> textures;
    std::vector<Rgb> texels;
};
/// Only textures that `lobes` use bring texels.
TextureTables flattenTextures(const Scene& scene, const std::vector<shared::Lobe>& lobes);
/// Words of a textured shape in the table of flattenUvs; 0 for others.
unsigned uvWords(const Scene& scene, const ShapeDescription& shape);
std::vector<float> flattenUvs(const Scene& scene);
EmitterTables flattenEmitters(const Scene& scene);
shared::Camera flattenCamera(const Sensor& sensor);
double scatteringArea(const Scene& scene);

} // namespace quasilux

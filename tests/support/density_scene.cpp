#include "support/density_scene.h"

#include "bench/micro/native_flux.h"
#include "support/photon_index.h"
#include "support/test_kernels.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace quasilux {

namespace {

using std::numbers::pi;

Scene withLambert(Scene scene) {
    Bsdf lambert;
    LobeDescription lobe;
    lobe.device.type = LOBE_LAMBERT;
    lobe.device.reflectance = {1, 1, 1};
    lobe.name = "diffuse";
    lobe.halfWidth = pi / 4;
    lambert.front.push_back(lobe);
    scene.bsdfs = {lambert};
    for (ShapeDescription& shape : scene.shapes) shape.bsdf = 0;
    return scene;
}

PhotonIndexSettings indexSettings(float radius, unsigned photons) {
    PhotonIndexSettings settings;
    settings.radius[LIGHT_DIFFUSE] = radius;
    settings.cells = std::max(256u, std::bit_ceil(photons / 4));
    settings.regions = 16;
    return settings;
}

/// A primitive whose points can be drawn uniformly.
struct Piece {
    unsigned primitive;
    double area;
    std::function<glm::dvec3(double, double)> point;
};

std::vector<Piece> piecesOf(const Scene& scene) {
    std::vector<Piece> pieces;
    unsigned primitive = 0;
    for (const ShapeDescription& shape : scene.shapes) {
        if (shape.sphere) {
            const glm::dvec3 center = shape.sphere->center;
            const double r = shape.sphere->radius;
            pieces.push_back({primitive++, 4 * pi * r * r, [=](double u, double v) {
                                  const double z = 1 - 2 * u, s = std::sqrt(std::max(0.0, 1 - z * z));
                                  return center + r * glm::dvec3(s * std::cos(2 * pi * v), s * std::sin(2 * pi * v), z);
                              }});
        }
        for (const glm::uvec3& t : shape.mesh.triangles) {
            const glm::dvec3 a = shape.mesh.positions[t.x], b = shape.mesh.positions[t.y],
                             c = shape.mesh.positions[t.z];
            pieces.push_back({primitive++, 0.5 * glm::length(glm::cross(b - a, c - a)), [=](double u, double v) {
                                  const double s = std::sqrt(u);
                                  return a + s * (1 - v) * (b - a) + s * v * (c - a);
                              }});
        }
    }
    return pieces;
}

} // namespace

DensityScene::DensityScene(Scene scene, float radius)
    : scene_(withLambert(std::move(scene))), radius_(radius), device_(flattenScene(scene_)),
      nodes_(testDevice(), device_.bvh.nodes, "tree nodes"), blocks_(testDevice(), device_.bvh.blocks, "primitives"),
      tables_(testDevice(), device_.tables, "scene tables") {}

unsigned DensityScene::patchOf(unsigned primitive) const {
    const size_t words = sizeof(shared::PrimitiveInfo) / sizeof(uint32_t);
    return device_.tables[device_.offsets.primitives + words * primitive +
                          offsetof(shared::PrimitiveInfo, patch) / sizeof(uint32_t)];
}

std::vector<RegionAnswer> DensityScene::regions(const std::vector<RegionQuery>& queries) {
    const auto options = photonIndexOptions(indexSettings(radius_, 0)) + device_.features.options();
    Program program = testProgram("density.cl", options);
    Buffer<RegionQuery> queryBuffer(testDevice(), queries, "queries");
    Buffer<RegionAnswer> answers(testDevice(), queries.size(), "regions");
    program.kernel("findRegions")
        .launch(queries.size(), nodes_, blocks_, tables_, queryBuffer, answers, device_.offsets,
                unsigned(queries.size()));
    return answers.read();
}

std::vector<Estimate> DensityScene::estimates(const std::vector<RegionQuery>& queries, const UniformPhotons& photons,
                                              const std::string& options) {
    auto settings = indexSettings(radius_, unsigned(photons.photons.size()));
    settings.fluxUnit = photons.fluxUnit;
    const PhotonIndex index = indexPhotons(photons.photons, settings);
    Program program =
        testProgram("density.cl", photonIndexOptions(settings) + device_.features.options() + ' ' + options);
    Buffer<RegionQuery> queryBuffer(testDevice(), queries, "queries");
    Buffer<Estimate> estimates(testDevice(), queries.size(), "estimates");
    program.kernel("estimate")
        .launch(queries.size(), nodes_, blocks_, tables_, index.cellStart, index.sorted, queryBuffer, estimates,
                device_.offsets, index.map, unsigned(queries.size()));
    return estimates.read();
}

UniformPhotons DensityScene::lightUp(unsigned count, const Hidden& hidden, std::mt19937& random) const {
    const std::vector<Piece> pieces = piecesOf(scene_);
    std::vector<double> areas;
    double area = 0;
    for (const Piece& piece : pieces) areas.push_back(piece.area), area += piece.area;
    std::discrete_distribution<size_t> choose(areas.begin(), areas.end());
    std::uniform_real_distribution<double> uniform(0, 1);
    UniformPhotons out;
    out.density = count / area;
    out.fluxUnit = float(area / count) * 8;
    std::uniform_int_distribution<uint32_t> rounding(0, (1u << 18) - 1);
    for (unsigned k = 0; k < count; ++k) {
        const Piece& piece = pieces[choose(random)];
        const double u = uniform(random), v = uniform(random);
        const glm::dvec3 p = piece.point(u, v);
        if (hidden && hidden(p, piece.primitive)) continue;
        TracedPhoton photon;
        photon.position = {float(p.x), float(p.y), float(p.z)};
        photon.flux = nativePackFlux({0.125f, 0.125f * float(5 + p.x), 0.125f}, rounding(random));
        photon.patchSide = patchOf(piece.primitive) << 1 | 1;
        photon.slot = LIGHT_DIFFUSE;
        out.photons.push_back(photon);
    }
    return out;
}

} // namespace quasilux

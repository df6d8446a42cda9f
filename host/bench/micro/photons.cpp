#include "bench/micro/photons.h"

#include "bench/micro/native_flux.h"
#include "bench/micro/ray_sets.h"

#include <random>

namespace quasilux {

namespace {

shared::Packed3 pack(const glm::vec3& v) { return {v.x, v.y, v.z}; }

/// Two triangles make a wall, which is lit from the side of its hits alone.
unsigned patchSideOf(const MicroHit& hit) { return hit.index() / 2 << 1 | 1; }

double areaOf(const std::vector<BvhPrimitive>& triangles) {
    double area = 0;
    for (const BvhPrimitive& triangle : triangles)
        area += 0.5 * glm::length(glm::cross(triangle.v1 - triangle.v0, triangle.v2 - triangle.v0));
    return area;
}

template <typename Take>
void forHits(const EmbreeScene& embree, const std::vector<MicroRay>& rays, const Take& take) {
    for (const MicroRay& ray : rays)
        if (const MicroHit hit = embree.closest(ray); !hit.missed()) take(hit, ray.origin + hit.t * ray.direction);
}

} // namespace

MicroPhotons makePhotons(unsigned photons, unsigned queries) {
    constexpr unsigned perRegion = 1024;
    const MicroScene scene = cornellScene();
    const EmbreeScene embree(scene.triangles);
    MicroPhotons made;
    std::mt19937 engine(9);
    std::uniform_real_distribution<float> flux(0.5f, 1.5f);
    // A part of the rays leaves the box.
    forHits(embree, makeRaySets(scene, embree, 2 * size_t(photons)).random,
            [&](const MicroHit& hit, const glm::vec3& at) {
                if (made.photons.size() == photons) return;
                TracedPhoton photon;
                photon.position = pack(at);
                photon.patchSide = patchSideOf(hit);
                photon.flux = nativePackFlux({flux(engine), flux(engine), flux(engine)}, nearestCode);
                photon.slot = LIGHT_DIFFUSE;
                made.photons.push_back(photon);
            });
    made.photons.resize(made.photons.size() / perRegion * perRegion);
    for (size_t end = perRegion; end <= made.photons.size(); end += perRegion) made.regionEnds.push_back(end);
    forHits(embree, makeRaySets(scene, embree, queries).primary, [&](const MicroHit& hit, const glm::vec3& at) {
        made.queries.push_back({pack(at), patchSideOf(hit)});
    });
    made.density = double(made.photons.size()) / areaOf(scene.triangles);
    return made;
}

} // namespace quasilux

#include "bench/micro/ray_sets.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

namespace quasilux {

namespace {

constexpr unsigned tile = 8, packetWidth = 4;
constexpr float offset = 1e-4f; ///< that rays leave surfaces by

std::vector<MicroRay> primaryRays(const MicroScene& scene, size_t count) {
    constexpr float halfWidth = 0.577350269f; // tangent of half of 60 degrees
    const unsigned tiles = std::max(1u, unsigned(std::sqrt(double(count)) / tile)), side = tile * tiles;
    const glm::vec3 forward = glm::normalize(scene.target - scene.eye);
    const glm::vec3 right = glm::normalize(glm::cross(forward, {0, 1, 0})), up = glm::cross(right, forward);
    std::vector<MicroRay> rays;
    rays.reserve(size_t(side) * side);
    for (unsigned t = 0; t < tiles * tiles; ++t)
        for (unsigned k = 0; k < tile * tile; ++k) {
            const unsigned packet = k / packetSize, lane = k % packetSize;
            const unsigned x = t % tiles * tile + packet % 2 * packetWidth + lane % packetWidth;
            const unsigned y = t / tiles * tile + packet / 2 * packetWidth + lane / packetWidth;
            const float across = halfWidth * (2 * (float(x) + 0.5f) / float(side) - 1);
            const float down = halfWidth * (2 * (float(y) + 0.5f) / float(side) - 1);
            rays.push_back({scene.eye, glm::normalize(forward + across * right - down * up), 0,
                            std::numeric_limits<float>::infinity()});
        }
    return rays;
}

glm::vec3 cosineDirection(const glm::vec3& normal, float u, float v) {
    // A point on the unit sphere about the tip of the normal.
    const float z = 1 - 2 * u, r = std::sqrt(std::max(0.f, 1 - z * z)), phi = 2 * std::numbers::pi_v<float> * v;
    const glm::vec3 direction = normal + glm::vec3(r * std::cos(phi), r * std::sin(phi), z);
    const float length = glm::length(direction);
    return length > 1e-4f ? direction / length : normal;
}

template <typename T>
void cutToPackets(std::vector<T>& rays) {
    rays.resize(rays.size() / packetSize * packetSize);
}

} // namespace

RaySets makeRaySets(const MicroScene& scene, const EmbreeScene& embree, size_t rays) {
    RaySets sets;
    sets.primary = primaryRays(scene, rays);
    std::vector<MicroHit> hits(sets.primary.size());
    embree.closest(sets.primary.data(), hits.data(), hits.size());
    std::mt19937 engine(5);
    std::uniform_real_distribution<float> unit(0, 1);
    for (size_t i = 0; i < hits.size(); ++i) {
        if (hits[i].missed()) continue;
        const MicroRay& ray = sets.primary[i];
        const BvhPrimitive& triangle = scene.triangles[hits[i].index()];
        glm::vec3 normal = glm::normalize(glm::cross(triangle.v1 - triangle.v0, triangle.v2 - triangle.v0));
        if (glm::dot(normal, ray.direction) > 0) normal = -normal;
        const glm::vec3 point = ray.origin + hits[i].t * ray.direction + offset * normal;
        const float u = unit(engine), v = unit(engine), a = unit(engine), b = unit(engine);
        sets.ordered.push_back({point, cosineDirection(normal, u, v), 0, std::numeric_limits<float>::infinity()});
        const glm::vec3 lamp = scene.lampCorner + a * scene.lampEdgeU + b * scene.lampEdgeV;
        sets.shadow.push_back({point, lamp - point, 0, 1 - offset});
    }
    cutToPackets(sets.ordered);
    cutToPackets(sets.shadow);
    sets.random = sets.ordered;
    std::shuffle(sets.random.begin(), sets.random.end(), engine);
    return sets;
}

} // namespace quasilux

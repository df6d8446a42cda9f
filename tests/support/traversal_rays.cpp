#include "support/traversal_rays.h"

#include <cmath>
#include <limits>
#include <random>

namespace quasilux {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

glm::vec3 randomDirection(std::mt19937& engine) {
    std::normal_distribution<float> normal;
    for (;;) {
        const float x = normal(engine), y = normal(engine), z = normal(engine);
        const float length = std::sqrt(x * x + y * y + z * z);
        if (length > 0.1f) return glm::vec3(x, y, z) / length;
    }
}

} // namespace

Rays randomRays(size_t count, unsigned seed, float extent, const glm::vec3& center) {
    std::mt19937 engine(seed);
    std::uniform_real_distribution<float> unit(0, 1), sides(-extent, extent), exponent(-1, 1);
    Rays rays(count);
    for (TestRay& ray : rays) {
        const float x = sides(engine), y = sides(engine), z = sides(engine), length = std::pow(10.0f, exponent(engine));
        ray.origin = center + glm::vec3(x, y, z);
        ray.direction = length * randomDirection(engine);
        ray.tMin = unit(engine) < 0.5f ? 0 : unit(engine) * extent / length;
        ray.tMax = unit(engine) < 0.5f ? infinity : ray.tMin + 2 * unit(engine) * extent / length;
    }
    return rays;
}

Rays axisParallelRays() {
    Rays rays;
    for (int x = -5; x <= 5; ++x)
        for (int y = -5; y <= 5; ++y)
            for (int z = -5; z <= 5; ++z)
                for (int way = 0; way < 12; ++way) {
                    const float zero = way < 6 ? 0.0f : -0.0f;
                    glm::vec3 direction(zero);
                    direction[way % 3] = way % 6 < 3 ? 1.0f : -1.0f;
                    rays.push_back({0.25f * glm::vec3(x, y, z), direction, 0, infinity});
                }
    return rays;
}

Rays surfaceRays(const Rays& before, const std::vector<TestHit>& hits, unsigned seed) {
    std::mt19937 engine(seed);
    Rays rays;
    for (size_t i = 0; i < hits.size(); ++i)
        if (!hits[i].missed())
            rays.push_back({before[i].origin + hits[i].t * before[i].direction, randomDirection(engine), 0, infinity});
    return rays;
}

} // namespace quasilux

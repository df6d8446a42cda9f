#include "support/meshes.h"

#include "bench/micro/triangles.h"

#include <random>

namespace quasilux {
namespace {

class Random {
public:
    explicit Random(unsigned seed) : engine_(seed) {}
    float between(float low, float high) { return low + (high - low) * unit_(engine_); }
    glm::vec3 point(float extent) {
        const float x = between(-extent, extent), y = between(-extent, extent), z = between(-extent, extent);
        return {x, y, z};
    }

private:
    std::mt19937 engine_;
    std::uniform_real_distribution<float> unit_{0.0f, 1.0f};
};

} // namespace

std::vector<BvhPrimitive> awkwardPrimitives(unsigned count, unsigned seed) {
    Random random(seed);
    std::vector<BvhPrimitive> out;
    while (out.size() < count) {
        const glm::vec3 a = random.point(1), b = a + random.point(0.3f), c = a + random.point(0.3f);
        switch (out.size() % 5) {
        case 0:
            addTriangle(out, a, b, c);
            break;
        case 1:
            addTriangle(out, a, a, a);
            break;
        case 2:
            addTriangle(out, a, a + 2.0f * (b - a), b);
            break;
        case 3:
            addTriangle(out, a, b, 0.5f * (a + b) + random.point(1e-4f));
            break;
        default:
            out.push_back(out[size_t(random.between(0, float(out.size()) - 0.5f))]);
        }
    }
    return out;
}

std::vector<BvhPrimitive> randomSpheres(unsigned count, unsigned seed) {
    Random random(seed);
    std::vector<BvhPrimitive> out(count);
    for (BvhPrimitive& sphere : out) {
        sphere.isSphere = true;
        sphere.v0 = random.point(1);
        sphere.v1.x = random.between(0.01f, 0.3f);
    }
    return out;
}

std::vector<BvhPrimitive> moved(std::vector<BvhPrimitive> primitives, const glm::vec3& offset) {
    for (BvhPrimitive& primitive : primitives) {
        primitive.v0 += offset;
        if (primitive.isSphere) continue;
        primitive.v1 += offset;
        primitive.v2 += offset;
    }
    return primitives;
}

} // namespace quasilux

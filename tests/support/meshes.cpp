#include "support/meshes.h"

#include <cmath>
#include <numbers>
#include <random>

namespace quasilux {
namespace {

using std::numbers::pi_v;

void addTriangle(std::vector<BvhPrimitive>& out, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    BvhPrimitive primitive;
    primitive.v0 = a;
    primitive.v1 = b;
    primitive.v2 = c;
    out.push_back(primitive);
}

void addQuad(std::vector<BvhPrimitive>& out, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c,
             const glm::vec3& d) {
    addTriangle(out, a, b, c);
    addTriangle(out, a, c, d);
}

/// Six sides of a box that stands on y = -1, turned by `angle` about the vertical.
void addBox(std::vector<BvhPrimitive>& out, float centerX, float centerZ, float half, float height, float angle) {
    const float c = half * std::cos(angle), s = half * std::sin(angle);
    const glm::vec2 corner[4] = {{c - s, s + c}, {-c - s, c - s}, {-c + s, -s - c}, {c + s, -c + s}};
    glm::vec3 low[4], high[4];
    for (int i = 0; i < 4; ++i) {
        low[i] = {centerX + corner[i].x, -1, centerZ + corner[i].y};
        high[i] = {low[i].x, -1 + height, low[i].z};
    }
    addQuad(out, low[0], low[1], low[2], low[3]);
    addQuad(out, high[0], high[1], high[2], high[3]);
    for (int i = 0; i < 4; ++i) addQuad(out, low[i], low[(i + 1) % 4], high[(i + 1) % 4], high[i]);
}

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

std::vector<BvhPrimitive> cornellBoxPrimitives() {
    std::vector<BvhPrimitive> out;
    addQuad(out, {-1, -1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, -1, -1});
    addQuad(out, {-1, 1, -1}, {1, 1, -1}, {1, 1, 1}, {-1, 1, 1});
    addQuad(out, {-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1});
    addQuad(out, {-1, -1, -1}, {-1, 1, -1}, {-1, 1, 1}, {-1, -1, 1});
    addQuad(out, {1, -1, -1}, {1, -1, 1}, {1, 1, 1}, {1, 1, -1});
    addBox(out, -0.35f, -0.3f, 0.3f, 1.2f, 0.3f);
    addBox(out, 0.35f, 0.35f, 0.3f, 0.6f, -0.3f);
    addQuad(out, {-0.25f, 0.99f, -0.25f}, {0.25f, 0.99f, -0.25f}, {0.25f, 0.99f, 0.25f}, {-0.25f, 0.99f, 0.25f});
    return out;
}

std::vector<BvhPrimitive> bumpySpherePrimitives(unsigned rings, unsigned segments) {
    const auto vertex = [&](unsigned ring, unsigned segment) {
        const float theta = pi_v<float> * float(ring) / float(rings);
        const float phi = 2 * pi_v<float> * float(segment % segments) / float(segments);
        const float radius = 1 + 0.1f * std::sin(9 * theta) * std::sin(7 * phi) * std::sin(theta);
        const float sine = ring == rings ? 0 : std::sin(theta);
        return radius * glm::vec3(sine * std::cos(phi), std::cos(theta), sine * std::sin(phi));
    };
    std::vector<BvhPrimitive> out;
    for (unsigned ring = 0; ring < rings; ++ring)
        for (unsigned segment = 0; segment < segments; ++segment) {
            const glm::vec3 a = vertex(ring, segment), b = vertex(ring, segment + 1);
            const glm::vec3 c = vertex(ring + 1, segment + 1), d = vertex(ring + 1, segment);
            if (ring > 0) addTriangle(out, a, b, c);
            if (ring + 1 < rings) addTriangle(out, a, c, d);
        }
    return out;
}

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

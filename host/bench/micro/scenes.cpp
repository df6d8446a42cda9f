#include "bench/micro/scenes.h"

#include "bench/micro/triangles.h"

#include <cmath>
#include <numbers>
#include <random>

namespace quasilux {
namespace {

using std::numbers::pi_v;

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

/// Walls, floor and ceiling at -extent and extent.
void addRoom(std::vector<BvhPrimitive>& out, float extent) {
    for (int axis = 0; axis < 3; ++axis)
        for (const float side : {-extent, extent}) {
            glm::vec3 corner(0), u(0), v(0);
            corner[axis] = side;
            u[(axis + 1) % 3] = v[(axis + 2) % 3] = extent;
            addQuad(out, corner - u - v, corner + u - v, corner + u + v, corner - u + v);
        }
}

class Random {
public:
    explicit Random(unsigned seed) : engine_(seed) {}
    float between(float low, float high) { return low + (high - low) * unit_(engine_); }
    glm::vec3 inBall(float radius) {
        for (;;) {
            const float x = between(-1, 1), y = between(-1, 1), z = between(-1, 1);
            if (x * x + y * y + z * z < 1) return radius * glm::vec3(x, y, z);
        }
    }

private:
    std::mt19937 engine_;
    std::uniform_real_distribution<float> unit_{0.0f, 1.0f};
};

float hillHeight(float x, float z) {
    return 0.3f * std::sin(1.3f * x) * std::cos(1.1f * z) + 0.1f * std::sin(4 * x + z);
}

constexpr float forestExtent = 10;

void addHills(std::vector<BvhPrimitive>& out, unsigned cells) {
    const auto vertex = [&](unsigned i, unsigned k) {
        const float x = forestExtent * (2 * float(i) / float(cells) - 1),
                    z = forestExtent * (2 * float(k) / float(cells) - 1);
        return glm::vec3(x, hillHeight(x, z), z);
    };
    for (unsigned i = 0; i < cells; ++i)
        for (unsigned k = 0; k < cells; ++k)
            addQuad(out, vertex(i, k), vertex(i, k + 1), vertex(i + 1, k + 1), vertex(i + 1, k));
}

constexpr unsigned trunkSides = 8;

void addTree(std::vector<BvhPrimitive>& out, Random& random, unsigned leaves) {
    const float x = random.between(-forestExtent, forestExtent), z = random.between(-forestExtent, forestExtent);
    const glm::vec3 root(x, hillHeight(x, z), z);
    const float height = random.between(0.4f, 0.9f), girth = 0.03f * height, crown = 0.35f * height;
    const glm::vec3 top = root + glm::vec3(0, height, 0);
    for (unsigned k = 0; k < trunkSides; ++k) {
        const float a = 2 * pi_v<float> * float(k) / trunkSides, b = 2 * pi_v<float> * float(k + 1) / trunkSides;
        addTriangle(out, root + girth * glm::vec3(std::cos(a), 0, std::sin(a)),
                    root + girth * glm::vec3(std::cos(b), 0, std::sin(b)), top);
    }
    for (unsigned k = 0; k < leaves; ++k) {
        const glm::vec3 at = top + random.inBall(crown);
        const glm::vec3 b = at + random.inBall(0.06f * height), c = at + random.inBall(0.06f * height);
        addTriangle(out, at, b, c);
    }
}

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

std::vector<BvhPrimitive> forestPrimitives(size_t triangles) {
    constexpr unsigned leaves = 992, perTree = leaves + trunkSides, hillCells = 70;
    std::vector<BvhPrimitive> out;
    out.reserve(triangles);
    addHills(out, hillCells);
    Random random(21);
    while (out.size() + perTree <= triangles) addTree(out, random, leaves);
    return out;
}

MicroScene cornellScene() {
    return {"Cornell box", cornellBoxPrimitives(), {0, 0, 2.7f}, {0, 0, 0}, {-0.25f, 0.985f, -0.25f}, {0.5f, 0, 0},
            {0, 0, 0.5f}};
}

MicroScene sphereScene(unsigned rings) {
    MicroScene scene{
        "sphere", bumpySpherePrimitives(rings, rings), {0.3f, 0.8f, 2.3f}, {0, 0, 0}, {-0.5f, 2.3f, -0.5f}, {1, 0, 0},
        {0, 0, 1}};
    addRoom(scene.triangles, 2.4f);
    return scene;
}

MicroScene forestScene(size_t triangles) {
    return {"forest", forestPrimitives(triangles), {0, 2.2f, 11}, {0, 0.2f, 3}, {-3, 9, -3}, {2, 0, 0}, {0, 0, 2}};
}

} // namespace quasilux

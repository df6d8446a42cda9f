// Primitives as the traversal kernels test them: blocks of eight, and boxes that surely hold them.
#include "prepare/bvh_block.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace quasilux {
namespace {

// The triangle test multiplies three lengths: 1e12 cubed leaves a factor of 300 to the largest float.
constexpr float largestCoordinate = 1e12f;

bool isUsable(const glm::vec3& v) {
    return std::abs(v.x) <= largestCoordinate && std::abs(v.y) <= largestCoordinate &&
           std::abs(v.z) <= largestCoordinate;
}

/// The float at or below (above) `value`.
float roundDown(double value) {
    const float nearest = float(value);
    return double(nearest) <= value ? nearest : std::nextafter(nearest, -std::numeric_limits<float>::infinity());
}
float roundUp(double value) { return -roundDown(-value); }

PrimitiveBounds sphereBounds(const glm::vec3& center, float radius) {
    PrimitiveBounds bounds{};
    for (int axis = 0; axis < 3; ++axis) {
        bounds.lower[axis] = roundDown(double(center[axis]) - radius);
        bounds.upper[axis] = roundUp(double(center[axis]) + radius);
    }
    return bounds;
}

PrimitiveBounds triangleBounds(const BvhPrimitive& primitive) {
    return {glm::min(glm::min(primitive.v0, primitive.v1), primitive.v2),
            glm::max(glm::max(primitive.v0, primitive.v1), primitive.v2)};
}

/// Edges that are parallel within rounding span no area: their cross product would be noise, and so would t be.
bool isDegenerate(const glm::vec3& e1, const glm::vec3& e2) {
    constexpr double smallestSine = 4e-7;
    const glm::dvec3 a(e1), b(e2);
    const glm::dvec3 normal = glm::cross(a, b);
    return glm::dot(normal, normal) <= smallestSine * smallestSine * glm::dot(a, a) * glm::dot(b, b);
}

} // namespace

PrimitiveBounds boundsOf(const BvhPrimitive& primitive, size_t index) {
    const bool usable = primitive.isSphere ? isUsable(primitive.v0) && std::abs(primitive.v1.x) <= largestCoordinate
                                           : isUsable(primitive.v0) && isUsable(primitive.v1) && isUsable(primitive.v2);
    if (!usable)
        throw InputError(
            fmt::format("primitive {} of the scene ({}) has a coordinate that is not finite or exceeds {:g}; "
                        "check the mesh and its to_world transform",
                        index, primitive.isSphere ? "a sphere" : "a triangle", largestCoordinate));
    return primitive.isSphere ? sphereBounds(primitive.v0, std::abs(primitive.v1.x)) : triangleBounds(primitive);
}

shared::PrimitiveBlock makeBlock(const std::vector<BvhPrimitive>& primitives, const unsigned* indices, unsigned count) {
    const glm::vec3 nowhere(std::numeric_limits<float>::quiet_NaN());
    shared::PrimitiveBlock block{};
    std::fill_n(block.primitive, BVH_WIDTH, QL_NONE);
    for (unsigned lane = 0; lane < BVH_WIDTH; ++lane) {
        glm::vec3 v0 = nowhere, v1 = nowhere, v2 = nowhere;
        if (lane < count) {
            const BvhPrimitive& primitive = primitives[indices[lane]];
            block.primitive[lane] = indices[lane] | (primitive.isSphere ? PRIMITIVE_SPHERE_BIT : 0u) |
                                    (primitive.isNull ? PRIMITIVE_NULL_BIT : 0u);
            if (primitive.isSphere) {
                v0 = primitive.v0;
                v1.x = std::abs(primitive.v1.x);
            } else if (!isDegenerate(primitive.v1 - primitive.v0, primitive.v2 - primitive.v0)) {
                v0 = primitive.v0;
                v1 = primitive.v1;
                v2 = primitive.v2;
            }
        }
        block.v0x[lane] = v0.x;
        block.v0y[lane] = v0.y;
        block.v0z[lane] = v0.z;
        block.v1x[lane] = v1.x;
        block.v1y[lane] = v1.y;
        block.v1z[lane] = v1.z;
        block.v2x[lane] = v2.x;
        block.v2y[lane] = v2.y;
        block.v2z[lane] = v2.z;
    }
    return block;
}

} // namespace quasilux

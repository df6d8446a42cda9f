// A flat board whose long edges are half-round, a mesh as modellers make it: one smooth surface about both of its faces.
#pragma once

#include "scene/scene.h"

#include <cmath>
#include <numbers>

namespace quasilux::test {

/// 2 x 2 x `thickness` about the origin, its faces towards +z and -z; rims of `steps` triangle pairs at x = 1 and -1, caps
/// with sharp edges at y = 1 and -1. Normals point outwards.
inline Mesh roundedBoard(double thickness, unsigned steps) {
    Mesh mesh;
    const auto add = [&](double x, double z) {
        for (const double y : {-1.0, 1.0}) mesh.positions.emplace_back(float(x), float(y), float(z));
    };
    for (const double side : {1.0, -1.0}) // the rim at x = side, from the face towards -side to the other
        for (unsigned k = 0; k <= steps; ++k) {
            const double angle = std::numbers::pi * (double(k) / steps - 0.5);
            add(side * (1 + 0.5 * thickness * std::cos(angle)), side * 0.5 * thickness * std::sin(angle));
        }
    const auto count = unsigned(mesh.positions.size() / 2);
    for (unsigned i = 0; i < count; ++i) {
        const unsigned a = 2 * i, b = 2 * ((i + 1) % count);
        mesh.triangles.insert(mesh.triangles.end(), {{a, b + 1, b}, {a, a + 1, b + 1}});
    }
    for (unsigned i = 1; i + 1 < count; ++i) // the caps are convex
        mesh.triangles.insert(mesh.triangles.end(), {{0, 2 * i, 2 * i + 2}, {1, 2 * i + 3, 2 * i + 1}});
    return mesh;
}

} // namespace quasilux::test

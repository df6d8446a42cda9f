// Surfaces whose borders can be counted by hand, and sums over the borders found.
#pragma once

#include "prepare/borders.h"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>
#include <vector>

namespace quasilux {

using glm::dvec3;
using std::numbers::pi;

inline void addMesh(Scene& scene, const std::vector<dvec3>& positions, const std::vector<glm::uvec3>& triangles,
                    const glm::dmat4& toWorld = glm::dmat4(1)) {
    ShapeDescription& shape = scene.shapes.emplace_back();
    for (const dvec3& p : positions) shape.mesh.positions.emplace_back(dvec3(toWorld * glm::dvec4(p, 1)));
    shape.mesh.triangles = triangles;
}

/// cells x cells squares, two triangles each, normal u x v.
inline void addPlane(Scene& scene, dvec3 corner, dvec3 u, dvec3 v, unsigned cells = 1) {
    std::vector<dvec3> positions;
    std::vector<glm::uvec3> triangles;
    for (unsigned j = 0; j <= cells; ++j)
        for (unsigned i = 0; i <= cells; ++i)
            positions.push_back(corner + u * (double(i) / cells) + v * (double(j) / cells));
    for (unsigned j = 0; j < cells; ++j)
        for (unsigned i = 0; i < cells; ++i) {
            const unsigned a = j * (cells + 1) + i, b = a + 1, c = a + cells + 1, d = c + 1;
            triangles.insert(triangles.end(), {{a, b, d}, {a, d, c}});
        }
    addMesh(scene, positions, triangles);
}

/// [-1, 1]^3 with four vertices of its own to each face, normals outwards.
inline void addCube(Scene& scene, const glm::dmat4& toWorld) {
    std::vector<dvec3> positions;
    std::vector<glm::uvec3> triangles;
    for (int axis = 0; axis < 3; ++axis)
        for (const double sign : {-1.0, 1.0}) {
            dvec3 n(0), u(0), v(0);
            n[axis] = sign;
            u[(axis + 1) % 3] = sign;
            v[(axis + 2) % 3] = 1;
            const auto first = unsigned(positions.size());
            positions.insert(positions.end(), {n - u - v, n + u - v, n + u + v, n - u + v});
            triangles.insert(triangles.end(), {{first, first + 1, first + 2}, {first, first + 2, first + 3}});
        }
    addMesh(scene, positions, triangles, toWorld);
}

/// Latitude-longitude mesh; an even number of rings has one in the plane z = 0.
inline void addSphereMesh(Scene& scene, dvec3 center, double radius, unsigned slices, unsigned rings) {
    std::vector<dvec3> positions{center + dvec3(0, 0, radius)};
    std::vector<glm::uvec3> triangles;
    for (unsigned j = 1; j < rings; ++j)
        for (unsigned i = 0; i < slices; ++i) {
            const double theta = pi * j / rings, phi = 2 * pi * i / slices;
            const double z = 2 * j == rings ? 0 : std::cos(theta);
            positions.push_back(center +
                                radius * dvec3(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), z));
        }
    positions.push_back(center - dvec3(0, 0, radius));
    const auto south = unsigned(positions.size() - 1);
    const auto at = [&](unsigned j, unsigned i) { return 1 + (j - 1) * slices + i % slices; };
    for (unsigned i = 0; i < slices; ++i) {
        triangles.push_back({0, at(1, i), at(1, i + 1)});
        for (unsigned j = 1; j + 1 < rings; ++j)
            triangles.insert(triangles.end(),
                             {{at(j, i), at(j + 1, i), at(j + 1, i + 1)}, {at(j, i), at(j + 1, i + 1), at(j, i + 1)}});
        triangles.push_back({at(rings - 1, i), south, at(rings - 1, i + 1)});
    }
    addMesh(scene, positions, triangles);
}

inline void addSphere(Scene& scene, dvec3 center, double radius) {
    scene.shapes.emplace_back().sphere = Sphere{glm::vec3(center), float(radius)};
}

/// Room of 5.5 units, open towards +z, with two turned cubes that stand on its floor.
inline Scene cornellBox() {
    Scene scene;
    const dvec3 x(5.5, 0, 0), y(0, 5.5, 0), z(0, 0, 5.5), o(0);
    addPlane(scene, o, z, x);
    addPlane(scene, y, x, z);
    addPlane(scene, o, x, y);
    addPlane(scene, o, y, z);
    addPlane(scene, x, z, y);
    for (const double side : {1.0, -1.0}) {
        glm::dmat4 m = glm::translate(glm::dmat4(1), dvec3(2.75 + side * 1.2, 0.8, 2.75));
        m = glm::rotate(m, side * 0.3, dvec3(0, 1, 0));
        addCube(scene, glm::scale(m, dvec3(0.8)));
    }
    return scene;
}

inline dvec3 point(const shared::Packed3& p) { return {p.x, p.y, p.z}; }
inline double length(const BorderSegment& s) { return glm::distance(point(s.a), point(s.b)); }

inline double totalLength(const SurfaceBorders& borders) {
    double sum = 0;
    for (const auto& segment : borders.segments) sum += length(segment);
    return sum;
}

inline bool names(const BorderSegment& s, unsigned p, unsigned q) {
    return (s.patchA == p && s.patchB == q) || (s.patchA == q && s.patchB == p);
}

inline size_t countNaming(const SurfaceBorders& borders, unsigned p, unsigned q) {
    size_t count = 0;
    for (const auto& segment : borders.segments) count += names(segment, p, q);
    return count;
}

inline void transform(Scene& scene, double scale, dvec3 offset) {
    for (ShapeDescription& shape : scene.shapes)
        for (glm::vec3& p : shape.mesh.positions) p = glm::vec3(dvec3(p) * scale + offset);
}

} // namespace quasilux

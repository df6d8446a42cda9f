// Winding and normals of meshes in world space.
#include "scene/shapes/mesh_builder.h"

#include <cmath>
#include <numbers>
#include <unordered_map>

namespace quasilux {

namespace {

using Normals = std::array<glm::dvec3, 3>;

glm::dvec3 unitOr(const glm::dvec3& vector, const glm::dvec3& otherwise) {
    const double length = glm::length(vector);
    return length > 0 && std::isfinite(length) ? vector / length : otherwise;
}

/// Unit normal by the winding; +z for a degenerate triangle.
glm::dvec3 faceNormal(const std::array<glm::dvec3, 3>& p) {
    return unitOr(glm::cross(p[1] - p[0], p[2] - p[0]), {0, 0, 1});
}

std::vector<glm::dvec3> toWorldSpace(const std::vector<glm::dvec3>& positions, const glm::dmat4& toWorld) {
    std::vector<glm::dvec3> world;
    world.reserve(positions.size());
    for (const glm::dvec3& position : positions) world.push_back(transformPoint(toWorld, position));
    return world;
}

std::array<glm::dvec3, 3> cornersOf(const std::array<MeshSource::Corner, 3>& triangle,
                                    const std::vector<glm::dvec3>& world) {
    return {world[triangle[0].position], world[triangle[1].position], world[triangle[2].position]};
}

/// Means of face normals at each vertex, weighted by the angle there (Thürmer and Wüthrich 1998), as Mitsuba 3 does.
std::vector<Normals> computeNormals(const MeshSource& source, const std::vector<glm::dvec3>& world) {
    std::unordered_map<uint64_t, glm::dvec3> sums;
    for (const auto& triangle : source.triangles) {
        const auto p = cornersOf(triangle, world);
        const glm::dvec3 cross = glm::cross(p[1] - p[0], p[2] - p[0]);
        if (!(glm::length(cross) > 0)) continue;
        for (size_t i = 0; i < 3; ++i) {
            const glm::dvec3 a = glm::normalize(p[(i + 1) % 3] - p[i]), b = glm::normalize(p[(i + 2) % 3] - p[i]);
            const double angle = std::acos(glm::clamp(glm::dot(a, b), -1.0, 1.0));
            sums.try_emplace(triangle[i].vertex, glm::dvec3(0)).first->second += angle * glm::normalize(cross);
        }
    }
    std::vector<Normals> normals;
    normals.reserve(source.triangles.size());
    for (const auto& triangle : source.triangles) {
        const glm::dvec3 face = faceNormal(cornersOf(triangle, world));
        Normals corner;
        for (size_t i = 0; i < 3; ++i) {
            const auto sum = sums.find(triangle[i].vertex);
            corner[i] = sum == sums.end() ? face : unitOr(sum->second, face);
        }
        normals.push_back(corner);
    }
    return normals;
}

/// The same of a mesh that an instance places: as those of its group, in whose space they are means, carried by the
/// inverse transpose.
std::vector<Normals> computeNormals(const MeshSource& source, const std::vector<glm::dvec3>& world,
                                    const glm::dmat4& placement) {
    const glm::dmat4 back = glm::inverse(placement);
    const glm::dmat3 inverseTranspose = glm::transpose(glm::dmat3(back));
    std::vector<Normals> normals = computeNormals(source, toWorldSpace(world, back));
    for (Normals& corner : normals)
        for (glm::dvec3& normal : corner) normal = unitOr(inverseTranspose * normal, normal);
    return normals;
}

/// Whether an instance's transform does more than to turn and to scale.
bool distorts(const std::optional<glm::dmat4>& placement) {
    if (!placement) return false;
    const glm::dmat3 axes(*placement);
    const double volume = glm::determinant(axes);
    return volume < 0 || !keepsAngles(axes / std::cbrt(volume), 1, 1e-9);
}

/// Normals of the file in world space; the face's normal where a corner has none or one of length zero.
std::vector<Normals> transformNormals(const MeshSource& source, const std::vector<glm::dvec3>& world,
                                      const glm::dmat4& toWorld) {
    const glm::dmat3 inverseTranspose = glm::transpose(glm::inverse(glm::dmat3(toWorld)));
    const double side = glm::determinant(glm::dmat3(toWorld)) < 0 ? -1 : 1;
    std::vector<Normals> normals;
    normals.reserve(source.triangles.size());
    for (const auto& triangle : source.triangles) {
        const glm::dvec3 face = side * faceNormal(cornersOf(triangle, world));
        Normals corner;
        for (size_t i = 0; i < 3; ++i)
            corner[i] = triangle[i].normal == QL_NONE
                            ? face
                            : unitOr(inverseTranspose * source.normals[triangle[i].normal], face);
        normals.push_back(corner);
    }
    return normals;
}

/// Whether the corner normals are those of the faces, so that they say nothing.
bool areFlat(const std::vector<Normals>& normals, const MeshSource& source, const std::vector<glm::dvec3>& world) {
    constexpr double tolerance = 1e-6;
    for (size_t t = 0; t < normals.size(); ++t) {
        const glm::dvec3 face = faceNormal(cornersOf(source.triangles[t], world));
        for (const glm::dvec3& normal : normals[t])
            if (std::min(glm::length(normal - face), glm::length(normal + face)) > tolerance) return false;
    }
    return true;
}

size_t cornersWithoutUv(const MeshSource& source) {
    size_t count = 0;
    for (const auto& triangle : source.triangles)
        for (const MeshSource::Corner& corner : triangle) count += corner.uv == QL_NONE;
    return count;
}

} // namespace

double roundRadius(unsigned sectors) {
    const double angle = 2 * std::numbers::pi / sectors;
    return std::sqrt(angle / std::sin(angle));
}

Mesh flatMesh(const std::vector<glm::dvec3>& positions, const std::vector<glm::uvec3>& triangles,
              const std::vector<glm::vec2>& uvs, const glm::dmat4& toWorld, bool flipNormals,
              const SourceLocation& where) {
    Mesh mesh;
    for (const glm::dvec3& position : positions)
        mesh.positions.push_back(toSingle(transformPoint(toWorld, position), where));
    const bool reversed = (glm::determinant(glm::dmat3(toWorld)) < 0) != flipNormals;
    for (const glm::uvec3& t : triangles) mesh.triangles.push_back(reversed ? glm::uvec3(t.x, t.z, t.y) : t);
    mesh.cornerUvs = uvs;
    for (size_t t = 0; reversed && t < triangles.size(); ++t)
        std::swap(mesh.cornerUvs[3 * t + 1], mesh.cornerUvs[3 * t + 2]);
    return mesh;
}

Mesh fileMesh(const MeshSource& source, const glm::dmat4& toWorld, bool flipNormals, bool faceNormals,
              const SourceLocation& where, const std::optional<glm::dmat4>& placement) {
    const std::vector<glm::dvec3> world = toWorldSpace(source.positions, toWorld);
    Mesh mesh;
    mesh.positions.reserve(world.size());
    for (const glm::dvec3& position : world) mesh.positions.push_back(toSingle(position, where));

    const bool fromFile = !faceNormals && !source.normals.empty();
    std::vector<Normals> normals;
    if (fromFile)
        normals = transformNormals(source, world, toWorld);
    else if (!faceNormals)
        normals = distorts(placement) ? computeNormals(source, world, *placement) : computeNormals(source, world);
    const bool isMirrored = placement && glm::determinant(glm::dmat3(*placement)) < 0;
    const bool keepNormals = !faceNormals && !areFlat(normals, source, world);

    const size_t withoutUv = cornersWithoutUv(source);
    const bool hasUvs = withoutUv < 3 * source.triangles.size();
    if (hasUvs) mesh.cornersWithoutUv = withoutUv;
    mesh.attributes = source.attributes;

    for (size_t t = 0; t < source.triangles.size(); ++t) {
        const auto& corner = source.triangles[t];
        bool reversed = flipNormals != (isMirrored && !fromFile);
        if (fromFile) {
            const glm::dvec3 sum = normals[t][0] + normals[t][1] + normals[t][2];
            if (glm::dot(faceNormal(cornersOf(corner, world)), sum) < 0) reversed = !reversed;
        }
        const size_t second = reversed ? 2 : 1, third = reversed ? 1 : 2;
        mesh.triangles.emplace_back(corner[0].position, corner[second].position, corner[third].position);
        for (size_t i : {size_t(0), second, third})
            if (hasUvs) mesh.cornerUvs.emplace_back(corner[i].uv == QL_NONE ? glm::dvec2(0) : source.uvs[corner[i].uv]);
        if (!keepNormals) continue;
        const double sign = flipNormals ? -1 : 1;
        for (size_t i : {size_t(0), second, third}) mesh.cornerNormals.emplace_back(sign * normals[t][i]);
    }
    return mesh;
}

} // namespace quasilux

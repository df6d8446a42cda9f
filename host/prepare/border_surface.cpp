// Gathers the scene's visible triangles and spheres, welded, with what is degenerate or doubled marked.
#include "prepare/border_surface.h"

#include "prepare/border_weld.h"
#include "prepare/split.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

namespace quasilux {
namespace {

double largestCoordinate(const glm::dvec3& p) {
    const glm::dvec3 magnitude = glm::abs(p);
    return std::max({magnitude.x, magnitude.y, magnitude.z});
}

} // namespace

void measureTriangle(SurfaceTriangle& triangle, const std::vector<glm::dvec3>& vertices) {
    const glm::dvec3 p0 = vertices[triangle.corner[0]], p1 = vertices[triangle.corner[1]],
                     p2 = vertices[triangle.corner[2]];
    triangle.rounding =
        borderRounding * std::max({largestCoordinate(p0), largestCoordinate(p1), largestCoordinate(p2)});
    const glm::dvec3 doubleArea = glm::cross(p1 - p0, p2 - p0);
    const double longest = std::max({glm::distance(p0, p1), glm::distance(p1, p2), glm::distance(p2, p0)});
    const double height = longest > 0 ? glm::length(doubleArea) / longest : 0;
    if (height <= 0.25 * triangle.rounding) {
        triangle.kind = SurfaceTriangle::Kind::degenerate;
        return;
    }
    triangle.area = 0.5 * glm::length(doubleArea);
    triangle.normal = glm::normalize(doubleArea);
}

SurfaceSphere makeSurfaceSphere(const Sphere& sphere, unsigned primitive) {
    const glm::dvec3 center(sphere.center);
    return {center, sphere.radius, primitive, borderRounding * (largestCoordinate(center) + sphere.radius)};
}

namespace {

/// A sheet modelled twice, say once for each side, is one sheet.
void markDuplicates(std::vector<SurfaceTriangle>& triangles) {
    struct Corners {
        std::array<unsigned, 3> corner;
        unsigned triangle;
        auto operator<=>(const Corners&) const = default;
    };
    std::vector<Corners> sorted;
    sorted.reserve(triangles.size());
    for (unsigned i = 0; i < triangles.size(); ++i) {
        if (triangles[i].kind != SurfaceTriangle::Kind::regular) continue;
        const glm::uvec3 c = triangles[i].corner;
        sorted.push_back({{c[0], c[1], c[2]}, i});
        std::sort(sorted.back().corner.begin(), sorted.back().corner.end());
    }
    std::sort(sorted.begin(), sorted.end());
    for (size_t i = 1, first = 0; i < sorted.size(); ++i) {
        if (sorted[i].corner != sorted[first].corner) {
            first = i;
            continue;
        }
        triangles[sorted[i].triangle].kind = SurfaceTriangle::Kind::duplicate;
        triangles[sorted[i].triangle].original = sorted[first].triangle;
    }
}

} // namespace

bool isInvisible(const Scene& scene, const ShapeDescription& shape) {
    if (shape.bsdf < 0) return false;
    const Bsdf& bsdf = scene.bsdfs[size_t(shape.bsdf)];
    return bsdf.isNull && bsdf.front.empty() && bsdf.back.empty();
}

uint8_t storingOf(const Scene& scene, const ShapeDescription& shape) {
    if (shape.bsdf < 0) return 0;
    const auto side = [](const std::vector<LobeDescription>& lobes, bool isBent) {
        double widest = 0; // of what is not specular
        for (const LobeDescription& lobe : lobes) widest = std::max(widest, lobe.halfWidth);
        return (widest >= quasiSpecularHalfWidth ? 2 : widest > 0 ? 1 : 0) | (isBent ? 4 : 0);
    };
    const Bsdf& bsdf = scene.bsdfs[size_t(shape.bsdf)];
    return static_cast<uint8_t>(side(bsdf.front, bsdf.frontRelief.has_value()) |
                                side(bsdf.back, bsdf.backRelief.has_value()) << 3);
}

unsigned primitiveCount(const ShapeDescription& shape) {
    return shape.sphere ? 1u : unsigned(shape.mesh.triangles.size());
}

Surface collectSurface(const Scene& scene, std::span<const ShapeDescription> shapes) {
    Surface surface;
    std::vector<glm::vec3> positions;
    std::vector<glm::uvec3> corners;
    for (const ShapeDescription& shape : shapes) {
        const unsigned first = surface.primitiveCount;
        surface.primitiveCount += primitiveCount(shape);
        if (isInvisible(scene, shape)) continue;
        if (shape.sphere) {
            surface.spheres.push_back(makeSurfaceSphere(*shape.sphere, first));
            continue;
        }
        const uint8_t storing = storingOf(scene, shape);
        for (unsigned i = 0; i < shape.mesh.triangles.size(); ++i) {
            corners.push_back(shape.mesh.triangles[i] + unsigned(positions.size()));
            surface.triangles.emplace_back().primitive = first + i;
            surface.triangles.back().storing = storing;
        }
        positions.insert(positions.end(), shape.mesh.positions.begin(), shape.mesh.positions.end());
    }

    WeldedVertices welded = weldVertices(positions, corners);
    surface.vertices = std::move(welded.positions);
    for (size_t i = 0; i < corners.size(); ++i) {
        for (int k = 0; k < 3; ++k) surface.triangles[i].corner[k] = welded.vertexOf[corners[i][k]];
        measureTriangle(surface.triangles[i], surface.vertices);
    }
    markDuplicates(surface.triangles);
    return surface;
}

} // namespace quasilux

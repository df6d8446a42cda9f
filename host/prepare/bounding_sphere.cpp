#include "prepare/bounding_sphere.h"

#include "scene/box.h"
#include "scene/origin.h"

#include <algorithm>

namespace quasilux {

namespace {

template <typename Visit>
void forEachBall(const Scene& scene, Visit visit) {
    for (const auto& shape : scene.worldShapes()) {
        if (shape.sphere) visit(glm::dvec3(shape.sphere->center), std::abs(double(shape.sphere->radius)));
        for (const auto& position : shape.mesh.positions) visit(glm::dvec3(position), 0.0);
    }
    for (const Instance& instance : scene.instances) {
        const Box box = boxOf(scene, instance);
        for (unsigned corner = 0; corner < 8; ++corner)
            visit(glm::dvec3(corner & 1 ? box.lower.x : box.upper.x, corner & 2 ? box.lower.y : box.upper.y,
                             corner & 4 ? box.lower.z : box.upper.z),
                  0.0);
    }
    if (scene.sensor.meter != MeterKind::grid) return;
    for (const IlluminanceGrid& grid : scene.grids) { // distant light is to reach all points, counted as photons too
        const glm::dvec3 aside = 0.5 * grid.height * grid.normal();
        for (const glm::dvec3& corner :
             {grid.origin, grid.origin + grid.edgeU, grid.origin + grid.edgeV, grid.origin + grid.edgeU + grid.edgeV}) {
            visit(corner + aside, 0.0);
            visit(corner - aside, 0.0);
        }
    }
}

} // namespace

Sphere boundingSphere(const Scene& scene) {
    Box box;
    forEachBall(scene, [&](const glm::dvec3& center, double radius) {
        box.add(Box{center - radius, center + radius});
    });
    if (!(box.lower.x <= box.upper.x)) return {glm::vec3(0), 1};
    Sphere sphere{glm::vec3(box.center()), 0};
    double reach = 0;
    forEachBall(scene, [&](const glm::dvec3& center, double radius) {
        reach = std::max(reach, glm::length(center - glm::dvec3(sphere.center)) + radius);
    });
    const double rounding = 1e-6 * (glm::length(glm::dvec3(sphere.center)) + reach);
    sphere.radius = reach > 0 ? static_cast<float>(reach + rounding) : 1;
    return sphere;
}

} // namespace quasilux

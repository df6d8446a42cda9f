#include "scene/origin.h"

#include "scene/box.h"

#include <algorithm>
#include <cmath>

namespace quasilux {

namespace {

constexpr double farAway = 4; // times the size of the scene

double largest(const glm::dvec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

} // namespace

Box boxOf(std::span<const ShapeDescription> shapes) {
    Box box;
    for (const ShapeDescription& shape : shapes) {
        if (shape.sphere)
            for (const float radius : {-shape.sphere->radius, shape.sphere->radius})
                box.add(glm::dvec3(shape.sphere->center) + double(radius));
        for (const glm::vec3& position : shape.mesh.positions) box.add(glm::dvec3(position));
    }
    return box;
}

Box boxOf(const Scene& scene, const Instance& instance) {
    return carried(scene.groups[instance.group].box, glm::dmat4x3(instance.toWorld));
}

glm::dvec3 farCenter(const Box& box, const glm::dvec3& origin) {
    const glm::dvec3 center = origin + box.center();
    const bool isFar = box.lower.x <= box.upper.x && largest(center) > farAway * largest(box.extent());
    return isFar ? center : glm::dvec3(0);
}

Box boxOf(const Scene& scene) {
    Box box = boxOf(scene.worldShapes());
    for (const Instance& instance : scene.instances) box.add(boxOf(scene, instance));
    return box;
}

glm::dvec3 chooseOrigin(const Scene& scene) { return farCenter(boxOf(scene), scene.origin); }

} // namespace quasilux

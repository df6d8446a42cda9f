#include "scene/origin.h"

#include "scene/transform.h"

#include <algorithm>
#include <limits>

namespace quasilux {

namespace {

constexpr double farAway = 4; // times the size of the scene

double largest(const glm::dvec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

/// Of a sensor, or of the first one of a batch.
const Element* transformWithin(const Element& sensor) {
    for (const Element& child : sensor.children) {
        if (child.tag == "transform") return &child;
        const Element* nested = child.tag == "sensor" ? transformWithin(child) : nullptr;
        if (nested) return nested;
    }
    return nullptr;
}

} // namespace

glm::dvec3 chooseOrigin(const Scene& scene) {
    glm::dvec3 lower(std::numeric_limits<double>::infinity()), upper = -lower;
    const auto add = [&](const glm::vec3& position, double radius) {
        lower = glm::min(lower, glm::dvec3(position) - radius);
        upper = glm::max(upper, glm::dvec3(position) + radius);
    };
    for (const ShapeDescription& shape : scene.shapes) {
        if (shape.sphere) add(shape.sphere->center, shape.sphere->radius);
        for (const glm::vec3& position : shape.mesh.positions) add(position, 0);
    }
    const glm::dvec3 center = scene.origin + (lower + upper) / 2.0;
    const bool isFar = lower.x <= upper.x && largest(center) > farAway * largest(upper - lower);
    return isFar ? center : glm::dvec3(0);
}

glm::dvec3 placeOfSensor(const Element& root) {
    try {
        for (const Element& sensor : root.children)
            if (const Element* transform = sensor.tag == "sensor" ? transformWithin(sensor) : nullptr)
                return glm::dvec3(parseTransform(*transform)[3]);
    } catch (const InputError&) { // whoever loads the scene about this place says what is wrong
    }
    return glm::dvec3(0);
}

} // namespace quasilux

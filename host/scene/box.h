// Boxes along the axes.
#pragma once

#include <glm/glm.hpp>
#include <limits>

namespace quasilux {

/// Empty, with `lower` above `upper`, until something is added.
struct Box {
    glm::dvec3 lower{std::numeric_limits<double>::infinity()}, upper{-std::numeric_limits<double>::infinity()};

    void add(const glm::dvec3& p) {
        lower = glm::min(lower, p);
        upper = glm::max(upper, p);
    }
    void add(const Box& other) {
        lower = glm::min(lower, other.lower);
        upper = glm::max(upper, other.upper);
    }
    glm::dvec3 center() const { return 0.5 * (lower + upper); }
    glm::dvec3 extent() const { return upper - lower; }
    double diagonal() const { return glm::length(extent()); }
    /// Boxes that touch do.
    bool overlaps(const Box& other) const {
        return glm::all(glm::lessThanEqual(lower, other.upper)) && glm::all(glm::lessThanEqual(other.lower, upper));
    }
};

/// About a box that is carried by an affine map.
inline Box carried(const Box& box, const glm::dmat4x3& map) {
    const glm::dvec3 center = map * glm::dvec4(box.center(), 1), half = 0.5 * box.extent();
    const glm::dvec3 extent = glm::abs(map[0]) * half.x + glm::abs(map[1]) * half.y + glm::abs(map[2]) * half.z;
    return {center - extent, center + extent};
}

/// The first of equals.
inline int longestAxis(const glm::dvec3& extent) {
    return extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
}

} // namespace quasilux

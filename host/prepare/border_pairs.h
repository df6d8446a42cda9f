// All pairs of boxes that overlap.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <limits>
#include <vector>

namespace quasilux {

struct BorderBox {
    glm::dvec3 lower{std::numeric_limits<double>::infinity()}, upper{-std::numeric_limits<double>::infinity()};

    void add(const glm::dvec3& p) {
        lower = glm::min(lower, p);
        upper = glm::max(upper, p);
    }
    void add(const BorderBox& other) {
        lower = glm::min(lower, other.lower);
        upper = glm::max(upper, other.upper);
    }
    bool overlaps(const BorderBox& other) const {
        return glm::all(glm::lessThanEqual(lower, other.upper)) && glm::all(glm::lessThanEqual(other.lower, upper));
    }
};

/// Calls visit(i, j) with i < j once for every two overlapping boxes, in an order that depends on the boxes alone.
/// O(n log n + pairs) also where sizes differ widely: a tree of boxes is walked against itself.
void forEachOverlappingPair(const std::vector<BorderBox>& boxes, const std::function<void(unsigned, unsigned)>& visit);

} // namespace quasilux

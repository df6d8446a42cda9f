// Primitives as the traversal kernels test them: blocks of eight, and boxes that surely hold them.
#pragma once

#include "prepare/bvh.h"

#include <cstddef>

namespace quasilux {

struct PrimitiveBounds {
    glm::vec3 lower, upper;
};

/// Box that holds the primitive and what rounding makes of it in a block. `index` names it in errors.
/// Throws InputError where a coordinate is not finite or exceeds 1e12.
PrimitiveBounds boundsOf(const BvhPrimitive& primitive, size_t index);

/// Block of `count` <= 8 primitives, given by their indices; further lanes are empty.
shared::PrimitiveBlock makeBlock(const std::vector<BvhPrimitive>& primitives, const unsigned* indices, unsigned count);

} // namespace quasilux

// Vectors as the kernels store them.
#pragma once

#include "shared_types.h"

#include <glm/glm.hpp>

namespace quasilux {

inline shared::Packed3 pack(const glm::dvec3& v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

inline glm::dvec3 unpack(const shared::Packed3& p) { return {p.x, p.y, p.z}; }

} // namespace quasilux

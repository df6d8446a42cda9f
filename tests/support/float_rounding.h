// Rounding to float and back, so that a test in double sees the same number as the kernel.
#pragma once

#include <glm/glm.hpp>

namespace quasilux {

/// Through a volatile, since GCC 12 at -O2 drops the conversion of two neighbouring members to float and back.
inline double roundToFloat(double x) {
    const volatile float f = static_cast<float>(x);
    return f;
}

inline glm::dvec3 roundToFloat(glm::dvec3 v) { return {roundToFloat(v.x), roundToFloat(v.y), roundToFloat(v.z)}; }

} // namespace quasilux

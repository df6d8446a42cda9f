// .vol files: Mitsuba's binary grids of floating point values, version 3.
#pragma once

#include "util/error.h"

#include <array>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace quasilux {

struct VolFile {
    std::array<unsigned, 3> size{}; ///< along x, y, z
    unsigned channels = 0;
    glm::dvec3 lower{}, upper{}; ///< the box that the file states
    std::vector<float> values;   ///< channels of a voxel side by side, x fastest, z slowest; finite, at least 0
};

/// Throws InputError at `where`, the place that names the file, for whatever is wrong with it.
VolFile readVolFile(const std::string& path, const SourceLocation& where);

} // namespace quasilux

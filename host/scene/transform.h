// <transform>: its operations, and what affine matrices do to points and normals.
#pragma once

#include "scene/xml/element.h"

#include <cmath>
#include <glm/glm.hpp>
#include <string>
#include <utility>

namespace quasilux {

/// Product of the operations, each multiplied from the left. Finite, affine and not singular, or InputError.
glm::dmat4 parseTransform(const Element& element);

/// Three numbers from x, y, z (missing ones are `missing`) or from value="a,b,c"; a single one stands for all.
glm::dvec3 parseVector(const Element& element, double missing);

/// Axes across the unit `n` (Duff et al. 2017, "Building an orthonormal basis, revisited"), which Mitsuba counts angles
/// from, and which are `up` where a view has none.
std::pair<glm::dvec3, glm::dvec3> axesAcross(const glm::dvec3& n);

/// `point` in single precision. Throws InputError at `where` if it does not fit.
glm::vec3 toSingle(const glm::dvec3& point, const SourceLocation& where);

inline glm::dvec3 transformPoint(const glm::dmat4& m, const glm::dvec3& p) { return glm::dvec3(m * glm::dvec4(p, 1)); }
inline glm::dvec3 transformVector(const glm::dmat4& m, const glm::dvec3& v) { return glm::dmat3(m) * v; }

/// Whether `m` turns or mirrors, and scales all directions alike so that squared lengths are multiplied by
/// `squaredScale`; `tolerance` is relative.
inline bool keepsAngles(const glm::dmat3& m, double squaredScale, double tolerance) {
    const glm::dmat3 product = glm::transpose(m) * m;
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row)
            if (std::abs(product[column][row] - (column == row ? squaredScale : 0)) > tolerance * squaredScale)
                return false;
    return true;
}

} // namespace quasilux

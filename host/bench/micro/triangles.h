// Triangles of procedural scenes.
#pragma once

#include "prepare/bvh.h"

namespace quasilux {

inline void addTriangle(std::vector<BvhPrimitive>& out, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    BvhPrimitive primitive;
    primitive.v0 = a;
    primitive.v1 = b;
    primitive.v2 = c;
    out.push_back(primitive);
}

inline void addQuad(std::vector<BvhPrimitive>& out, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c,
                    const glm::vec3& d) {
    addTriangle(out, a, b, c);
    addTriangle(out, a, c, d);
}

} // namespace quasilux

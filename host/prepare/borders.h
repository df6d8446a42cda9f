// Smooth patches of the surfaces and the straight segments that border them, for the density estimate
// (docs/method/density.md).
#pragma once

#include "scene/scene.h"

#include <optional>
#include <vector>

namespace quasilux {

/// A straight piece of a border of a surface patch: free edge, crease, or curve where another surface cuts it. The
/// density estimate does not look across it.
struct BorderSegment {
    shared::Packed3 a, b;
    unsigned patchA, patchB; ///< the patches that it bounds; QL_NONE where there is only one
};

struct SurfaceBorders {
    std::vector<unsigned>
        patchOfPrimitive; ///< by primitive index (shapes in order, triangles in order; a sphere is one)
    unsigned patchCount = 0;
    std::vector<float> patchCurvature; ///< by patch, 1/scene unit: larger principal curvature that 90 % of its area
                                       ///< stays below; 0 = flat
    std::vector<BorderSegment> segments;
    struct Overlap {
        unsigned first, second; ///< primitives
        glm::dvec3 place;       ///< within both
    };
    std::optional<Overlap> overlap; ///< of triangles that lie in one plane and face the same way: the first pair
    /// The same of Scene::groups, each by itself. In `segments` patch p of instance i has the number firstPatches()[i]
    /// + p.
    std::vector<SurfaceBorders> groups;
};

/// What is added to the numbers of a group's patches, by instance: they follow those of the world. Throws InputError
/// where there are too many.
std::vector<unsigned> firstPatches(const Scene& scene, const SurfaceBorders& borders);

/// Finds them. Triangles, also of different shapes, join a patch across an edge that exactly two of them share, with
/// the same orientation, normals less than `creaseAngle` (radians) apart and materials that store the same photons
/// (storingOf); vertices that coincide within float rounding are one, and so are triangles with the same three
/// vertices. Every other edge is a segment, once (several times only where more than two patches meet: each is named).
/// Where a surface passes through another, or through itself, the curve of intersection is a segment of both; circles
/// on spheres become chords, 128 to the full turn. Surfaces that only touch add none, as the edges of one of them are
/// segments already. Edges that overlap without matching vertex by vertex (T-junctions) stay segments, also inside a
/// plane: the estimate there is right, only noisier; so do edges that instances have in common with other shapes. A
/// shape of a `null` bsdf is one patch without segments, and cuts nothing. Positions must be finite.
SurfaceBorders findBorders(const Scene& scene, double creaseAngle = 0.35);

} // namespace quasilux

// The tables of guided emission (kernels/guide.clh), and the plain ones of a scene about which nothing was learned.
#pragma once

#include "learned_types.h"

#include <array>
#include <cstddef>
#include <vector>

namespace quasilux {

struct EmitterTables;

inline constexpr std::size_t emissionDimensions = EMISSION_DIMENSIONS;

/// A box of the cube of emission numbers and the probability that a photon begins in it.
struct GuideBox {
    std::array<double, emissionDimensions> lower{}, size{1, 1, 1, 1, 1};
    double probability = 1;

    double volume() const;
};

struct GuideTables {
    std::vector<shared::GuideSource> sources;
    std::vector<shared::GuideLeaf> leaves;
    bool isGuided = false; ///< or else photons begin in proportion to power alone
    /// Of a photon, times the number of photons, W: the geometric mean over photons, but no less than leaves the heaviest
    /// ones within the range of stored flux.
    double typicalFlux = 0;
};

/// Boxes with their sources, which together fill every emitter's cube; only the ratios of their probabilities count.
struct SourceBox {
    unsigned source = 0;
    GuideBox box;
};
GuideTables makeGuideTables(const EmitterTables& emitters, std::vector<shared::GuideSource> sources,
                            const std::vector<SourceBox>& boxes);

/// Shines into the scene from outside.
bool isDistant(const shared::Emitter& emitter);
/// Of radiance from all around.
bool isSurroundings(const shared::Emitter& emitter);

/// An emitter in its own coordinates; `first`: its first source.
shared::GuideSource plainSource(unsigned emitter, unsigned first);

/// One box for each emitter that shines, in proportion to its power.
GuideTables plainGuide(const EmitterTables& emitters);

} // namespace quasilux

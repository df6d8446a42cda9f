// Where photons are aimed that are scattered far from what the camera sees (kernels/aim.clh, docs/method/learning.md).
#pragma once

#include "learn/openings.h"
#include "learned_types.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace quasilux {

/// Openings that photons are aimed at together, each with its share of them: one, or squares within each other that
/// face every place, where what matters lies about one place, ever more thinly.
struct AimSet {
    std::vector<Opening> openings;
    std::vector<double> shares;
    double surest = 0.9; ///< probability of aiming where all that matters comes this way

    /// Of aimed photons along the ray, about, over that of photons spread over all directions.
    double density(const UsefulRay& ray) const;
    /// Share of what comes along the ray that is worth aiming: about one place that of aimed photons where every second
    /// one is aimed; through an opening with walls about it all of it, if it is seen as a small part of all directions.
    double claim(const UsefulRay& ray) const;
};

inline constexpr std::size_t mostAimSets = 8;

/// The way of a photon from vertex `v` of an importance path to the one before, by the throughput there; none where it
/// brings nothing.
std::optional<UsefulRay> scatteredRay(const shared::ImportancePath& path, std::size_t v);

/// Sets of openings that light should come through: those that light from outside comes through, and what the paths
/// found beside them. `pathWeights`: 1 / brightness of each path's pixel, over the number of paths; `isWasted`: as
/// wastedScattering has it; `radius`: of the order of the scene.
std::vector<AimSet> findAims(const std::vector<shared::ImportancePath>& paths, const std::vector<double>& pathWeights,
                             const std::vector<bool>& isWasted, const std::vector<Opening>& fromOutside, double radius);

/// As the kernels read them, and the place of a set's first opening there.
std::vector<shared::AimSource> aimTable(const std::vector<AimSet>& sets);
std::size_t firstOf(const std::vector<AimSet>& sets, std::size_t set);

} // namespace quasilux

// The settings that a search may try next: neighbours of the best one so far in one coordinate.
#pragma once

#include "auto/freedom.h"

#include <array>
#include <string>
#include <vector>

namespace quasilux {

enum class Coordinate { split, bdd, variant, photons, radius };
/// One after the other; those that tend to gain most for their time come first. BDD 0 has the shortest paths and mostly
/// the least error, so it is tried first where the search starts with another; where it does not, others come last.
std::array<Coordinate, 5> searchOrder(const RenderSettings& start);

/// Factors of photons per pass and radius that are tried, and how far they may go from where the search starts.
inline constexpr double photonsStep = 2, mostPhotons = 16, radiusStep = 1.4;

/// Where a search begins: `settings`, but with as many photons as the pixels ask for, even if they are few, where the search
/// may raise them again. A small image by the default spends nearly all of its time on photons, and pilots take long.
RenderSettings searchStart(const RenderSettings& settings, const Scene& scene, const Freedom& freedom,
                           const StopRule& stop);

/// What may be tried in this coordinate instead of `from`, nothing where it is not free; splits that come to the same
/// as another one are left out. A split with nothing genuine diffuse comes with the alternative variant where that is
/// free. `photons`: those that a pass of `from` emits.
std::vector<RenderSettings> neighbours(Coordinate coordinate, const RenderSettings& from, unsigned photons,
                                       const Scene& scene, const Freedom& freedom);

/// text() of all neighbours of where the search starts, in the order in which they are tried.
std::vector<std::string> firstCandidates(const Freedom& freedom, const RenderSettings& start, unsigned photons,
                                         const Scene& scene);

/// The same for settings whose kernels are compiled the same.
std::string kernelKey(const RenderSettings& settings, const Scene& scene);

/// "BDD 0, main, split auto, 393216 photons/pass, radius 1".
std::string text(const RenderSettings& settings, unsigned photons);

} // namespace quasilux

// The settings that a search may try: all methods, then numbers beside those of the best one so far.
#pragma once

#include "auto/freedom.h"

#include <string>
#include <vector>

namespace quasilux {

/// Factors of photons per pass and radius between a setting and those beside it.
inline constexpr double photonsStep = 2, radiusStep = 1.4;

/// Where a search begins: `settings`, but with as many photons as the pixels ask for, even if they are few, where the
/// search may raise them again, and with kernels that serve all methods() alike. A small image by the default spends
/// nearly all of its time on photons, and pilots take long.
RenderSettings searchStart(const RenderSettings& settings, const Scene& scene, const Freedom& freedom,
                           const StopRule& stop);

/// Splits, variants, BDDs and ways to caustic light in all combinations that `freedom` allows, `start` first. Those
/// that come to the same as another one are left out: with nothing quasi-specular the variants are one, with nothing
/// genuine diffuse the main variant is the standard method. Those that follow little come last.
std::vector<RenderSettings> methods(const RenderSettings& start, const Scene& scene, const Freedom& freedom);

/// Twice and half the photons, a wider and a smaller radius. `photons`: those that a pass of `from` emits.
std::vector<RenderSettings> numbersBeside(const RenderSettings& from, unsigned photons, const Freedom& freedom);

/// text() of what may be tried from `start`, in the order in which it would be.
std::vector<std::string> firstCandidates(const Freedom& freedom, const RenderSettings& start, unsigned photons,
                                         const Scene& scene);

/// "BDD 0, main, split auto, 393216 photons/pass, radius 1".
std::string text(const RenderSettings& settings, unsigned photons);

} // namespace quasilux

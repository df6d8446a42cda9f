// Where the camera's paths gather photons, by distance from the eye (DISTANCE_OCTAVES).
#pragma once

#include "learned_types.h"

#include <array>
#include <vector>

namespace quasilux {

/// Distance within which a hundredth of what is gathered lies: there the first octave begins. Positive.
float nearestGathered(const std::vector<shared::ImportancePath>& paths, const std::vector<double>& pathWeights,
                      const shared::Packed3& eye);

/// Throughput with which photons are gathered, summed over the paths, each times its weight.
std::array<double, DISTANCE_OCTAVES> gatheredByOctave(const std::vector<shared::ImportancePath>& paths,
                                                      const std::vector<double>& pathWeights,
                                                      const shared::ImportanceGrid& grid);

} // namespace quasilux

// Roulette by one number a path: each event is survived with its probability, also after the number is drawn anew.
//
// False alarms: until a new number is drawn the count is exact to two paths, since the numbers are spread evenly; after
// it four events are held to 4.5 standard errors of a binomial count, 3e-5 for the program; the seed is fixed.
#include "support/test_kernels.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace quasilux {
namespace {

constexpr unsigned paths = 1 << 20;
constexpr double resolution = 0x1p-8; // ROULETTE_RESOLUTION of kernels/roulette.clh
const std::vector<float> probabilities{0.9f, 0.5f, 0.3f, 0.25f, 0.1f, 0.8f, 0.5f, 0.7f, 0.9f};

/// Greatest deviation of the number of paths that survive an event, in units of what is allowed.
double worstDeviation(const std::string& options) {
    Program program = testProgram("roulette.cl", options);
    Buffer<float> probability(testDevice(), probabilities, "probability");
    Buffer<unsigned> survived(testDevice(), paths, "survived");
    program.kernel("survivedEvents")
        .launch(paths, probability, cl_uint(probabilities.size()), survived, cl_uint(paths));
    const auto counts = survived.read();
    double worst = 0, expected = 1;
    for (unsigned k = 0; k < probabilities.size(); ++k) {
        const bool isEven = expected > resolution;
        expected *= probabilities[k];
        const auto found = double(std::count_if(counts.begin(), counts.end(), [&](unsigned n) { return n > k; }));
        const double allowed = isEven ? 2 : 4.5 * std::sqrt(paths * expected * (1 - expected));
        worst = std::max(worst, std::abs(found - paths * expected) / allowed);
    }
    return worst;
}

TEST(Roulette, SurvivesEachEventWithItsProbability) { EXPECT_LT(worstDeviation(""), 1); }

TEST(Roulette, ControlNewNumberAgainstOldSurvival) { EXPECT_GT(worstDeviation("-DKEEPS_SURVIVAL"), 1); }

} // namespace
} // namespace quasilux

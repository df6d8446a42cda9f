// Do samples follow their density? Pearson's chi-squared test of a histogram against the density's integral over each
// cell.
//
// False alarms: every test program allows itself a probability of 1e-4 over all its chi-squared and z tests together,
// and each single test the level that follows by Sidak's correction. The numbers are seeded, so a program that passes
// keeps passing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace quasilux {

/// Cells of equal size over [u0,u1] x [v0,v1]; the cell behind the last one takes whatever falls outside.
struct SampleGrid {
    double u0, u1, v0, v1;
    int nu, nv;

    int cells() const { return nu * nv; }
    /// Cell of (u,v), or cells() if outside.
    int cell(double u, double v) const;
};

/// A point of the midpoint rule inside a cell; `weight` is its share of the (u,v) area.
struct QuadraturePoint {
    double u, v, weight;
    int cell;
};
std::vector<QuadraturePoint> gridQuadrature(const SampleGrid& grid, int pointsPerSide);

/// Upper regularised incomplete gamma function Q(a, x).
double regularisedGammaQ(double a, double x);

/// p-value of `counts` against `probabilities`. Cells that expect fewer than 5 samples are pooled. If there is one
/// count more than probabilities, it is of the outside, whose probability is what is missing to 1.
double chiSquaredPValue(const std::vector<uint64_t>& counts, const std::vector<double>& probabilities);

/// Two-sided p-value of a normal deviate.
double normalPValue(double z);

/// Level of a single test, so that `tests` of them raise a false alarm with probability 1e-4 together.
double significanceLevel(int tests);

/// Uniform numbers k 2^-24 in [0,1), as the kernels' generator gives them.
std::vector<float> uniformNumbers(std::size_t count, uint64_t seed);

/// All tuples of `dimension` numbers out of {0, 2^-24, 1/2, 1 - 2^-24}: where samplers divide by zero.
std::vector<float> extremeNumbers(int dimension);

} // namespace quasilux

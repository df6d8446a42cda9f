#include "support/chi_squared.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <stdexcept>

namespace quasilux {

int SampleGrid::cell(double u, double v) const {
    const double x = (u - u0) / (u1 - u0) * nu, y = (v - v0) / (v1 - v0) * nv;
    if (!(x >= 0 && x <= nu && y >= 0 && y <= nv)) return cells();
    return std::min(static_cast<int>(y), nv - 1) * nu + std::min(static_cast<int>(x), nu - 1);
}

std::vector<QuadraturePoint> gridQuadrature(const SampleGrid& grid, int pointsPerSide) {
    const int columns = grid.nu * pointsPerSide, rows = grid.nv * pointsPerSide;
    const double du = (grid.u1 - grid.u0) / columns, dv = (grid.v1 - grid.v0) / rows;
    std::vector<QuadraturePoint> points;
    points.reserve(static_cast<size_t>(columns) * rows);
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column)
            points.push_back({grid.u0 + (column + 0.5) * du, grid.v0 + (row + 0.5) * dv, du * dv,
                              row / pointsPerSide * grid.nu + column / pointsPerSide});
    return points;
}

namespace {

/// Series for P(a,x), x < a + 1 (Abramowitz & Stegun 6.5.29).
double gammaSeriesP(double a, double x) {
    double term = 1 / a, sum = term;
    for (int n = 1; n < 10000 && std::abs(term) > 1e-16 * std::abs(sum); ++n) sum += term *= x / (a + n);
    return sum * std::exp(-x + a * std::log(x) - std::lgamma(a));
}

/// Continued fraction for Q(a,x), x >= a + 1 (Abramowitz & Stegun 6.5.31), by Lentz's method.
double gammaFractionQ(double a, double x) {
    double b = x + 1 - a, c = 1e300, d = 1 / b, h = d;
    for (int i = 1; i < 10000; ++i) {
        const double an = -i * (i - a);
        b += 2;
        d = 1 / (an * d + b);
        c = b + an / c;
        h *= d * c;
        if (std::abs(d * c - 1) < 1e-15) break;
    }
    return h * std::exp(-x + a * std::log(x) - std::lgamma(a));
}

struct Cell {
    double expected, observed;
};

/// Joins cells, the smallest first, until each expects at least 5.
std::vector<Cell> poolCells(std::vector<Cell> cells) {
    std::sort(cells.begin(), cells.end(), [](const Cell& a, const Cell& b) { return a.expected < b.expected; });
    size_t first = 0;
    while (first + 1 < cells.size() && cells[first].expected < 5) {
        cells[first + 1].expected += cells[first].expected;
        cells[first + 1].observed += cells[first].observed;
        ++first;
    }
    return {cells.begin() + static_cast<std::ptrdiff_t>(first), cells.end()};
}

} // namespace

double regularisedGammaQ(double a, double x) {
    if (x <= 0) return 1;
    return x < a + 1 ? 1 - gammaSeriesP(a, x) : gammaFractionQ(a, x);
}

double chiSquaredPValue(const std::vector<uint64_t>& counts, const std::vector<double>& probabilities) {
    const auto total = static_cast<double>(std::accumulate(counts.begin(), counts.end(), uint64_t{0}));
    std::vector<Cell> cells;
    for (size_t i = 0; i < probabilities.size(); ++i)
        cells.push_back({total * probabilities[i], static_cast<double>(counts.at(i))});
    if (counts.size() == probabilities.size() + 1) {
        const double inside = std::accumulate(probabilities.begin(), probabilities.end(), 0.0);
        cells.push_back({total * std::max(1 - inside, 0.0), static_cast<double>(counts.back())});
    }
    cells = poolCells(std::move(cells));
    if (cells.size() < 2) throw std::invalid_argument("too few samples or cells for a chi-squared test");
    double statistic = 0;
    for (const Cell& cell : cells)
        statistic += (cell.observed - cell.expected) * (cell.observed - cell.expected) / cell.expected;
    return regularisedGammaQ(0.5 * static_cast<double>(cells.size() - 1), 0.5 * statistic);
}

double normalPValue(double z) { return std::erfc(std::abs(z) / std::sqrt(2.0)); }

double significanceLevel(int tests) { return -std::expm1(std::log1p(-1e-4) / tests); }

std::vector<float> uniformNumbers(std::size_t count, uint64_t seed) {
    std::mt19937_64 engine(seed);
    std::vector<float> numbers(count);
    for (float& u : numbers) u = static_cast<float>(engine() >> 40) * 0x1p-24f;
    return numbers;
}

std::vector<float> extremeNumbers(int dimension) {
    const float values[] = {0.0f, 0x1p-24f, 0.5f, 1 - 0x1p-24f};
    std::vector<float> numbers;
    for (int index = 0; index < 1 << (2 * dimension); ++index)
        for (int d = 0; d < dimension; ++d) numbers.push_back(values[index >> (2 * d) & 3]);
    return numbers;
}

} // namespace quasilux

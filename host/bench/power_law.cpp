#include "bench/power_law.h"

#include <algorithm>
#include <cmath>

namespace quasilux {

std::optional<PowerLaw> fitPowerLaw(const std::vector<std::pair<double, double>>& points) {
    std::vector<std::pair<double, double>> logs;
    double meanX = 0, meanY = 0;
    for (const auto& [x, y] : points) {
        if (!(std::isfinite(x) && std::isfinite(y) && x > 0 && y > 0)) continue;
        logs.emplace_back(std::log(x), std::log(y));
        meanX += logs.back().first;
        meanY += logs.back().second;
    }
    const auto n = static_cast<double>(logs.size());
    if (n < 3) return std::nullopt;
    meanX /= n;
    meanY /= n;
    double sumXX = 0, sumXY = 0, sumYY = 0;
    for (const auto& [x, y] : logs) {
        sumXX += (x - meanX) * (x - meanX);
        sumXY += (x - meanX) * (y - meanY);
        sumYY += (y - meanY) * (y - meanY);
    }
    if (!(sumXX > 0)) return std::nullopt;
    const double exponent = sumXY / sumXX;
    const double squaresLeft = std::max(0.0, sumYY - exponent * sumXY);
    return PowerLaw{exponent, std::sqrt(squaresLeft / (n - 2) / sumXX)};
}

} // namespace quasilux

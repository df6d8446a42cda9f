#include "photometry/glare.h"

#include <cmath>
#include <numbers>

namespace quasilux {

double GlareSources::strength() const {
    double sum = 0;
    for (const GlareSource& source : seen) sum += source.strength();
    return sum;
}

GlareRating unifiedGlareRating(double strength, double indirectIlluminance, double standardError) {
    if (!(indirectIlluminance > 0)) return {std::nan(""), std::nan("")};
    const double background = indirectIlluminance / std::numbers::pi;
    // d UGR = 8 / ln 10 dE / E.
    return {8 * std::log10(0.25 / background * strength), 8 / std::numbers::ln10 * standardError / indirectIlluminance};
}

} // namespace quasilux

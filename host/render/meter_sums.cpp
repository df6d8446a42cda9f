#include "render/meter_sums.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

namespace quasilux {

namespace {

// Of the mean radiance one splat may be 2^-37 and the sum of a pixel 2^27 before anything is lost: photons bring about
// 2^-5 of it each, at a caustic's focus or in a narrow lobe up to 2^15 of that.
constexpr int quantumBits = 36;

} // namespace

float quantaPerRadiance(double meanRadiance, unsigned samples) {
    const double sum = meanRadiance * samples;
    const int exponent = sum > 0 && std::isfinite(sum) ? std::ilogb(sum) + 1 : 0;
    return static_cast<float>(std::ldexp(1.0, std::clamp(quantumBits - exponent, -100, 100)));
}

size_t splatWords(unsigned slots) {
    return 6 * static_cast<size_t>(std::popcount((slots | slots >> LIGHT_CLASSES) & ((1u << LIGHT_CLASSES) - 1)));
}

float sampleScale(const shared::Meter& meter) {
    const bool isIrradiance = meter.kind == METER_AREA || meter.kind == METER_GRID;
    return (isIrradiance ? std::numbers::pi_v<float> : 1.f) / static_cast<float>(meter.samples);
}

} // namespace quasilux

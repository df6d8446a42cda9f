#include "scene/textures/image_primaries.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace quasilux {

namespace {

/// x and y of red, green, blue and white, as OpenEXR has them.
using Chromaticities = std::array<float, 8>;
constexpr Chromaticities ofSrgb{0.64f, 0.33f, 0.3f, 0.6f, 0.15f, 0.06f, 0.3127f, 0.329f};
constexpr Chromaticities ofXyz{1, 0, 0, 1, 0, 0, 1.f / 3, 1.f / 3};
constexpr float rounding = 1e-4f; // files state four digits

glm::dvec3 xyzOf(double x, double y) { return {x, y, 1 - x - y}; }

/// Columns are X, Y, Z of the primaries, scaled so that their sum is white with Y = 1 (SMPTE RP 177-1993).
glm::dmat3 toXyz(const Chromaticities& c) {
    const glm::dmat3 primaries(xyzOf(c[0], c[1]), xyzOf(c[2], c[3]), xyzOf(c[4], c[5]));
    const glm::dvec3 amounts = glm::inverse(primaries) * (xyzOf(c[6], c[7]) / double(c[7]));
    return {primaries[0] * amounts.x, primaries[1] * amounts.y, primaries[2] * amounts.z};
}

bool agree(const Chromaticities& a, const Chromaticities& b) {
    return std::equal(a.begin(), a.end(), b.begin(), [](float x, float y) { return std::abs(x - y) < rounding; });
}

Chromaticities chromaticitiesOf(const OIIO::ImageSpec& spec) {
    const auto& names = spec.channelnames;
    if (names.size() >= 3 && names[0] == "X" && names[1] == "Y" && names[2] == "Z") return ofXyz;
    Chromaticities found = ofSrgb;
    const OIIO::TypeDesc type(OIIO::TypeDesc::FLOAT, static_cast<int>(found.size()));
    spec.getattribute("chromaticities", type, found.data());
    return found;
}

} // namespace

std::optional<glm::dmat3> toLinearSrgb(const OIIO::ImageSpec& spec) {
    if (spec.nchannels < 3) return std::nullopt;
    const Chromaticities found = chromaticitiesOf(spec);
    if (agree(found, ofSrgb)) return std::nullopt;
    const glm::dmat3 matrix = glm::inverse(toXyz(ofSrgb)) * toXyz(found);
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row)
            if (!std::isfinite(matrix[column][row])) return std::nullopt; // primaries that span no colours
    return matrix;
}

} // namespace quasilux

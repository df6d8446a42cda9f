// The colour of light whose amount is said in photometric units.
#include "scene/emitters/emitters.h"
#include "scene/photometric_units.h"
#include "scene/spectrum/spectrum.h"

#include <cmath>
#include <fmt/format.h>

namespace quasilux {

namespace {

constexpr double coldest = 500, hottest = 40000; // kelvin

/// Radiance of a black body by wavelength in nm, in proportion to what it has at 560 nm (Planck's law).
Rgb colorOfBlackBody(double kelvin, const SourceLocation& where, LoadContext& context) {
    constexpr double secondConstant = 1.438776877e7; // nm K (CODATA 2018)
    const auto planck = [&](double nm) { return std::pow(nm, -5) / std::expm1(secondConstant / (nm * kelvin)); };
    return colorOfSpectrum([&](double nm) { return planck(nm) / planck(560); }, ColorUse::emission, where, context);
}

} // namespace

Rgb readLightColour(Properties& properties) {
    Rgb tint = properties.emission("tint", {1, 1, 1});
    if (isBlack(tint))
        throw InputError(
            properties.where("tint"),
            fmt::format("parameter 'tint' of {} is black; it says a colour only. Remove the emitter if it is off.",
                        properties.describe()));
    if (properties.has("colour_temperature")) {
        const SourceLocation where = properties.where("colour_temperature");
        if (properties.has("tint"))
            throw InputError(where,
                             fmt::format("{} has both tint and colour_temperature; keep one.", properties.describe()));
        const double kelvin = properties.number("colour_temperature", 0);
        if (!(kelvin >= coldest && kelvin <= hottest))
            throw InputError(where, fmt::format("parameter 'colour_temperature' is {}; expected {} to {} kelvin.",
                                                kelvin, coldest, hottest));
        tint = colorOfBlackBody(kelvin, where, properties.context());
    }
    const double all = luminanceOf(tint.r, tint.g, tint.b);
    return tint * static_cast<float>(1 / all);
}

bool isPhotometric(const Properties& properties) {
    return properties.context().scene.settings.units == Units::photometric;
}

double radiantFactor(const Properties& properties) { return isPhotometric(properties) ? 1 : 1 / luminousEfficacy; }

} // namespace quasilux

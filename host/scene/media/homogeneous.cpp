// <medium type="homogeneous">: the same everywhere within it.
#include "scene/media/medium_plugin.h"

#include <cmath>
#include <fmt/format.h>

namespace quasilux {

void readHomogeneous(Properties& properties, MediumDescription& medium) {
    for (const char* name : {"sigma_s", "sigma_a"})
        properties.refuse(name, "as in Mitsuba 3, give sigma_t = sigma_a + sigma_s and albedo = sigma_s / sigma_t");
    const Rgb sigmaT = properties.positiveColor("sigma_t", {1, 1, 1}, ColorUse::reflectance);
    const auto scale = static_cast<float>(properties.numberAbove("scale", 1, 0, false));
    medium.sigmaT = sigmaT * scale;
    if (!std::isfinite(largest(medium.sigmaT)) || std::isnan(smallest(medium.sigmaT)))
        throw InputError(
            properties.where("scale"),
            fmt::format("sigma_t times scale of {} is out of the range of single precision.", properties.describe()));
    medium.albedo = properties.reflectance("albedo", 0.75f);
}

} // namespace quasilux

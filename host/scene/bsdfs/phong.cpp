// <bsdf type="phong"> of Mitsuba 0.6: f = kd / π + ks (n + 2) / (2 π) cos^n α, α from the mirror direction.
#include "scene/bsdfs/bsdf_plugin.h"

#include <fmt/format.h>

namespace quasilux {

BsdfLobes readPhong(Properties& properties) {
    const Rgb diffuse = properties.reflectance("diffuse_reflectance", 0.5f);
    const Rgb specular = properties.reflectance("specular_reflectance", 0.2f);
    const double exponent = properties.numberAbove("exponent", 30, 0, false);
    const Rgb sum = {diffuse.r + specular.r, diffuse.g + specular.g, diffuse.b + specular.b};
    if (largest(sum) > 1 + 1e-6f)
        throw InputError(
            properties.element().where,
            fmt::format("phong: diffuse_reflectance + specular_reflectance is ({}, {}, {}), so more light would "
                        "leave than arrives; every channel of the sum must be at most 1.",
                        sum.r, sum.g, sum.b));
    BsdfLobes lobes;
    lobes.front.push_back(makeLobe(LOBE_LAMBERT, "diffuse", diffuse, lambertHalfWidth));
    lobes.front.push_back(makeLobe(LOBE_PHONG, "specular", specular, phongHalfWidth(exponent)));
    lobes.front.back().device.exponent = static_cast<float>(exponent);
    return lobes;
}

} // namespace quasilux

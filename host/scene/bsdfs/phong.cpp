// <bsdf type="phong"> of Mitsuba 0.6: f = kd / π + ks (n + 2) / (2 π) cos^n α, α from the mirror direction.
#include "scene/bsdfs/bsdf_plugin.h"

#include <fmt/format.h>

namespace quasilux {

BsdfLobes readPhong(Properties& properties) {
    const Reflectance diffuse = readReflectance(properties, "diffuse_reflectance", 0.5f);
    const Reflectance specular = readReflectance(properties, "specular_reflectance", 0.2f);
    const double exponent = properties.numberAbove("exponent", 30, 0, false);
    const Rgb sum = {diffuse.largest.r + specular.largest.r, diffuse.largest.g + specular.largest.g,
                     diffuse.largest.b + specular.largest.b};
    const bool textured = diffuse.texture != 0 || specular.texture != 0;
    if (largest(sum) > 1 + 1e-6f)
        throw InputError(
            properties.element().where,
            fmt::format("phong: diffuse_reflectance + specular_reflectance is ({}, {}, {}){}, so more light would "
                        "leave than arrives; every channel of the sum must be at most 1.",
                        sum.r, sum.g, sum.b, textured ? " where both textures are largest" : ""));
    BsdfLobes lobes;
    lobes.front.push_back(makeLobe(LOBE_LAMBERT, "diffuse", diffuse, lambertHalfWidth));
    lobes.front.push_back(makeLobe(LOBE_PHONG, "specular", specular, phongHalfWidth(exponent)));
    lobes.front.back().device.exponent = static_cast<float>(exponent);
    return lobes;
}

} // namespace quasilux

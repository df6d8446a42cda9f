// <bsdf type="plastic">: a diffuse base under a smooth dielectric coat.
#include "scene/bsdfs/bsdf_plugin.h"

namespace quasilux {

namespace {

// Of diffuse light: the integral of 2 cos F over the cosines.
double diffuseFresnel(double eta) {
    constexpr int steps = 20000;
    double sum = 0;
    for (int k = 0; k < steps; ++k) {
        const double cosine = (k + 0.5) / steps;
        sum += 2 * cosine * dielectricReflectance(cosine, eta);
    }
    return sum / steps;
}

} // namespace

BsdfLobes readPlastic(Properties& properties) {
    const double inside = readRefractiveIndex(properties, "int_ior", "polypropylene");
    const double outside = readRefractiveIndex(properties, "ext_ior", "air");
    const double eta = inside / outside;
    LobeDescription specular =
        makeLobe(LOBE_CONDUCTOR, "specular", readReflectance(properties, "specular_reflectance", 1), 0);
    specular.device.scattering = SCATTER_SPECULAR;
    specular.device.eta = {float(eta), float(eta), float(eta)}; // without absorption: a dielectric's reflectance
    specular.device.k = {0, 0, 0};

    const Reflectance base = readReflectance(properties, "diffuse_reflectance", 0.5f);
    const bool nonlinear = properties.boolean("nonlinear", false);
    if (nonlinear && base.texture != 0)
        throw InputError(
            properties.where("nonlinear"),
            "plastic: the colour shift of nonlinear needs one colour, and diffuse_reflectance is a texture; "
            "give it as <rgb>, or leave nonlinear out.");
    LobeDescription diffuse = makeLobe(LOBE_COATEDLAMBERT, "diffuse", base, lambertHalfWidth);
    const double letIn = 1 - diffuseFresnel(eta);
    const double within =
        1 - letIn / (eta * eta); // sent back by the coat from inside: what is let out is let in / eta^2
    const auto seen = [&](float reflectance) {
        return static_cast<float>(reflectance / (eta * eta * (1 - (nonlinear ? reflectance : 1) * within)));
    };
    Rgb& scale = diffuse.device.reflectance;
    scale = {seen(scale.r), seen(scale.g), seen(scale.b)};
    diffuse.device.eta = {float(eta), float(eta), float(eta)};
    diffuse.device.exponent = static_cast<float>(letIn);
    BsdfLobes lobes;
    lobes.front = {diffuse, specular};
    return lobes;
}

} // namespace quasilux

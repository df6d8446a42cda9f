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

    const CoatedBase base = readCoatedBase(properties);
    const double letIn = 1 - diffuseFresnel(eta);
    LobeDescription diffuse = base.lobe(LOBE_COATEDLAMBERT, eta, 1 - letIn / (eta * eta)); // let out is let in / eta^2
    diffuse.device.eta = {float(eta), float(eta), float(eta)};
    diffuse.device.exponent = static_cast<float>(letIn);
    BsdfLobes lobes;
    lobes.front = {diffuse, specular};
    return lobes;
}

} // namespace quasilux

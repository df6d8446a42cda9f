#include "support/slab_cases.h"
#include "support/shared_features.h"

#include <algorithm>
#include <fmt/format.h>
#include <stdexcept>

namespace quasilux {

namespace {

constexpr double thickness = 3; // of scenes/slab.xml

} // namespace

// By adding and doubling (Hansen & Travis 1974, "Light scattering in planetary atmospheres"; Prahl 1988), with Fresnel
// borders, at 24 and 48 angles: the error is their difference, or 3e-5 of the value. The narrow peak of g = 0.99 takes
// more angles than that; there the values are from a Monte Carlo of their own and the error is its standard error.
// Published: van de Hulst 1980 (as in Wang, Jacques & Zheng 1995) 0.09739 and 0.66096; Giovanelli 1955, infinitely
// deep, 0.2600, which includes the first Fresnel reflection.
const std::vector<Slab>& slabs() {
    static const std::vector<Slab> all{
        {"van de Hulst", 2, 0.9, 0.75, false, false, 0.09739464, 0.66095771, 2.9e-06},
        {"van de Hulst, 45", 2, 0.9, 0.75, false, true, 0.16179796, 0.53141822, 4.9e-06},
        {"Giovanelli", 60, 0.9, 0, true, false, 0.25991936, 0, 7.8e-06},
        {"Giovanelli, 45", 60, 0.9, 0, true, true, 0.27632001, 0, 8.3e-06},
        {"plate glass", 22.5, 1, 0.9, true, false, 0.52645242, 0.47354792, 1.4e-05},
        {"plate glass, 45", 22.5, 1, 0.9, true, true, 0.54526753, 0.45473268, 1.4e-05},
        {"plate open", 22.5, 1, 0.9, false, false, 0.53892346, 0.46107678, 1.4e-05},
        {"plate open, 45", 22.5, 1, 0.9, false, true, 0.62275778, 0.37724232, 1.1e-05},
        {"g -0.9, tau 22.5, glass", 22.5, 1, -0.9, true, false, 0.93882428, 0.06117602, 1.8e-06},
        {"g -0.9, tau 22.5, glass, 45", 22.5, 1, -0.9, true, true, 0.93725212, 0.06274808, 1.9e-06},
        {"g -0.9, tau 22.5, open", 22.5, 1, -0.9, false, false, 0.95837449, 0.04162574, 1.2e-06},
        {"g -0.9, tau 22.5, open, 45", 22.5, 1, -0.9, false, true, 0.96846814, 0.03153196, 9.5e-07},
        {"g 0, tau 22.5, glass", 22.5, 1, 0, true, false, 0.87917958, 0.12082064, 3.6e-06},
        {"g 0, tau 22.5, glass, 45", 22.5, 1, 0, true, true, 0.88430550, 0.11569471, 3.5e-06},
        {"g 0, tau 22.5, open", 22.5, 1, 0, false, false, 0.92981769, 0.07018242, 2.1e-06},
        {"g 0, tau 22.5, open, 45", 22.5, 1, 0, false, true, 0.94239487, 0.05760522, 1.7e-06},
        {"g 0.99, tau 22.5, glass", 22.5, 1, 0.99, true, false, 0.18698600, 0.81301400, 3.2e-04},
        {"g 0.99, tau 22.5, open", 22.5, 1, 0.99, false, false, 0.06028900, 0.93971100, 1.9e-04},
        {"g 0, tau 1, glass", 1, 1, 0, true, false, 0.35894816, 0.64105185, 1.1e-05},
        {"g 0, tau 1, glass, 45", 1, 1, 0, true, true, 0.38948790, 0.61051211, 1.2e-05},
        {"g 0, tau 1, open", 1, 1, 0, false, false, 0.34132876, 0.65867124, 1.0e-05},
        {"g 0, tau 1, open, 45", 1, 1, 0, false, true, 0.42056455, 0.57943546, 1.3e-05},
        {"g 0, tau 0.001, glass", 0.001, 1, 0, true, false, 0.07734892, 0.92265108, 2.3e-06},
        {"g 0, tau 0.001, glass, 45", 0.001, 1, 0, true, true, 0.09613662, 0.90386338, 2.9e-06},
        {"g 0, tau 0.001, open", 0.001, 1, 0, false, false, 0.00049975, 0.99950025, 1.0e-07},
        {"g 0, tau 0.001, open, 45", 0.001, 1, 0, false, true, 0.00070661, 0.99929339, 1.0e-07},
        {"g 0.9, tau 0.001, glass", 0.001, 1, 0.9, true, false, 0.07697085, 0.92302915, 2.3e-06},
        {"g 0.9, tau 0.001, glass, 45", 0.001, 1, 0.9, true, true, 0.09576944, 0.90423056, 2.9e-06},
        {"g 0.9, tau 0.001, open", 0.001, 1, 0.9, false, false, 0.00002291, 0.99997709, 1.0e-07},
        {"g 0.9, tau 0.001, open, 45", 0.001, 1, 0.9, false, true, 0.00004990, 0.99995010, 1.0e-07},
        {"g 0, tau 100, glass", 100, 1, 0, true, false, 0.96870313, 0.03129785, 9.4e-07},
        {"g 0, tau 100, glass, 45", 100, 1, 0, true, true, 0.97003093, 0.02997001, 9.0e-07},
        {"g 0, tau 100, open", 100, 1, 0, false, false, 0.98344728, 0.01655322, 5.0e-07},
        {"g 0, tau 100, open, 45", 100, 1, 0, false, true, 0.98641365, 0.01358677, 4.1e-07},
        {"g 0.9, tau 100, glass", 100, 1, 0.9, true, false, 0.77716609, 0.22283501, 6.7e-06},
        {"g 0.9, tau 100, glass, 45", 100, 1, 0.9, true, true, 0.78595490, 0.21404603, 6.4e-06},
        {"g 0.9, tau 100, open", 100, 1, 0.9, false, false, 0.85156958, 0.14843106, 4.5e-06},
        {"g 0.9, tau 100, open, 45", 100, 1, 0.9, false, true, 0.87857843, 0.12142199, 3.6e-06},
        {"clear", 0, 1, 0, true, false, 0.07692308, 0.92307692, 2.3e-06},
        {"clear, 45", 0, 1, 0, true, true, 0.09567321, 0.90432679, 2.9e-06}};
    return all;
}

const Slab& slab(const std::string& name) {
    const auto found = std::find_if(slabs().begin(), slabs().end(), [&](const Slab& s) { return s.name == name; });
    if (found == slabs().end()) throw std::invalid_argument("no slab " + name);
    return *found;
}

RenderSettings settingsOf(const SlabMethod& method) {
    RenderSettings settings;
    settings.bdd = method.bdd;
    settings.variant = method.variant;
    settings.direct = method.direct;
    settings.quasiSpecular = method.split;
    settings.quasiSpecularOverridesScene = true;
    settings.furtherFeatures = test::mediumFeatures();
    settings.photonsPerPass = 10000;
    settings.radiusScale = 0.3; // light is even across the plate, so a wide kernel would help nothing and cost much
    return settings;
}

MeanAndError measureSlab(const Slab& slab, SlabSide side, const RenderSettings& settings, unsigned batches,
                         unsigned passes, bool wideTube) {
    constexpr unsigned resolution = 32;
    const bool below = side == SlabSide::transmittance;
    const Scene scene = projectScene("slab.xml", {{"sigma_t", fmt::format("{}", slab.opticalDepth / thickness)},
                                                  {"albedo", fmt::format("{}", slab.albedo)},
                                                  {"g", fmt::format("{}", slab.g)},
                                                  {"boundary", slab.glass ? "glass" : "open"},
                                                  {"camera", slab.oblique ? "-0.7,0,0.7" : "0,0,1"},
                                                  {"window", slab.oblique ? "0.5" : "1.2"},
                                                  {"light_z", below ? "-3.5" : "2.4"},
                                                  {"light_tilt", below ? "0" : "180"},
                                                  {"half_width", wideTube ? "15" : "1.25"},
                                                  {"resolution", std::to_string(resolution)}});
    return renderGroups(scene, settings, std::vector<int>(resolution * resolution, 0), batches, passes).front();
}

} // namespace quasilux

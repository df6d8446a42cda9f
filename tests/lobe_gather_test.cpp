// Photons seen by coats, rough conductors and the lobes of `principled`, eight at a time
// (kernels/directional_lobes.clh), against photon by photon: the same photons, so the same image but for rounding.
// Nothing is statistical. The control: an index, or a colour, that is wrong by 2 % is told apart.
#include "render/renderer.h"
#include "support/image_difference.h"
#include "support/placed_scenes.h"
#include "support/test_kernels.h"

#include <fmt/format.h>
#include <functional>
#include <gtest/gtest.h>

namespace quasilux {
namespace {

constexpr double rounding = 1e-4; // relative, of sums of some hundred photons

std::string coat(const std::string& type, double index) {
    return fmt::format(
        R"(<bsdf type="{}"><float name="int_ior" value="{}"/><float name="ext_ior" value="1"/><rgb name="diffuse_reflectance" value="0.6,0.5,0.3"/></bsdf>)",
        type, index);
}

/// With its gloss so wide that photons bring its light too.
std::string satin(double index) {
    return fmt::format(
        R"(<bsdf type="roughplastic"><string name="distribution" value="ggx"/><float name="alpha" value="0.5"/><float name="int_ior" value="{}"/><rgb name="diffuse_reflectance" value="0.6,0.5,0.3"/></bsdf>)",
        index);
}

std::string metal(const std::string& distribution, double index) {
    return fmt::format(
        R"(<bsdf type="roughconductor"><string name="distribution" value="{}"/><float name="alpha_u" value="0.6"/><float name="alpha_v" value="0.4"/><rgb name="eta" value="{},0.9,1.2"/><rgb name="k" value="2,2.5,3"/></bsdf>)",
        distribution, index);
}

std::string thin(double index) {
    return fmt::format(
        R"(<bsdf type="principledthin"><rgb name="base_color" value="{},0.5,0.2"/><float name="roughness" value="0.7"/><float name="flatness" value="0.5"/><float name="diff_trans" value="0.6"/></bsdf>)",
        index / 2);
}

std::string principled(double index) {
    return fmt::format(
        R"(<bsdf type="principled"><rgb name="base_color" value="{},0.5,0.2"/><float name="roughness" value="0.7"/><float name="metallic" value="0.6"/><float name="sheen" value="1"/><float name="clearcoat" value="1"/><float name="clearcoat_gloss" value="0.2"/></bsdf>)",
        index / 2);
}

std::string besideDiffuse(const std::string& bsdf) {
    return R"(<bsdf type="blendbsdf"><float name="weight" value="0.7"/><bsdf type="diffuse"/>)" + bsdf + "</bsdf>";
}

/// Of all blends: one program serves them. Lobes that stand alone are compiled alone.
std::shared_ptr<const Features> blendFeatures() {
    Features some;
    some.lobes = {LOBE_LAMBERT, LOBE_CONDUCTOR, LOBE_GGX, LOBE_BECKMANN, LOBE_COATEDLAMBERT, LOBE_ROUGHCOATEDLAMBERT};
    some.depthLimit = some.anisotropy = some.specular = some.genuineDiffuse = true;
    return std::make_shared<const Features>(some);
}

/// The corner of a floor and a wall, so that light comes from everywhere and discs are cut.
FilmImage render(const std::string& bsdf, int maxDepth, const std::string& options, bool sharesProgram) {
    const Scene scene = placedScene(orthographicSensor("0,0,1.5", "0,0,0", 1, 16) + fmt::format(R"(
<integrator type="path"><integer name="max_depth" value="{0}"/></integrator>
<shape type="rectangle">{1}</shape>
<shape type="rectangle"><transform name="to_world"><rotate y="1" angle="90"/><translate x="-0.5"/></transform>{1}</shape>
<emitter type="point"><rgb name="intensity" value="10"/><transform name="to_world"><translate x="0.4" z="0.6"/></transform></emitter>)",
                                                                                                maxDepth, bsdf),
                                    Placement{});
    RenderSettings settings;
    settings.direct = DirectLight::photons;
    settings.photonsPerPass = 20'000;
    settings.quasiSpecular = "none";
    settings.controlOptions = options;
    if (sharesProgram) settings.furtherFeatures = blendFeatures();
    Renderer renderer(testDevice(), scene, settings);
    for (unsigned pass = 0; pass < 2; ++pass) renderer.renderPass(pass);
    return renderer.develop();
}

struct Kind {
    const char* name;
    std::function<std::string(double index)> bsdf;
    bool isBlended;
    int maxDepth;
    bool isThin = false; ///< lets light through
};

void PrintTo(const Kind& kind, std::ostream* stream) { *stream << kind.name; }

class Lobes : public testing::TestWithParam<Kind> {};
TEST_P(Lobes, GatherByEightsAsOneByOne) {
    const Kind& kind = GetParam();
    const auto imageOf = [&](double index, const std::string& options) {
        const std::string bsdf = kind.isBlended ? besideDiffuse(kind.bsdf(index)) : kind.bsdf(index);
        return render(kind.isThin ? bsdf : "<bsdf type=\"twosided\">" + bsdf + "</bsdf>", kind.maxDepth, options,
                      kind.isBlended);
    };
    const FilmImage eight = imageOf(1.5, ""), one = imageOf(1.5, " -DLOBES_ONE_BY_ONE");
    EXPECT_LT(largestDifference(eight.radiance, one.radiance), rounding);
    EXPECT_NE(eight.radiance, one.radiance) << "both are the same code";
    double bias = 0, apart = 0;
    for (size_t k = 0; k < one.bias.size(); ++k) {
        bias += std::abs(one.bias[k]);
        apart += std::abs(double(eight.bias[k]) - one.bias[k]);
    }
    EXPECT_GT(bias, 0);
    EXPECT_LT(apart, rounding * bias);
    EXPECT_GT(largestDifference(imageOf(1.53, "").radiance, one.radiance), 10 * rounding)
        << "nothing would be told apart";
}

Kind coated(const char* name, const char* type, bool isBlended, int maxDepth) {
    return {name, [type](double index) { return coat(type, index); }, isBlended, maxDepth};
}
INSTANTIATE_TEST_SUITE_P(
    Kinds, Lobes,
    testing::Values(coated("Plastic", "plastic", false, -1), coated("RoughPlasticBlend", "roughplastic", true, -1),
                    coated("PlasticBlendToDepth", "plastic", true, 3),
                    coated("RoughPlasticToDepth", "roughplastic", false, 3), Kind{"Satin", satin, true, -1},
                    Kind{"LowRoughPlastic", [](double index) { return coat("roughplastic", 1 / index); }, false, -1},
                    Kind{"Ggx", [](double index) { return metal("ggx", index); }, false, -1},
                    Kind{"Beckmann", [](double index) { return metal("beckmann", index); }, true, 3},
                    Kind{"Principled", principled, false, -1}, Kind{"Thin", thin, false, -1, true}),
    [](const auto& kind) { return std::string(kind.param.name); });

} // namespace
} // namespace quasilux

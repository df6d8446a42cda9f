// Roughness and the parameters of `principled` by texture: the levels that lobes are made for, what weighs them, and
// images whose halves are those of constants. Differences of
// means are held to 4 standard errors of 10 batches (Student t: 0.3 % each) plus 0.5 %. Seeds are fixed.
#include "prepare/device_scene.h"
#include "support/render_statistics.h"
#include "support/scene_files.h"
#include "support/textured_emitters.h"

#include <cmath>
#include <functional>
#include <gmock/gmock.h>

namespace quasilux {
namespace {

using testing::HasSubstr;

DeviceScene flattened(const Scene& scene) { return flattenScene(scene, {"auto", 1000, false}); }

template <typename T>
const T* tableAt(const DeviceScene& scene, unsigned offset) {
    return reinterpret_cast<const T*>(scene.tables.data() + offset);
}

Scene withBsdf(const std::string& bsdf) {
    test::SceneFiles files;
    std::vector<float> ramp;
    for (int k = 0; k < 100; ++k) ramp.insert(ramp.end(), 3, 0.01f + 0.007f * float(k));
    writeFloats(files.path("ramp.exr"), 100, 1, ramp);
    return loadScene(files.write("scene.xml", test::sceneWith("<shape type=\"rectangle\">" + bsdf + "</shape>")));
}

const std::string ramp = R"(<texture type="bitmap" name="NAME"><string name="filename" value="ramp.exr"/></texture>)";
std::string rampAs(const std::string& name) {
    std::string text = ramp;
    return text.replace(text.find("NAME"), 4, name);
}

/// The alphas of the lobe that a texture's value leads to, as kernels/surface.clh looks it up.
std::pair<float, float> alphasAt(const DeviceScene& scene, double u, double v) {
    const auto& material = *tableAt<shared::Material>(scene, scene.offsets.materials);
    const auto& levels = tableAt<shared::RoughnessLevels>(scene, scene.offsets.roughness)[material.frontRoughness - 1];
    const auto level = [](double alpha, float least, float perUnit, unsigned count) {
        return std::min(unsigned(std::max((std::pow(alpha, 0.25) - double(least)) * double(perUnit) + 0.5, 0.0)),
                        count - 1);
    };
    const auto axis = [&](double alpha, size_t i) {
        return level(alpha, levels.least[i], levels.levelsPerUnit[i], levels.levels[i]);
    };
    const unsigned k = axis(u, 0) * levels.levels[1] + (levels.texture[1] > 0 ? axis(v, 1) : 0);
    const auto& lobe = tableAt<shared::Lobe>(scene, scene.offsets.lobes)[material.frontFirst + k];
    return {lobe.alphaU, lobe.alphaV};
}

TEST(AlphaTexture, HasALobeNearEachValue) {
    const DeviceScene one = flattened(withBsdf("<bsdf type=\"roughconductor\">" + rampAs("alpha") + "</bsdf>"));
    EXPECT_TRUE(one.features.alphaTextures);
    for (double alpha = 0.01; alpha < 0.703; alpha += 0.0013) {
        const auto [u, v] = alphasAt(one, alpha, alpha);
        EXPECT_EQ(u, v);
        EXPECT_NEAR(u, alpha, 0.006 * alpha);
    }
    const DeviceScene two = flattened(
        withBsdf("<bsdf type=\"roughconductor\">" + rampAs("alpha_u") +
                 "<texture type=\"checkerboard\" name=\"alpha_v\"><float name=\"color0\" value=\"0.05\"/><float "
                 "name=\"color1\" value=\"0.6\"/></texture></bsdf>"));
    for (double alpha = 0.01; alpha < 0.703; alpha += 0.05)
        for (const double beta : {0.05, 0.6}) {
            const auto [u, v] = alphasAt(two, alpha, beta);
            EXPECT_NEAR(u, alpha, 0.024 * alpha);
            EXPECT_NEAR(v, beta, 1e-5) << "the ends of the range are levels";
        }
    const DeviceScene alongV = flattened(withBsdf(
        "<bsdf type=\"roughconductor\"><float name=\"alpha_u\" value=\"0.3\"/>" + rampAs("alpha_v") + "</bsdf>"));
    EXPECT_FLOAT_EQ(alphasAt(alongV, 0.1, 0).first, 0.3f);
    EXPECT_NEAR(alphasAt(alongV, 0.1, 0).second, 0.1, 0.0006);
}

TEST(AlphaTexture, IsOnBothSidesOfADielectricAndInBlends) {
    const DeviceScene glass = flattened(withBsdf("<bsdf type=\"roughdielectric\">" + rampAs("alpha") + "</bsdf>"));
    const auto& material = *tableAt<shared::Material>(glass, glass.offsets.materials);
    EXPECT_EQ(material.frontRoughness, 1u);
    EXPECT_EQ(material.backRoughness, 2u);
    const DeviceScene blend = flattened(
        withBsdf("<bsdf type=\"blendbsdf\"><float name=\"weight\" value=\"0.5\"/><bsdf type=\"diffuse\"/><bsdf "
                 "type=\"roughconductor\">" +
                 rampAs("alpha") + "</bsdf></bsdf>"));
    const auto& mixed = *tableAt<shared::Material>(blend, blend.offsets.materials);
    EXPECT_EQ(mixed.frontCount, 2u);
    const auto* lobes = tableAt<shared::Lobe>(blend, blend.offsets.lobes) + mixed.frontFirst;
    for (unsigned level = 0; level < 1024; ++level) {
        EXPECT_EQ(lobes[2 * level].type, unsigned(LOBE_LAMBERT));
        EXPECT_EQ(lobes[2 * level + 1].type, unsigned(LOBE_BECKMANN));
        if (level > 0) {
            EXPECT_GT(lobes[2 * level + 1].alphaU, lobes[2 * level - 1].alphaU);
        }
    }
}

TEST(AlphaTexture, SaysWhatIsWrong) {
    test::SceneFiles files;
    const std::string checkers = "<texture type=\"checkerboard\" name=\"alpha\"/>";
    const auto messageOf = [&](const std::string& bsdf) {
        const std::string file =
            files.write("scene.xml", test::sceneWith("<shape type=\"rectangle\">\n" + bsdf + "</shape>"));
        try {
            flattened(loadScene(file));
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string("loaded");
    };
    EXPECT_THAT(messageOf("<bsdf type=\"roughplastic\">\n" + checkers + "</bsdf>"),
                HasSubstr("scene.xml:6:1: bsdf 'roughplastic' takes no texture as 'alpha'"));
    EXPECT_THAT(
        messageOf("<bsdf type=\"roughconductor\"><float name=\"alpha_u\" value=\"0.1\"/>" + checkers + "</bsdf>"),
        HasSubstr("either alpha, or both alpha_u and alpha_v"));
    const std::string rough = "<bsdf type=\"roughconductor\">" + checkers + "</bsdf>";
    const auto blended = [](const std::string& first, const std::string& second) {
        return "<bsdf type=\"blendbsdf\"><float name=\"weight\" value=\"0.5\"/>" + first + second + "</bsdf>";
    };
    EXPECT_EQ(messageOf(blended(rough, rough)), "loaded");
    EXPECT_THAT(messageOf(blended(blended(rough, rough), blended(rough, rough))),
                HasSubstr("scene.xml:5:1: the roughness of this bsdf's parts goes by 4 different textures"));
}

/// A floor of this bsdf under a lamp, from where the lamp is mirrored.
Scene floorUnderLamp(const std::string& bsdf) {
    test::SceneFiles files;
    writeFloats(files.path("halves.exr"), 2, 1, {0.06f, 0.06f, 0.06f, 0.35f, 0.35f, 0.35f});
    return loadScene(files.write(
        "scene.xml",
        R"(<scene version="3.0.0"><integrator type="path"/><sensor type="perspective"><float name="fov" value="30"/><transform name="to_world">
        <lookat origin="0,-3,2" target="0,0,0" up="0,0,1"/></transform><film type="hdrfilm"><rfilter type="box"/>
        <integer name="width" value="16"/><integer name="height" value="16"/></film></sensor><shape type="rectangle"><transform name="to_world">
        <scale value="2"/></transform>)" +
            bsdf + R"(</shape>
        <shape type="rectangle"><transform name="to_world"><scale x="1" y="0.4"/><rotate x="1" angle="120"/><translate y="3" z="2"/></transform>
        <emitter type="area"/></shape></scene>)"));
}

/// Left and right half of the image, without a margin between.
std::vector<MeanAndError> halves(const Scene& scene, const std::shared_ptr<const Features>& furtherFeatures) {
    std::vector<int> group(256, -1);
    for (int k = 0; k < 256; ++k)
        if (k % 16 < 6 || k % 16 >= 10) group[size_t(k)] = k % 16 < 8 ? 0 : 1;
    RenderSettings settings;
    settings.photonsPerPass = 8000;
    settings.furtherFeatures = furtherFeatures;
    return renderGroups(scene, settings, group, 10, 3);
}

/// A parameter, by the texture of halves or as a number.
std::string byHalves(const std::string& name) {
    return "<texture type=\"bitmap\" name=\"" + name +
           R"("><string name="filename" value="halves.exr"/><string name="filter_type" value="nearest"/></texture>)";
}
std::string number(const std::string& name, double value) {
    return "<float name=\"" + name + "\" value=\"" + std::to_string(value) + "\"/>";
}

/// `bsdf` is given each parameter by name.
void expectHalvesOfConstants(const std::function<std::string(std::function<std::string(const std::string&)>)>& bsdf) {
    const auto constant = [](double value) { return [value](const std::string& name) { return number(name, value); }; };
    const Scene ofHalves = floorUnderLamp(bsdf(byHalves));
    const auto features = std::make_shared<const Features>(flattened(ofHalves).features); // one program for all three
    const auto ofConstant = [&](double value) { return halves(floorUnderLamp(bsdf(constant(value))), features); };
    const auto both = halves(ofHalves, features), left = ofConstant(0.06), right = ofConstant(0.35);
    const auto differ = [](const MeanAndError& a, const MeanAndError& b) {
        return std::abs(a.mean - b.mean) > 4 * std::hypot(a.standardError, b.standardError) + 0.005 * b.mean;
    };
    EXPECT_FALSE(differ(both[0], left[0])) << both[0].mean << " " << left[0].mean;
    EXPECT_FALSE(differ(both[1], right[1])) << both[1].mean << " " << right[1].mean;
    EXPECT_TRUE(differ(both[0], right[0])) << "negative control";
    EXPECT_TRUE(differ(both[1], left[1])) << "negative control";
}

TEST(AlphaTexture, HalvesOfAnImageAreThoseOfConstantAlphas) {
    expectHalvesOfConstants([](const auto& parameter) {
        return R"(<bsdf type="roughconductor"><string name="distribution" value="ggx"/>)" + parameter("alpha") +
               "</bsdf>";
    });
}

/// Radiance that GGX facets of reflectance 1 send along the normal, in sunlight from 60 degrees, 1 across its direction
/// (Walter et al. 2007, eq. 20, 33 and 34).
double mirroredSun(double alphaAcross, double alphaInPlane) {
    const double pi = std::acos(-1), tangent = 1 / std::sqrt(3), cosine = std::sqrt(0.75);
    const double d = 1 / (pi * alphaAcross * alphaInPlane * std::pow(cosine, 4) *
                          std::pow(1 + std::pow(tangent / alphaInPlane, 2), 2));
    const double masking = 2 / (1 + std::sqrt(1 + 3 * alphaInPlane * alphaInPlane));
    return d * masking / 4;
}

// One alpha by a texture whose mean is the other alpha, on a sheet that is turned by 90 degrees: its u is the sun's
// plane.
TEST(AlphaTexture, TellsTheAxesApartWhereItsMeanDoesNot) {
    test::SceneFiles files;
    const Scene scene = loadScene(files.write("scene.xml", R"(<scene version="3.0.0"><sensor type="orthographic">
        <transform name="to_world"><lookat origin="0,0,5" target="0,0,0" up="0,1,0"/></transform><film type="hdrfilm">
        <rfilter type="box"/><integer name="width" value="2"/><integer name="height" value="2"/></film></sensor>
        <shape type="rectangle"><transform name="to_world"><rotate z="1" angle="90"/></transform><bsdf type="roughconductor">
        <string name="material" value="none"/><string name="distribution" value="ggx"/><texture type="checkerboard"
        name="alpha_u"><float name="color0" value="0.25"/><float name="color1" value="0.75"/></texture>
        <float name="alpha_v" value="0.5"/></bsdf></shape><emitter type="directional"><vector name="direction" x="0"
        y="-0.8660254" z="-0.5"/><rgb name="irradiance" value="1"/></emitter></scene>)"));
    RenderSettings settings;
    settings.photonsPerPass = 1000;
    std::vector<double> found;
    for (const MeanAndError& square : renderGroups(scene, settings, {0, 1, 2, 3}, 2, 1)) found.push_back(square.mean);
    std::sort(found.begin(), found.end());
    const double narrow = mirroredSun(0.5, 0.25), wide = mirroredSun(0.5, 0.75);
    EXPECT_THAT(found, testing::ElementsAre(
                           testing::DoubleNear(narrow, 0.005 * narrow), testing::DoubleNear(narrow, 0.005 * narrow),
                           testing::DoubleNear(wide, 0.005 * wide), testing::DoubleNear(wide, 0.005 * wide)));
    EXPECT_GT(mirroredSun(0.25, 0.5), 6 * narrow) << "control: the axes changed";
}

TEST(PrincipledTextures, HalvesOfAnImageAreThoseOfConstants) {
    expectHalvesOfConstants([](const auto& parameter) {
        return R"(<bsdf type="principled"><rgb name="base_color" value="0.8,0.4,0.1"/>)" + parameter("metallic") +
               parameter("spec_tint") + parameter("sheen") + parameter("flatness") + parameter("clearcoat") +
               number("sheen_tint", 0.5) + number("roughness", 0.4) + "</bsdf>";
    });
    expectHalvesOfConstants([](const auto& parameter) {
        return R"(<bsdf type="principled">)" + parameter("base_color") + number("metallic", 0.8) +
               parameter("roughness") + parameter("anisotropic") + number("clearcoat", 1) +
               parameter("clearcoat_gloss") + "</bsdf>";
    });
    expectHalvesOfConstants([](const auto& parameter) {
        return R"(<bsdf type="principledthin"><rgb name="base_color" value="0.8,0.4,0.1"/>)" + parameter("spec_trans") +
               parameter("diff_trans") + parameter("spec_tint") + parameter("sheen") + number("roughness", 0.5) +
               "</bsdf>";
    });
}

TEST(PrincipledTextures, LobesAreWeighedByTheirParts) {
    const Scene scene = withBsdf("<bsdf type=\"principled\">" + rampAs("base_color") + rampAs("metallic") +
                                 rampAs("spec_trans") + "</bsdf>");
    const Bsdf& bsdf = scene.bsdfs.at(0);
    ASSERT_EQ(bsdf.front.size(), 4u);
    const auto& diffuse = bsdf.front[0].weights;
    ASSERT_EQ(diffuse.size(), 2u);
    for (const auto& weight : diffuse) EXPECT_EQ(weight.factor, -1) << "1 less metallic, and spec_trans";
    EXPECT_EQ(bsdf.front[1].device.type, unsigned(LOBE_GGXDIELECTRIC));
    const auto& border = bsdf.front[1].weights;
    ASSERT_EQ(border.size(), 4u);
    EXPECT_EQ(border[0].parts, WEIGHS_REFLECTED);
    for (size_t k = 1; k < 4; ++k) EXPECT_EQ(border[k].parts, WEIGHS_TRANSMITTED);
    EXPECT_EQ(border[3].function, WEIGHT_ROOT);
    EXPECT_EQ(bsdf.front[2].device.reflectanceTexture, bsdf.front[0].device.reflectanceTexture) << "metal";
    EXPECT_EQ(bsdf.front[3].device.reflectanceTexture, 0u) << "metal at grazing incidence is white";
    ASSERT_EQ(bsdf.back.size(), 1u);
    EXPECT_EQ(bsdf.back[0].weights.size(), 3u);
}

} // namespace
} // namespace quasilux

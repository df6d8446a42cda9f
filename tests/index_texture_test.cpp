// eta and k of metals, and eta of thin sheets, by texture: how they are read, images whose halves are those of
// constants, and the estimate of a room where textures are the same everywhere, which is that of constants. Renders of
// the same seed take the same random numbers: they differ by rounding, and by some paths that part by it.
#include "prepare/device_scene.h"
#include "prepare/roughness_levels.h"
#include "support/render_statistics.h"
#include "support/scene_files.h"
#include "support/test_kernels.h"
#include "support/textured_emitters.h"
#include "support/wrong_rules.h"

#include <cmath>
#include <functional>

namespace quasilux {
namespace {

using test::SurfaceRule;
using testing::HasSubstr;

std::string rgb(const std::string& name, const std::string& value) {
    return "<rgb name=\"" + name + "\" value=\"" + value + "\"/>";
}
std::string bitmap(const std::string& name, const std::string& file) {
    return "<texture type=\"bitmap\" name=\"" + name + R"("><string name="filename" value=")" + file +
           R"("/><string name="filter_type" value="nearest"/></texture>)";
}

/// The first texture of the only lobe: of eta.
TextureDescription etaTexture(const Scene& scene) {
    return scene.textures.at(scene.bsdfs.at(0).front.at(0).device.etaTexture - 1);
}

TEST(IndexTexture, MayExceedOne) {
    const test::SceneFiles files;
    writeSixPixels(files.path("six.exr"));
    files.write("a.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float "
                         "z\nproperty float n_x\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
                         "0 0 0 3\n1 0 0 4\n0 1 0 5\n3 0 1 2\n");
    const auto load = [&](const std::string& texture, const std::string& shape = "type=\"rectangle\">") {
        return loadScene(files.write("scene.xml", test::sceneWith("<shape " + shape + "<bsdf type=\"conductor\">" +
                                                                  texture + "</bsdf></shape>")));
    };
    const Scene image = load(bitmap("eta", "six.exr") + bitmap("specular_reflectance", "six.exr"));
    EXPECT_EQ(etaTexture(image).texels.at(0).b, 2);
    EXPECT_EQ(image.textures.at(image.bsdfs.at(0).front.at(0).device.reflectanceTexture - 1).texels.at(0).b, 1)
        << "as a reflectance";
    ASSERT_EQ(image.warnings.size(), 1u);
    EXPECT_THAT(image.warnings[0], HasSubstr("above 1 and are taken as 1"));
    const Scene nested = load(R"(<texture type="checkerboard" name="eta"><float name="color0" value="3"/>)" +
                              bitmap("color1", "six.exr") + "</texture>");
    EXPECT_EQ(etaTexture(nested).device.color0.g, 3);
    EXPECT_EQ(nested.textures.at(etaTexture(nested).device.texture1 - 1).texels.at(0).b, 2);
    const Scene volume = load(R"(<texture type="volume" name="eta"><volume type="constvolume" name="volume">)" +
                              rgb("value", "3,2,1") + "</volume></texture>");
    EXPECT_EQ(etaTexture(volume).volume->values.at(0), 3);
    const Scene mesh =
        load(R"(<texture type="mesh_attribute" name="eta"><string name="name" value="vertex_n"/></texture>)",
             R"(type="ply"><string name="filename" value="a.ply"/>)");
    const DeviceScene flat = flattenScene(mesh, {"auto", 1000, false});
    EXPECT_TRUE(flat.features.indexTextures);
    EXPECT_TRUE(mesh.warnings.empty());
    const auto* words = reinterpret_cast<const float*>(flat.tables.data() + flat.offsets.attributes);
    const std::vector<float> shown(words + 1, words + 10);
    EXPECT_EQ(shown, (std::vector<float>{3, 3, 3, 4, 4, 4, 5, 5, 5}));
}

TEST(IndexTexture, IsEtaOrKOrBoth) {
    const auto lobe = [](const std::string& parameters) {
        return test::loadBody("<shape type=\"rectangle\"><bsdf type=\"roughconductor\">" + parameters +
                              "</bsdf></shape>")
            .bsdfs.at(0)
            .front.at(0)
            .device;
    };
    const std::string ofK = "<texture type=\"checkerboard\" name=\"k\"/>";
    const auto k = lobe(ofK + rgb("eta", "0.2,0,3"));
    EXPECT_EQ(k.etaTexture, 0u);
    EXPECT_EQ(k.kTexture, 1u);
    EXPECT_EQ(k.eta.b, 3);
    const auto both = lobe(ofK + "<texture type=\"checkerboard\" name=\"eta\"/>");
    EXPECT_EQ(both.etaTexture, 1u);
    EXPECT_EQ(both.kTexture, 2u);
    const auto constant = lobe(R"(<texture type="rawconstant" name="eta"><float name="value" value="2"/></texture>)");
    EXPECT_EQ(constant.etaTexture, 0u);
    EXPECT_EQ(constant.eta.r, 2);
}

TEST(IndexTexture, SaysWhatIsWrong) {
    const test::SceneFiles files;
    const std::string negative = "<texture type=\"checkerboard\" name=\"eta\">\n" + rgb("color0", "1,-1,1");
    const std::pair<std::string, std::vector<std::string>> cases[] = {
        {"<texture type=\"checkerboard\" name=\"k\"/>\n<string name=\"material\" value=\"Cu\"/>",
         {"scene.xml:5:1: bsdf 'conductor' has both material and eta or k"}},
        {"<texture type=\"checkerboard\" name=\"k\"/>\n<float name=\"k\" value=\"1\"/>", {"scene.xml:", "'k'"}},
        {negative + "</texture>", {"scene.xml:5:1: parameter 'color0'", "no channel may be negative"}},
        {"\n<texture type=\"checkerboard\" name=\"ETA\"/>",
         {"scene.xml:5:1: bsdf 'conductor' takes no texture as 'ETA'", "eta", "k", "specular_reflectance"}},
    };
    expectErrors(files, cases, [](const std::string& parameters) {
        return "<shape type=\"rectangle\"><bsdf type=\"conductor\">" + parameters + "</bsdf></shape>";
    });
}

const std::string sheet = "<bsdf type=\"principledthin\"><float name=\"roughness\" value=\"0.6\"/>"
                          "<float name=\"spec_trans\" value=\"1\"/>";

TEST(IndexTexture, OfSheetsIsReadAsNumbers) {
    const auto front = [](const std::string& parameters) {
        return test::loadBody("<shape type=\"rectangle\">" + sheet + parameters + "</bsdf></shape>").bsdfs.at(0).front;
    };
    const auto plain = front("<texture type=\"checkerboard\" name=\"eta\"/>");
    ASSERT_EQ(plain.size(), 2u);
    EXPECT_EQ(plain[0].device.type, unsigned(LOBE_GGX));
    EXPECT_EQ(plain[0].device.etaTexture, 2u) << "a grey copy";
    EXPECT_TRUE(plain[0].levelTextures.empty()) << "the alpha of what is reflected is the same everywhere";
    EXPECT_EQ(plain[1].device.type, unsigned(LOBE_THINGGX));
    EXPECT_EQ(plain[1].levelTextures.size(), 1u);
    const auto tinted = front("<float name=\"spec_tint\" value=\"1\"/><texture type=\"checkerboard\" name=\"eta\"/>");
    ASSERT_EQ(tinted.size(), 3u);
    EXPECT_EQ(tinted[0].weights.at(0).function, WEIGHT_NORMALREFLECTANCE);
    EXPECT_TRUE(tinted[1].weights.empty());
    const auto constant = front(R"(<texture type="rawconstant" name="eta"><float name="value" value="2"/></texture>)");
    EXPECT_EQ(constant[0].device.etaTexture, 0u);
    EXPECT_EQ(constant[1].device.eta.r, 2);
    EXPECT_THAT(test::errorOf(test::SceneFiles().write(
                    "scene.xml", test::sceneWith("<shape type=\"rectangle\"><bsdf type=\"principled\">"
                                                 "<texture type=\"checkerboard\" name=\"eta\"/></bsdf></shape>"))),
                HasSubstr("bsdf 'principled' takes no texture as 'eta'"));
}

// Levels lie between the values that the mesh has, 3 and 5, which are above any roughness.
TEST(IndexTexture, OfSheetsNarrowsWhatPasses) {
    const test::SceneFiles files;
    files.write("a.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float "
                         "z\nproperty float n_x\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
                         "0 0 0 3\n1 0 0 4\n0 1 0 5\n3 0 1 2\n");
    const Scene scene = loadScene(files.write(
        "scene.xml",
        test::sceneWith("<shape type=\"ply\"><string name=\"filename\" value=\"a.ply\"/>" + sheet +
                        "<texture type=\"mesh_attribute\" name=\"eta\"><string name=\"name\" value=\"vertex_n\"/>"
                        "</texture></bsdf></shape>")));
    const auto& side = scene.bsdfs.at(0).front;
    const auto levels = roughnessLevels(scene, scene.bsdfs.at(0), side);
    ASSERT_TRUE(levels && levels->count() > 1);
    for (const bool last : {false, true}) {
        const double index = last ? 5 : 3;
        const auto lobe = levels->lobeAt(last ? levels->count() - 1 : 0, side.back().device, side.back());
        EXPECT_NEAR(lobe.eta.r, index, 1e-5 * index);
        EXPECT_NEAR(lobe.alphaU, std::pow(0.6 * (0.65 * index - 0.35), 2), 1e-4);
        EXPECT_EQ(lobe.alphaU, lobe.alphaV);
    }
    EXPECT_FALSE(scene.bsdfs.at(0).isAnisotropic());
}

using Parameter = std::function<std::string(const std::string& name, const std::string& value)>;

const Features& featuresOfAll();

std::vector<float> radianceOf(const Scene& scene, DirectLight direct, uint64_t seed, SurfaceRule rule) {
    RenderSettings settings;
    settings.direct = direct;
    settings.photonsPerPass = 20'000;
    settings.seed = seed;
    settings.controlOptions = optionOf(rule);
    settings.furtherFeatures = std::make_shared<const Features>(featuresOfAll());
    Renderer renderer(testDevice(), scene, settings);
    for (unsigned pass = 0; pass < 4; ++pass) renderer.renderPass(pass);
    return renderer.develop().radiance;
}

DeviceScene flattened(const Scene& scene) { return flattenScene(scene, {"auto", 1000, false}); }

constexpr size_t side = 24;

std::string camera(const std::string& look, int depth) {
    return R"(<scene version="3.0.0"><integrator type="path"><integer name="max_depth" value=")" +
           std::to_string(depth) + R"("/></integrator><sensor type="perspective"><float name="fov" value="40"/>
<transform name="to_world"><lookat )" +
           look +
           R"( up="0,0,1"/></transform><film type="hdrfilm"><rfilter type="box"/><integer name="width" value="24"/>
<integer name="height" value="24"/></film></sensor>)";
}

/// A floor between two lamps, from where one is mirrored and the other, where the floor passes light, is seen.
Scene floorByLamps(const std::string& bsdf) {
    const test::SceneFiles files;
    writeFloats(files.path("eta.exr"), 2, 1, {0.2f, 0.9f, 1.5f, 2.5f, 1, 0});
    writeFloats(files.path("k.exr"), 2, 1, {3.9f, 2.4f, 0, 0.1f, 1, 0});
    writeFloats(files.path("sheet.exr"), 2, 1, {1.3f, 1.3f, 1.3f, 2.2f, 2.2f, 2.2f});
    return loadScene(files.write(
        "scene.xml",
        camera(R"(origin="0,-3,1" target="0,0,0")", 2) +
            R"(<shape type="rectangle"><transform name="to_world"><scale value="2"/></transform>)" + bsdf +
            R"(</shape><shape type="rectangle"><transform name="to_world"><scale x="2" y="0.7"/><rotate x="1" angle="110"/>
<translate y="3" z="1"/></transform><emitter type="area"/></shape><shape type="rectangle"><transform name="to_world">
<scale x="2" y="0.7"/><rotate x="1" angle="70"/><translate y="3" z="-1"/></transform><emitter type="area"/></shape></scene>)"));
}

/// Largest difference of a pixel relative to the mean of them, over columns from `first` on.
double largestDifference(const std::vector<float>& a, const std::vector<float>& b, size_t first, size_t columns) {
    double largest = 0, sum = 0;
    for (size_t y = 0; y < side; ++y)
        for (size_t k = 3 * (y * side + first); k < 3 * (y * side + first + columns); ++k) {
            largest = std::max(largest, std::abs(a.at(k) - double(b.at(k))));
            sum += b.at(k);
        }
    return largest / (sum / double(3 * side * columns));
}

const std::vector<std::string> metals{
    R"(<bsdf type="conductor">)",
    R"(<bsdf type="roughconductor"><string name="distribution" value="ggx"/><float name="alpha" value="0.3"/>)",
    R"(<bsdf type="roughconductor"><float name="alpha" value="0.4"/>)"};
// A tint is apart from what is white where a texture says the index; so it is where one says the base colour.
const std::vector<std::string> sheets{
    sheet + rgb("base_color", "0.9,0.7,0.4"),
    sheet + "<float name=\"spec_tint\" value=\"0.5\"/><texture type=\"checkerboard\" name=\"base_color\">" +
        rgb("color0", "0.9,0.7,0.4") + rgb("color1", "0.9,0.7,0.4") +
        "</texture><texture type=\"checkerboard\" name=\"anisotropic\"/>"};

/// The floor whose halves differ: its bsdf begins with `bsdf`.
Scene floorOfHalves(const std::string& bsdf) {
    const bool isMetal = std::find(metals.begin(), metals.end(), bsdf) != metals.end();
    return floorByLamps(
        bsdf + (isMetal ? bitmap("eta", "eta.exr") + bitmap("k", "k.exr") : bitmap("eta", "sheet.exr")) + "</bsdf>");
}

Scene texturedRoom();

/// Of all scenes, so that one program serves them: what takes the time is to compile it.
const Features& featuresOfAll() {
    static const Features features = [] {
        Features all = flattened(texturedRoom()).features;
        for (const auto& bsdfs : {metals, sheets})
            for (const std::string& bsdf : bsdfs) all = all.with(flattened(floorOfHalves(bsdf)).features);
        return all;
    }();
    return features;
}

class IndexTextureHalves : public testing::TestWithParam<std::string> {};
TEST_P(IndexTextureHalves, AreThoseOfConstants) {
    const auto floor = [](const std::string& index) { return floorByLamps(GetParam() + index + "</bsdf>"); };
    const Scene textured = floorOfHalves(GetParam());
    EXPECT_TRUE(flattened(textured).features.indexTextures);
    for (const auto direct : {DirectLight::emitters, DirectLight::photons}) {
        const auto of = [&](const Scene& scene, SurfaceRule rule = SurfaceRule::right) {
            return radianceOf(scene, direct, 1, rule);
        };
        const auto left = of(floor(rgb("eta", "0.2,0.9,1.5") + rgb("k", "3.9,2.4,0"))),
                   right = of(floor(rgb("eta", "2.5,1,0") + rgb("k", "0.1,1,0"))), both = of(textured);
        EXPECT_LT(largestDifference(both, left, 0, 9), 1e-4);
        EXPECT_LT(largestDifference(both, right, 15, 9), 1e-4);
        EXPECT_GT(largestDifference(both, right, 0, 9), 0.1) << "negative control";
        EXPECT_GT(largestDifference(of(textured, SurfaceRule::etaIsK), left, 0, 9), 0.1) << "negative control";
    }
}
INSTANTIATE_TEST_SUITE_P(IndexTexture, IndexTextureHalves, testing::ValuesIn(metals));

class SheetTextureHalves : public testing::TestWithParam<std::string> {};
TEST_P(SheetTextureHalves, AreThoseOfConstants) {
    const auto floor = [](const std::string& index) { return floorByLamps(GetParam() + index + "</bsdf>"); };
    const Scene textured = floorOfHalves(GetParam());
    EXPECT_TRUE(flattened(textured).features.indexTextures);
    const bool isTinted = GetParam().find("spec_tint") != std::string::npos;
    for (const auto direct : {DirectLight::emitters, DirectLight::photons}) {
        const auto of = [&](const Scene& scene, SurfaceRule rule = SurfaceRule::right) {
            return radianceOf(scene, direct, 1, rule);
        };
        const auto left = of(floor("<float name=\"eta\" value=\"1.3\"/>")),
                   right = of(floor("<float name=\"eta\" value=\"2.2\"/>")), both = of(textured);
        EXPECT_LT(largestDifference(both, left, 0, 9), 1e-4);
        EXPECT_LT(largestDifference(both, right, 15, 9), 1e-4);
        EXPECT_GT(largestDifference(both, right, 0, 9), 0.1) << "negative control";
        // One each.
        if (isTinted)
            EXPECT_GT(largestDifference(of(textured, SurfaceRule::etaIsK), left, 0, 9), 0.1) << "negative control";
        else
            EXPECT_GT(largestDifference(of(textured, SurfaceRule::firstLevel), right, 15, 9), 0.1)
                << "negative control";
    }
}
INSTANTIATE_TEST_SUITE_P(IndexTexture, SheetTextureHalves, testing::ValuesIn(sheets));

/// Metals of every kind, and a sheet, in a room, where light goes from one to the other.
Scene room(const Parameter& parameter) {
    const test::SceneFiles files;
    const auto bsdf = [&](const std::string& type, const std::string& eta, const std::string& k) {
        return "<bsdf type=\"twosided\"><bsdf type=" + type + parameter("eta", eta) + parameter("k", k) +
               "</bsdf></bsdf>";
    };
    const auto wall = [](const std::string& place, const std::string& of) {
        return "<shape type=\"rectangle\"><transform name=\"to_world\">" + place + "</transform>" + of + "</shape>";
    };
    const std::string white = "<bsdf type=\"twosided\"><bsdf type=\"diffuse\"/></bsdf>";
    return loadScene(files.write(
        "scene.xml",
        camera(R"(origin="0,-3,0.5" target="0,0,0.3")", -1) +
            wall(R"(<scale value="4"/>)",
                 bsdf(R"("roughconductor"><string name="distribution" value="ggx"/><float name="alpha" value="0.4"/>)",
                      "1.5,1.2,0.2", "0,0.1,3.9")) +
            wall(R"(<scale value="4"/><translate z="2.5"/>)", white) +
            wall(R"(<scale value="0.4"/><rotate x="1" angle="80"/><translate x="-0.6" z="0.6"/>)",
                 sheet + parameter("eta", "1.8,1.8,1.8") + "</bsdf>") +
            wall(R"(<scale value="4"/><rotate x="1" angle="90"/><translate y="2"/>)", white) +
            wall(R"(<scale value="4"/><rotate y="1" angle="90"/><translate x="-1.5"/>)",
                 bsdf(R"("conductor">)", "3,1.5,0.4", "0.3,0.6,2")) +
            R"(<shape type="sphere"><point name="center" value="0.5,0,0.5"/><float name="radius" value="0.5"/>)" +
            bsdf(R"("roughconductor"><float name="alpha" value="0.5"/>)", "2.9,2.8,2.7", "3,0.5,1") +
            R"(</shape><shape type="rectangle"><transform name="to_world"><scale value="0.5"/><rotate x="1" angle="180"/>
<translate z="2.4"/></transform><emitter type="area"/></shape></scene>)"));
}

// Kernels see a texture, of which both colours are the same.
/// Its textures are the same everywhere.
Scene texturedRoom() {
    return room([](const std::string& name, const std::string& value) {
        return "<texture type=\"checkerboard\" name=\"" + name + "\">" + rgb("color0", value) + rgb("color1", value) +
               "</texture>";
    });
}

TEST(IndexTexture, OfOneValueMakesTheEstimateOfTheConstant) {
    const Scene textured = texturedRoom(), constant = room(rgb);
    for (const auto direct : {DirectLight::emitters, DirectLight::photons}) {
        const auto expected = radianceOf(constant, direct, 1, SurfaceRule::right);
        const auto distance = [&](SurfaceRule rule, uint64_t seed) {
            const auto image = radianceOf(textured, direct, seed, rule);
            double squares = 0, sum = 0;
            for (size_t k = 0; k < image.size(); ++k) {
                squares += std::pow(image[k] - double(expected[k]), 2);
                sum += expected[k];
            }
            return std::sqrt(squares / double(image.size())) / (sum / double(image.size()));
        };
        EXPECT_LT(distance(SurfaceRule::right, 1), 1e-4);
        EXPECT_GT(distance(SurfaceRule::right, 2), 1e-3) << "other random numbers";
        EXPECT_GT(distance(SurfaceRule::etaIsK, 1), 1e-3);
        EXPECT_GT(distance(SurfaceRule::fresnelOfNormal, 1), 1e-3);
    }
}

TEST(IndexTexture, TheCameraMapRefusesIt) {
    RenderSettings settings;
    settings.map = MapOrder::camera;
    const Scene scene = floorByLamps("<bsdf type=\"conductor\">" + bitmap("eta", "eta.exr") + "</bsdf>");
    EXPECT_THROW(Renderer(testDevice(), scene, settings), InputError);
}

} // namespace
} // namespace quasilux

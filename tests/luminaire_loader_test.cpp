// <emitter type="quasilux_ies">: what is read of it, what is refused, and that many of one file are held once.
#include "prepare/device_scene.h"
#include "support/luminaire_files.h"
#include "support/scene_files.h"

#include <cmath>
#include <gtest/gtest.h>

namespace quasilux {
namespace {

using glm::dvec3;
using test::askewPlace;
using test::IesText;
using test::luminaireXml;

TEST(Luminaires, ATypeIsHeldOnceHoweverMany) {
    test::SceneFiles folder;
    std::string body = "<shape type=\"rectangle\"/>";
    for (int k = 0; k < 20; ++k) {
        IesText ies;
        ies.vertical.clear();
        ies.horizontal.clear();
        for (int v = 0; v <= 180; v += 5) ies.vertical.push_back(v);
        for (int h = 0; h <= 360; h += 15) ies.horizontal.push_back(h);
        ies.candela = [&](double v, double) { return v < 90 ? 100 + k : 1; };
        folder.write("lamp" + std::to_string(k) + ".ies", ies.text());
    }
    const auto sceneOf = [&](int count) {
        std::string text = body;
        for (int k = 0; k < count; ++k)
            text += luminaireXml("lamp" + std::to_string(k % 20) + ".ies",
                                 "<transform name=\"to_world\"><rotate x=\"1\" angle=\"180\"/><translate value=\"" +
                                     std::to_string(k % 40) + "," + std::to_string(k / 40) + ",3\"/></transform>");
        return loadScene(folder.write("scene.xml", test::sceneWith(text)));
    };
    const auto flat = [](const Scene& scene) { return flattenScene(scene, {"auto", 1000, false}); };
    const Scene few = sceneOf(20), many = sceneOf(1000);
    EXPECT_EQ(many.luminaireTypes.size(), 20u);
    EXPECT_EQ(many.pointEmitters.size(), 1001u);
    const DeviceScene small = flat(few), large = flat(many);
    EXPECT_EQ(large.emitters.goniograms.size(), small.emitters.goniograms.size());
    EXPECT_EQ(large.emitters.countInTree(), 1001u);
    // Most shine down only: nodes know that.
    size_t narrow = 0;
    for (const auto& node : large.emitters.lightTree) narrow += node.axis.z < -0.9 ? 1 : 0;
    EXPECT_GT(narrow, large.emitters.lightTree.size() / 2);
}

TEST(LuminaireReader, ReadsWhatIsGivenAndDefaults) {
    const std::string file = test::luminaireFolder + "lambert1000.ies";
    const auto read = [&](const std::string& more, const std::string& before = "") {
        const Scene scene = test::loadBody(before + luminaireXml(file, more));
        return std::pair(scene.pointEmitters.at(1), scene.luminaireTypes.at(0));
    };
    const auto [plain, type] = read("");
    EXPECT_NEAR(plain.intensity.g * 683, 1, 1e-6) << "candela into W/sr";
    EXPECT_EQ(plain.intensity.r, plain.intensity.b);
    EXPECT_TRUE(type.fromShape);
    EXPECT_EQ(type.metresPerUnit, 1);
    EXPECT_NEAR(read("", "<?quasilux units=\"photometric\"?>").first.intensity.g, 1, 1e-6);
    const double lumens = type.goniogram.lumens();
    const PointEmitter dim =
        read("<float name=\"lumens\" value=\"500\"/><float name=\"maintenance\" value=\"0.8\"/>").first;
    EXPECT_NEAR(dim.intensity.g * 683 * lumens, 400, 1e-3);
    const auto [unit, millimetres] = read("<float name=\"metres_per_unit\" value=\"0.001\"/><boolean "
                                          "name=\"luminous_shape\" value=\"false\"/>");
    EXPECT_NEAR(unit.intensity.g * 683, 1e6, 1);
    EXPECT_FALSE(millimetres.fromShape);

    const auto luminanceOfTint = [&](const std::string& tint) {
        const Rgb c = read(tint).first.intensity;
        return 683 * (0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b);
    };
    EXPECT_NEAR(luminanceOfTint("<rgb name=\"tint\" value=\"3,1,0.2\"/>"), 1, 1e-6) << "a tint changes no lumens";
    EXPECT_NEAR(luminanceOfTint("<spectrum name=\"tint\" value=\"400:1, 700:3\"/>"), 1, 1e-6);
    for (const double kelvin : {1500.0, 2700.0, 6500.0, 20000.0})
        EXPECT_NEAR(luminanceOfTint("<float name=\"colour_temperature\" value=\"" + std::to_string(kelvin) + "\"/>"), 1,
                    1e-6);
    const Rgb warm = read("<float name=\"colour_temperature\" value=\"2700\"/>").first.intensity;
    // A black body of 2700 K lies at x 0.4599, y 0.4106 (CIE 15): by the matrix of sRGB.
    EXPECT_NEAR(warm.r * 683, 1.935, 2e-3);
    EXPECT_NEAR(warm.g * 683, 0.804, 2e-3);
    EXPECT_NEAR(warm.b * 683, 0.192, 2e-3);

    const PointEmitter placed = read(askewPlace).first;
    test::expectNear(placed.position, {1, -2, 3});
    EXPECT_LT(glm::length(placed.luminaire->axes[2] - glm::normalize(dvec3(1, 2, 1))), 1e-9);
    const PointEmitter scaled = read("<transform name=\"to_world\"><scale value=\"3\"/></transform>").first;
    EXPECT_EQ(scaled.intensity.g, plain.intensity.g) << "a scale is no other luminaire";
    EXPECT_EQ(scaled.luminaire->axes[0], dvec3(1, 0, 0));
}

TEST(LuminaireReader, SaysWhatIsWrong) {
    test::SceneFiles folder;
    folder.write("lamp.ies", IesText{}.text());
    folder.write("bad.ies", "IESNA91\nTILT=NONE\n1 1000 x\n");
    const auto with = [](const std::string& more) { return luminaireXml("lamp.ies", more); };
    const std::pair<std::string, std::vector<std::string>> cases[] = {
        {"<emitter type=\"quasilux_ies\"/>", {"scene.xml:4:1", "needs <string name=\"filename\""}},
        {luminaireXml("none.ies"), {"scene.xml:5:1", "cannot read the luminaire file", "none.ies"}},
        {luminaireXml("bad.ies"), {"bad.ies:3: candela multiplier: 'x' is not a number"}},
        {with("<float name=\"lumens\" value=\"0\"/>"), {"scene.xml:5:", "lumens"}},
        {with("<float name=\"maintenance\" value=\"-1\"/>"), {"scene.xml:5:", "maintenance"}},
        {with("<float name=\"metres_per_unit\" value=\"0\"/>"), {"scene.xml:5:", "metres_per_unit"}},
        {with("<integer name=\"lamp_set\" value=\"0\"/>"), {"scene.xml:5:", "expected a number from 1"}},
        {with("<integer name=\"lamp_set\" value=\"2\"/>"), {"scene.xml:5:", "IES LM-63 files have one"}},
        {with("<float name=\"colour_temperature\" value=\"100\"/>"), {"scene.xml:5:", "expected 500 to 40000 kelvin"}},
        {with("<float name=\"colour_temperature\" value=\"3000\"/><rgb name=\"tint\" value=\"1\"/>"),
         {"scene.xml:5:", "both tint and colour_temperature"}},
        {with("<rgb name=\"tint\" value=\"0\"/>"),
         {"scene.xml:5:", "parameter 'tint' of emitter 'quasilux_ies' is black"}},
        {with("<transform name=\"to_world\"><scale x=\"2\"/></transform>"),
         {"scene.xml:5:", "scales directions differently"}},
        {with("<float name=\"lumen\" value=\"1\"/>"), {"scene.xml:5:", "Did you mean 'lumens'"}}};
    test::expectErrors(folder, cases);
}

} // namespace
} // namespace quasilux

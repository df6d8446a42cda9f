// Values that Mitsuba takes in other ways than by the letter: capital letters where they do not matter, weights beyond 0 and 1.
#include "support/scene_files.h"

#include <gmock/gmock.h>

namespace quasilux {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Scene loadBsdf(const std::string& bsdf) { return test::loadBody("<shape type=\"rectangle\">\n" + bsdf + "</shape>"); }
const LobeDescription& firstLobe(const Scene& scene) { return scene.bsdfs.at(0).front.at(0); }

std::string text(const std::string& name, const std::string& value) {
    return "<string name=\"" + name + "\" value=\"" + value + "\"/>";
}

// ior.h and microfacet.h of Mitsuba 3.9 turn them into small letters.
TEST(CapitalLetters, DoNotMatterInMaterialsAndDistributions) {
    const auto eta = [](const std::string& inside) {
        return firstLobe(loadBsdf("<bsdf type=\"dielectric\">" + text("int_ior", inside) + text("ext_ior", "Vacuum") +
                                  "</bsdf>"))
            .device.eta.g;
    };
    EXPECT_EQ(eta("BK7"), 1.5046f);
    EXPECT_EQ(eta("Water Ice"), 1.31f);
    for (const char* plugin : {"roughconductor", "roughplastic", "roughdielectric"}) {
        const auto of = [&](const char* name) {
            const Scene scene =
                loadBsdf(std::string("<bsdf type=\"") + plugin + "\">" + text("distribution", name) + "</bsdf>");
            return scene.bsdfs.at(0).front.back().device.type;
        };
        EXPECT_EQ(of("GGX"), of("ggx")) << plugin;
        EXPECT_EQ(of("Beckmann"), of("beckmann")) << plugin;
        EXPECT_NE(of("GGX"), of("Beckmann")) << plugin;
    }
}

TEST(CapitalLetters, MatterInMetals) {
    test::SceneFiles files;
    EXPECT_THAT(test::errorOf(files.write(
                    "scene.xml", test::sceneWith("<bsdf type=\"conductor\">" + text("material", "au") + "</bsdf>"))),
                HasSubstr("unknown material 'au'. Did you mean 'Au'?"));
}

TEST(Weights, OutOfRangeAreTheNearestWithAWarning) {
    const std::string parts = "<bsdf type=\"diffuse\"/><bsdf type=\"conductor\"/></bsdf>";
    const Scene second = loadBsdf("<bsdf type=\"blendbsdf\">\n<float name=\"weight\" value=\"1.5\"/>" + parts);
    ASSERT_EQ(second.bsdfs.at(0).front.size(), 1u);
    EXPECT_EQ(firstLobe(second).device.type, unsigned(LOBE_CONDUCTOR));
    EXPECT_THAT(
        second.warnings,
        ElementsAre(HasSubstr("scene.xml:6:1: parameter 'weight' of bsdf 'blendbsdf' is 1.5; it is taken as 1")));
    const Scene nothing =
        loadBsdf("<bsdf type=\"mask\"><float name=\"opacity\" value=\"-0.1\"/><bsdf type=\"diffuse\"/></bsdf>");
    EXPECT_EQ(firstLobe(nothing).device.type, unsigned(LOBE_PASSAGE));
    EXPECT_EQ(firstLobe(nothing).device.transmittance.g, 1);
    EXPECT_THAT(nothing.warnings, ElementsAre(HasSubstr("is -0.1; it is taken as 0")));
    const Scene medium = test::loadBody(
        "<shape type=\"cube\"><bsdf type=\"null\"/><medium type=\"homogeneous\" name=\"interior\"><phase "
        "type=\"blendphase\"><float "
        "name=\"weight\" value=\"2\"/><phase type=\"hg\"/><phase type=\"rayleigh\"/></phase></medium></shape>");
    EXPECT_EQ(medium.media.at(0).g, 0) << "of 'rayleigh' alone";
    EXPECT_THAT(medium.warnings, ElementsAre(HasSubstr("is 2; it is taken as 1")));
}

} // namespace
} // namespace quasilux

// Spectra: the colours that Mitsuba 3.9.1 makes of them (scripts/spectrum_values.py), wherever a colour may stand.
#include "scene/color.h"
#include "support/scene_files.h"

#include <gmock/gmock.h>

namespace quasilux {
namespace {

using test::errorOf;
using test::SceneFiles;
using test::sceneWith;
using testing::HasSubstr;

std::string diffuse(const std::string& reflectance) {
    return "<shape type=\"rectangle\"><bsdf type=\"diffuse\">\n" + reflectance + "</bsdf></shape>";
}
std::string metal(const std::string& eta) {
    return "<shape type=\"rectangle\"><bsdf type=\"conductor\">" + eta + "</bsdf></shape>";
}
std::string lamp(const std::string& radiance) {
    return "<shape type=\"rectangle\"><emitter type=\"area\">" + radiance + "</emitter></shape>";
}

Rgb reflectanceOf(const Scene& scene) { return scene.bsdfs.at(0).front.at(0).device.reflectance; }
Rgb etaOf(const Scene& scene) { return scene.bsdfs.at(0).front.at(0).device.eta; }
Rgb radianceOf(const Scene& scene) { return scene.shapes.at(0).emitter->radiance; }

void expectColor(Rgb value, const Rgb& expected) {
    const float tolerance = 2e-5f * std::max(1.f, largest(expected)); // that of single precision over 1000 steps
    test::expectNear({value.r, value.g, value.b}, {expected.r, expected.g, expected.b}, tolerance);
}

struct SpectrumCase {
    const char *name, *list;
    Rgb reflectance, unbounded, emission;
    bool outside; ///< of the colours that a reflectance can have
};
class SpectrumColors : public testing::TestWithParam<SpectrumCase> {};

TEST_P(SpectrumColors, AreMitsubas) {
    const SpectrumCase& c = GetParam();
    const auto named = [&](const char* name) {
        return std::string("<spectrum name=\"") + name + "\" value=\"" + c.list + "\"/>";
    };
    const Scene scene = test::loadBody(diffuse(named("reflectance")));
    expectColor(reflectanceOf(scene), c.reflectance);
    ASSERT_EQ(scene.warnings.size(), c.outside ? 1u : 0u);
    if (c.outside) {
        EXPECT_THAT(scene.warnings[0], HasSubstr("scene.xml:5:1: the spectrum has a colour outside of sRGB"));
    }
    expectColor(etaOf(test::loadBody(metal(named("eta")))), c.unbounded);
    expectColor(radianceOf(test::loadBody(lamp(named("radiance")))), c.emission);
}

TEST_P(SpectrumColors, AreThoseOfTheSameSpectrumInAFile) {
    const SpectrumCase& c = GetParam();
    std::string lines = c.list;
    for (char& letter : lines) letter = letter == ':' ? ' ' : (letter == ',' || letter == ' ' ? '\n' : letter);
    SceneFiles files;
    for (const std::string& content : {"# nm, value\n\n" + lines, "\xef\xbb\xbf" + lines}) {
        files.write("s.spd", content);
        const Scene scene =
            loadScene(files.write("scene.xml", sceneWith(lamp("<spectrum name=\"radiance\" filename=\"s.spd\"/>"))));
        expectColor(radianceOf(scene), c.emission);
    }
}

INSTANTIATE_TEST_SUITE_P(Spectrum, SpectrumColors,
                         testing::Values(SpectrumCase{"Falling",
                                                      "400:0.78, 500:0.3, 600:0.9, 700:0.1",
                                                      {0.88597345f, 0.53821248f, 0.50613511f},
                                                      {0.88597345f, 0.53821248f, 0.50613511f},
                                                      {1.01721382f, 0.51824051f, 0.46463665f},
                                                      false},
                                         SpectrumCase{"Narrow",
                                                      "540:0,550:1,560:0",
                                                      {0, 0.14057706f, 0},
                                                      {0, 0.14057706f, 0},
                                                      {0, 0.13450989f, 0},
                                                      true},
                                         SpectrumCase{"Bright",
                                                      "400:1.5 700:2.5",
                                                      {1, 1, 1},
                                                      {2.29716110f, 1.97609055f, 1.62840605f},
                                                      {2.73984671f, 1.87900305f, 1.46886122f},
                                                      true},
                                         SpectrumCase{"All",
                                                      "300:0.25,900:0.25",
                                                      {0.24974586f, 0.24971807f, 0.24970055f},
                                                      {0.24974586f, 0.24971807f, 0.24970055f},
                                                      {0.30122066f, 0.23705722f, 0.22731669f},
                                                      false}),
                         [](const auto& row) { return std::string(row.param.name); });

// Values of Mitsuba's RGB mode; those of a black body of its spectral mode, which alone computes it.
TEST(SpectrumPlugins, StandWhereverAColorStands) {
    for (const std::string tag : {"spectrum", "texture"}) {
        const auto plugin = [&](const char* name, const char* type, const char* parameters) {
            return "<" + tag + " name=\"" + name + "\" type=\"" + type + "\">" + parameters + "</" + tag + ">";
        };
        const auto reflectance = [&](const char* type, const char* parameters) {
            return reflectanceOf(test::loadBody(diffuse(plugin("reflectance", type, parameters))));
        };
        const auto radiance = [&](const char* type, const char* parameters) {
            return radianceOf(test::loadBody(lamp(plugin("radiance", type, parameters))));
        };
        const char* const half = "<float name=\"value\" value=\"0.5\"/>";
        expectColor(reflectance("uniform", half), {0.5f, 0.5f, 0.5f});
        expectColor(radiance("uniform", half), {0.5f, 0.5f, 0.5f}); // as Mitsuba: no equal-energy white
        const char* const color = "<rgb name=\"color\" value=\"0.1,0.5,0.9\"/>";
        expectColor(reflectance("srgb", color), {0.1f, 0.5f, 0.9f});
        expectColor(radiance("d65", ""), {1, 1, 1});
        expectColor(radiance("d65", "<rgb name=\"color\" value=\"1,2,4\"/><float name=\"scale\" value=\"3\"/>"),
                    {3, 6, 12});
        expectColor(
            radiance("srgb", "<rgb name=\"color\" value=\"1,2,4\"/><boolean name=\"unbounded\" value=\"true\"/>"),
            {1, 2, 4});
        const char* const irregular = "<string name=\"wavelengths\" value=\"400, 500, 600, 700\"/>"
                                      "<string name=\"values\" value=\"0.78, 0.3, 0.9, 0.1\"/>";
        expectColor(reflectance("irregular", irregular), {0.88597345f, 0.53821248f, 0.50613511f});
        const char* const regular =
            "<float name=\"wavelength_min\" value=\"400\"/><float name=\"wavelength_max\" value=\"700\"/>"
            "<string name=\"values\" value=\"0.78 0.3 0.9 0.1\"/>";
        expectColor(radiance("regular", regular), {1.01721382f, 0.51824051f, 0.46463665f});
        expectColor(radiance("regular", "<spectrum name=\"value\" value=\"400:1.5,700:2.5\"/>"),
                    {2.73984671f, 1.87900305f, 1.46886122f});
        // Of its spectral mode; its lists by wavelength count 999 of 1000 steps, and so does this.
        const auto blackBody = [&](const char* kelvin) {
            return radiance("blackbody",
                            (std::string("<float name=\"temperature\" value=\"") + kelvin + "\"/>").c_str());
        };
        expectColor(blackBody("2856"), Rgb{499.7187f, 223.7829f, 63.25843f} * 0.999f);
        expectColor(blackBody("6500"), Rgb{43962.55f, 41448.63f, 43626.24f} * 0.999f);
    }
}

TEST(SpectrumPlugins, AreSharedByReferenceAndStandForNumbers) {
    const Scene scene = test::loadBody(
        "<spectrum type=\"uniform\" id=\"u\"><float name=\"value\" value=\"0.3\"/></spectrum>"
        "<shape type=\"rectangle\"><bsdf type=\"roughconductor\"><ref id=\"u\" name=\"alpha\"/><ref id=\"u\" "
        "name=\"specular_reflectance\"/></bsdf></shape>");
    const auto& lobe = scene.bsdfs.at(0).front.at(0).device;
    EXPECT_NEAR(lobe.alphaU, 0.3f, 1e-6f);
    EXPECT_NEAR(lobe.reflectance.g, 0.3f, 1e-6f);
    EXPECT_TRUE(scene.textures.empty());
    EXPECT_TRUE(scene.warnings.empty());
}

TEST(SpectrumPlugins, AnUnusedOneIsReported) {
    const Scene scene = test::loadBody("<texture type=\"d65\" id=\"idle\"/>");
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_THAT(scene.warnings[0], HasSubstr("texture 'idle' is used by no bsdf"));
}

// Sums that are no numbers any more were taken as black.
TEST(SpectrumPlugins, ValuesTooLargeToBeAddedUpAreRefused) {
    SceneFiles files;
    for (const char* radiance :
         {"<spectrum name=\"radiance\" value=\"360:1e307,830:1e307\"/>",
          "<spectrum name=\"radiance\" value=\"360:-1e307,830:-1e307\"/>",
          "<spectrum name=\"radiance\" type=\"blackbody\"><float name=\"temperature\" value=\"1e300\"/></spectrum>"})
        EXPECT_THAT(errorOf(files.write("scene.xml", sceneWith("\n" + lamp("\n" + std::string(radiance))))),
                    HasSubstr("scene.xml:6:1: the values of the spectrum are too large"))
            << radiance;
}

struct BadSpectrum {
    const char *name, *reflectance, *message;
};
class BadSpectra : public testing::TestWithParam<BadSpectrum> {};
TEST_P(BadSpectra, AreRefusedAtTheirPlace) {
    SceneFiles files;
    files.write("short.spd", "400 0.5\n");
    files.write("words.spd", "# fine\n400 0.5\n500 half\n");
    files.write("one.spd", "400 0.5\n500\n");
    const std::string error = errorOf(files.write("scene.xml", sceneWith(diffuse(GetParam().reflectance))));
    EXPECT_THAT(error, HasSubstr(GetParam().message));
}
#define SPECTRUM(attributes) "<spectrum name=\"reflectance\" " attributes "/>"
#define PLUGIN(type, inside) "<spectrum name=\"reflectance\" type=\"" type "\">" inside "</spectrum>"
INSTANTIATE_TEST_SUITE_P(
    Spectrum, BadSpectra,
    testing::Values(
        BadSpectrum{"OnePair", SPECTRUM("value=\"400:0.1\""),
                    "scene.xml:5:1: parameter 'reflectance': a spectrum of 1"},
        BadSpectrum{"Order", SPECTRUM("value=\"500:0.1,400:0.2\""),
                    "scene.xml:5:1: parameter 'reflectance': the wavelength 400 follows 500"},
        BadSpectrum{"NoPair", SPECTRUM("value=\"500:0.1,400\""),
                    "scene.xml:5:1: parameter 'reflectance': '400' is no pair"},
        BadSpectrum{"NoNumber", SPECTRUM("value=\"500:x,600:1\""), "'x' is not a number"},
        BadSpectrum{"Nan", SPECTRUM("value=\"500:nan,600:1\""), "'nan' is not finite"},
        BadSpectrum{"Both", SPECTRUM("value=\"1\" filename=\"a.spd\""),
                    "scene.xml:5:1: parameter 'reflectance': give either"},
        BadSpectrum{"Neither", SPECTRUM(""), "give either value or filename"},
        BadSpectrum{"NoFile", SPECTRUM("filename=\"none.spd\""), "scene.xml:5:1: "},
        BadSpectrum{"ShortFile", SPECTRUM("filename=\"short.spd\""), "short.spd: spectrum: a spectrum of 1"},
        BadSpectrum{"Words", SPECTRUM("filename=\"words.spd\""), "words.spd:3: value: 'half' is not a number"},
        BadSpectrum{"OneNumber", SPECTRUM("filename=\"one.spd\""), "one.spd:2: '500' is no sample"},
        BadSpectrum{
            "UniformAboveOne", PLUGIN("uniform", "<float name=\"value\" value=\"2\"/>"),
            "scene.xml:5:1: parameter 'reflectance' of bsdf 'diffuse' is (2, 2, 2); every channel must lie within"},
        BadSpectrum{"SrgbAboveOne", PLUGIN("srgb", "\n<rgb name=\"color\" value=\"2\"/>"),
                    "scene.xml:6:1: parameter 'color' of texture 'srgb' is (2, 2, 2); every channel must lie within"},
        BadSpectrum{"NoValue", PLUGIN("uniform", ""), "scene.xml:5:1: texture 'uniform' needs the parameter 'value'"},
        BadSpectrum{"NoTemperature", PLUGIN("blackbody", ""), "needs the parameter 'temperature'"},
        BadSpectrum{"Cold", PLUGIN("blackbody", "<float name=\"temperature\" value=\"0\"/>"), "must be greater than 0"},
        BadSpectrum{"Sizes",
                    PLUGIN("irregular",
                           "<string name=\"wavelengths\" value=\"400,500\"/><string name=\"values\" value=\"1\"/>"),
                    "2 wavelengths and 1 values"},
        BadSpectrum{"NoWavelengths", PLUGIN("regular", "<string name=\"values\" value=\"1,1\"/>"),
                    "needs the parameter 'wavelength_min'"},
        BadSpectrum{"BackwardRange",
                    PLUGIN("regular", "<string name=\"values\" value=\"1,1\"/><float name=\"wavelength_min\" "
                                      "value=\"700\"/><float name=\"wavelength_max\" value=\"400\"/>"),
                    "the wavelength 400 follows 700"},
        BadSpectrum{"UnknownPlugin", PLUGIN("blackbdoy", ""),
                    "unknown texture plugin 'blackbdoy'. Did you mean 'blackbody'?"},
        BadSpectrum{"UnknownParameter", PLUGIN("d65", "<float name=\"sclae\" value=\"1\"/>"), "Did you mean 'scale'?"},
        BadSpectrum{"Cycle",
                    "<texture type=\"uniform\" name=\"reflectance\" id=\"a\"><ref id=\"a\" name=\"value\"/></texture>",
                    "texture 'a' contains itself"},
        BadSpectrum{"NotAColor",
                    "<texture type=\"uniform\" name=\"reflectanec\"><float name=\"value\" value=\"1\"/></texture>",
                    "scene.xml:5:1: bsdf 'diffuse' takes no texture as 'reflectanec'"}),
    [](const auto& row) { return std::string(row.param.name); });

} // namespace
} // namespace quasilux

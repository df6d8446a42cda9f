// Lights, cameras, extras and what stands in for missing ones, of glTF files.
#include "scene/skies/sky_image.h"
#include "support/gltf_files.h"
#include "support/luminaire_files.h"

#include <fmt/format.h>
#include <numbers>

namespace quasilux {
namespace {

using nlohmann::json;
using test::GltfFile;
using testing::Contains;
using testing::HasSubstr;

class GltfScene : public test::GltfTest {
protected:
    static GltfFile square() {
        GltfFile file;
        file.addNode({{"mesh", file.addSquare()}, {"name", "plate"}});
        return file;
    }
};

TEST_F(GltfScene, PunctualLights) {
    GltfFile file = square();
    file.addLight({{"type", "point"}, {"intensity", 5}, {"color", {1, 0.5, 0}}}, {{"translation", {1, 2, 3}}});
    file.addLight({{"type", "spot"}, {"intensity", 7}, {"spot", {{"innerConeAngle", 0.25}, {"outerConeAngle", 0.5}}}},
                  {{"rotation", {-std::sqrt(0.5), 0, 0, std::sqrt(0.5)}}, {"scale", {3, 3, 3}}}); // from -z to -y
    file.addLight({{"type", "directional"}, {"intensity", 100}});
    file.addLight({{"type", "point"}, {"intensity", 0}});
    const Scene scene = load(file);
    EXPECT_EQ(scene.settings.units, Units::photometric);
    ASSERT_EQ(scene.pointEmitters.size(), 2u);
    EXPECT_EQ(scene.pointEmitters[0].position, glm::vec3(1, 2, 3));
    EXPECT_EQ(scene.pointEmitters[0].intensity.r, 5);
    EXPECT_EQ(scene.pointEmitters[0].intensity.g, 2.5f);
    ASSERT_TRUE(scene.pointEmitters[1].spot);
    EXPECT_LT(glm::length(scene.pointEmitters[1].spot->axis - glm::vec3(0, -1, 0)), 1e-6);
    EXPECT_NEAR(scene.pointEmitters[1].spot->beamAngle, 0.25, 1e-6);
    EXPECT_NEAR(scene.pointEmitters[1].spot->cutoffAngle, 0.5, 1e-6);
    ASSERT_EQ(scene.directionalEmitters.size(), 1u);
    EXPECT_LT(glm::length(scene.directionalEmitters[0].direction - glm::vec3(0, 0, -1)), 1e-6);
    EXPECT_EQ(scene.directionalEmitters[0].irradiance.g, 100);
}

TEST_F(GltfScene, CamerasAreThoseOfXml) {
    GltfFile file = square();
    const double yfov = 0.6;
    file.add("cameras",
             {{"type", "perspective"}, {"perspective", {{"yfov", yfov}, {"aspectRatio", 2}, {"znear", 0.1}}}});
    file.add("cameras",
             {{"type", "orthographic"}, {"orthographic", {{"xmag", 3}, {"ymag", 1.5}, {"znear", 0.1}, {"zfar", 50}}}});
    // Looks down from above, with -z of the world up in the image.
    const json node = {{"translation", {0, 4, 0}}, {"rotation", {-std::sqrt(0.5), 0, 0, std::sqrt(0.5)}}};
    for (int camera = 0; camera < 2; ++camera) {
        json placed = node;
        placed["camera"] = camera;
        file.addNode(placed);
    }
    const Sensor perspective = load(file).sensor, orthographic = load(file, {"1"}).sensor;
    const auto xml = [](const std::string& type, const std::string& content) {
        return loadScene(test::SceneFiles().write("scene.xml", "<scene version=\"3.0.0\">" +
                                                                   std::string(test::minimalLight) +
                                                                   "<shape type=\"rectangle\"/><sensor type=\"" + type +
                                                                   "\">" + content + "</sensor></scene>"))
            .sensor;
    };
    const std::string lookat = "<lookat origin=\"0,4,0\" target=\"0,0,0\" up=\"0,0,-1\"/>";
    const Sensor same = xml("perspective", fmt::format("<transform name=\"to_world\">{}</transform><float name=\"fov\" "
                                                       "value=\"{}\"/><string name=\"fov_axis\" value=\"y\"/><film "
                                                       "type=\"hdrfilm\"><integer name=\"width\" value=\"768\"/>"
                                                       "<integer name=\"height\" value=\"384\"/></film>",
                                                       lookat, yfov * 180 / std::numbers::pi));
    EXPECT_NEAR(perspective.fovX, same.fovX, 1e-9);
    EXPECT_EQ(perspective.width, same.width);
    EXPECT_EQ(perspective.height, same.height);
    EXPECT_EQ(perspective.nearClip, 0.1);
    for (int k = 0; k < 4; ++k) EXPECT_LT(glm::length(perspective.toWorld[k] - same.toWorld[k]), 1e-12) << k;
    EXPECT_TRUE(orthographic.orthographic);
    EXPECT_NEAR(glm::length(glm::dvec3(orthographic.toWorld[0])), 3, 1e-12);
    EXPECT_EQ(orthographic.height, 384u);
    EXPECT_EQ(orthographic.farClip, 50);
}

TEST_F(GltfScene, WithoutCameraAndLight) {
    const Scene scene = load(square());
    EXPECT_THAT(scene.warnings, Contains(HasSubstr("no camera")));
    EXPECT_THAT(scene.warnings, Contains(HasSubstr("no light")));
    ASSERT_TRUE(scene.surroundings);
    EXPECT_EQ(scene.surroundings->radiance.g, 1);
    const glm::dvec3 place(scene.sensor.toWorld[3]), view(scene.sensor.toWorld[2]);
    EXPECT_GT(place.z, 1);
    EXPECT_GT(place.y, 0);
    EXPECT_LT(glm::length(glm::cross(glm::normalize(view), glm::normalize(-place))), 1e-9); // at the middle
    // All corners are in the picture.
    const glm::dmat4 toCamera = glm::inverse(scene.sensor.toWorld);
    for (const glm::vec3& corner : scene.shapes[0].mesh.positions) {
        const glm::dvec3 seen(toCamera * glm::dvec4(glm::dvec3(corner), 1));
        EXPECT_LT(std::abs(seen.x / seen.z), std::tan(scene.sensor.fovX / 2));
        EXPECT_LT(std::abs(seen.y / seen.z), std::tan(scene.sensor.fovX / 2) * 3 / 4);
    }
}

TEST_F(GltfScene, LuminairesAndSettingsByExtras) {
    std::filesystem::copy(QUASILUX_SOURCE_DIR "/tests/data/luminaires", files.path("luminaires"));
    std::string ies;
    for (const auto& entry : std::filesystem::directory_iterator(files.path("luminaires")))
        if (entry.path().extension() == ".ies") ies = "luminaires/" + entry.path().filename().string();
    ASSERT_FALSE(ies.empty());
    GltfFile file = square();
    file.addNode({{"translation", {0, 3, 0}},
                  {"rotation", {-std::sqrt(0.5), 0, 0, std::sqrt(0.5)}},
                  {"extras", {{"ies", ies}, {"lumens", 1000}, {"maintenance", 0.8}}}});
    file.json["scenes"][0]["extras"]["quasilux"] = {
        {"bdd", 1},
        {"illuminance-grid",
         {{"origin", {0, 0, 0}}, {"edge-u", {0, 0, 1}}, {"edge-v", {1, 0, 0}}, {"nx", 2}, {"ny", 3}}}};
    const Scene scene = load(file);
    ASSERT_EQ(scene.pointEmitters.size(), 1u);
    ASSERT_TRUE(scene.pointEmitters[0].luminaire);
    EXPECT_LT(glm::length(scene.pointEmitters[0].luminaire->axes[2] - glm::dvec3(0, -1, 0)), 1e-9);
    const double lumens = scene.luminaireTypes.at(0).goniogram.lumens() * scene.pointEmitters[0].intensity.g;
    EXPECT_NEAR(lumens, 800, 0.01); // candela, as the units are photometric
    EXPECT_EQ(scene.settings.bdd, 1u);
    ASSERT_EQ(scene.grids.size(), 1u);
    EXPECT_EQ(scene.grids.front().ny, 3u);
    EXPECT_EQ(scene.sensor.meter, MeterKind::grid); // without a camera
}

// As in a scene file whose axes are turned, so that the file's +y is the zenith and -z the north.
TEST_F(GltfScene, ASkyByExtras) {
    GltfFile file = square();
    file.json["scenes"][0]["extras"]["quasilux"] = {{"bdd", 1},
                                                    {"sky",
                                                     {{"type", "quasilux_cie_sky"},
                                                      {"sky_type", 12},
                                                      {"illuminance", 20000.5},
                                                      {"sun_illuminance", 50000},
                                                      {"sun_direction", {0.5, 1, 2}},
                                                      {"tint", {1, 0.9, 0.8}}}}};
    const Scene scene = load(file);
    EXPECT_EQ(scene.settings.bdd, 1u);
    const Scene written = loadScene(files.write(
        "sky.xml", R"(<scene version="3.0.0"><?quasilux units="photometric"?><emitter type="quasilux_cie_sky">
        <integer name="sky_type" value="12"/><float name="illuminance" value="20000.5"/>
        <float name="sun_illuminance" value="50000"/><vector name="sun_direction" value="0.5,1,2"/>
        <rgb name="tint" value="1,0.9,0.8"/><transform name="to_world"><rotate x="1" angle="-90"/></transform></emitter>
        <sensor type="perspective"/><shape type="sphere"/></scene>)"));
    ASSERT_TRUE(scene.surroundings && scene.surroundings->image && written.surroundings);
    for (int axis = 0; axis < 3; ++axis)
        test::expectNear(glm::vec3(scene.surroundings->image->axes[axis]),
                         glm::vec3(written.surroundings->image->axes[axis]));
    const auto &found = scene.surroundings->image->pixels, &expected = written.surroundings->image->pixels;
    ASSERT_EQ(found.size(), expected.size());
    for (size_t k = 0; k < found.size(); k += 97) EXPECT_EQ(found[k].g, expected[k].g);
    ASSERT_EQ(scene.directionalEmitters.size(), 1u);
    test::expectNear(scene.directionalEmitters[0].direction, written.directionalEmitters[0].direction);
    EXPECT_LT(scene.directionalEmitters[0].direction.y, -0.8);
    file.json["scenes"][0]["extras"]["quasilux"]["sky"].erase("type");
    EXPECT_THROW(load(file), InputError);
}

/// Towards the sun of an image, in the world.
glm::dvec3 sunOf(const EnvironmentImage& image) {
    glm::dvec3 sum(0);
    for (unsigned row = 0; row < image.height; ++row)
        for (unsigned column = 0; column < image.width; ++column)
            sum += double(image.pixels[size_t(row) * image.width + column].g) *
                   std::sin(std::numbers::pi * row / (image.height - 1)) *
                   directionOfSkyPixel(column, row, image.height);
    return glm::normalize(image.axes * glm::dvec3(sum.x, sum.z, -sum.y)); // its x, y, z are the sky's x, z, -y
}

// East is +x, north -z, by place and time and by a direction: the sky of Mitsuba has the south along x, the west along
// y.
TEST_F(GltfScene, TheSunOfSunskyStandsAsOnTheMap) {
    const auto sunBy = [&](json where) {
        json sky = {{"type", "sunsky"}, {"sky_scale", 0}, {"sun_aperture", 4}};
        sky.update(where);
        GltfFile file = square();
        file.json["scenes"][0]["extras"]["quasilux"]["sky"] = sky;
        return sunOf(load(file).surroundings.value().image.value());
    };
    const glm::dvec3 along = glm::normalize(glm::dvec3(0.5, 2, -1)); // east, above, south
    EXPECT_LT(glm::length(sunBy({{"sun_direction", {0.5, 1, 2}}}) - along), 1e-3);
    const auto berlin = [&](int hour) {
        return sunBy({{"latitude", 52.5},
                      {"longitude", 15},
                      {"timezone", 1},
                      {"year", 2026},
                      {"month", 6},
                      {"day", 21},
                      {"hour", hour}});
    };
    // 90 - 52.5 + 23.44 degrees above the south at noon, which the equation of time moves by 0.5 degrees.
    const glm::dvec3 noon = berlin(12), morning = berlin(8), evening = berlin(16);
    EXPECT_NEAR(noon.y, std::sin(60.94 * std::numbers::pi / 180), 2e-3);
    EXPECT_NEAR(noon.x, 0, 0.01);
    EXPECT_GT(noon.z, 0.4) << "in the south";
    EXPECT_GT(morning.x, 0.5) << "in the east";
    EXPECT_LT(evening.x, -0.5) << "in the west";
}

// Of an image +y is up already.
TEST_F(GltfScene, AnEnvironmentMapByExtrasStandsUpright) {
    std::vector<uint8_t> pixels(16, 255);
    for (const size_t black : {8, 9, 10, 12, 13, 14}) pixels[black] = 0;
    png(pixels); // white above, black below
    GltfFile file = square();
    file.json["scenes"][0]["extras"]["quasilux"]["sky"] = {{"type", "envmap"}, {"filename", "image.png"}};
    const Scene scene = load(file);
    const EnvironmentImage image = scene.surroundings.value().image.value();
    EXPECT_LT(glm::length(image.axes[1] - glm::dvec3(0, 1, 0)), 1e-9);
    EXPECT_LT(glm::length(image.axes[2] - glm::dvec3(0, 0, 1)), 1e-9);
    EXPECT_GT(image.pixels.front().g, image.pixels.back().g);
    file.json["scenes"][0]["extras"]["quasilux"]["sky"] = {{"type", "constant"}, {"radiance", {1, 2, 3}}};
    EXPECT_EQ(load(file).surroundings.value().radiance.g, 2);
}

TEST_F(GltfScene, ObserversStandUpright) {
    const json upright = {{"position", {0, 0, 0}}, {"direction", {1, 0, 0}}};
    json lying = upright;
    lying["up"] = {0, 0, 1};
    GltfFile file = square();
    file.json["scenes"][0]["extras"]["quasilux"]["observer"] = {upright, lying};
    const Scene scene = load(file);
    ASSERT_EQ(scene.observers.size(), 2u);
    EXPECT_EQ(scene.observers[0].up, glm::dvec3(0, 1, 0));
    EXPECT_EQ(scene.observers[1].up, glm::dvec3(0, 0, 1));
}

// As of the scene language, whose gamma = 0 is along +z: turned about the x-axis.
TEST_F(GltfScene, MirroredNodesMirrorTheirLuminaires) {
    files.write("lamp.ies", test::IesText{}.text());
    const std::vector<double> matrices[] = {{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 2, 0, 1},
                                            {-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 2, 0, 1},
                                            {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 0, 2, 0, 1},
                                            {0, 2, 0, 0, 2, 0, 0, 0, 0, 0, 2, 0, 0, 2, 0, 1}};
    for (const std::vector<double>& m : matrices) {
        GltfFile file = square();
        file.addNode({{"matrix", m}, {"extras", {{"ies", "lamp.ies"}}}});
        std::string rows;
        for (size_t row = 0; row < 4; ++row)
            for (size_t column = 0; column < 4; ++column) rows += fmt::format("{} ", m[4 * column + row]);
        const Scene written = loadScene(files.write(
            "lamp.xml", fmt::format(R"(<scene version="3.0.0"><sensor type="perspective"/><shape type="sphere"/>
            <emitter type="quasilux_ies"><string name="filename" value="lamp.ies"/><transform name="to_world">
            <rotate x="1" angle="180"/><matrix value="{}"/></transform></emitter></scene>)",
                                    rows)));
        const auto axesOf = [](const Scene& scene) { return scene.pointEmitters.at(0).luminaire.value().axes; };
        for (int axis = 0; axis < 3; ++axis)
            EXPECT_LT(glm::length(axesOf(load(file))[axis] - axesOf(written)[axis]), 1e-9) << rows << axis;
    }
}

// EXT_lights_ies: in a file, a buffer and a data URI. Its zero points along -z and C0 along +x of the node.
TEST_F(GltfScene, LuminairesByTheirExtension) {
    const std::string ies = test::IesText{}.text();
    files.write("a lamp.ies", ies);
    GltfFile file = square();
    file.json["extensionsUsed"] = file.json["extensionsRequired"] = {"EXT_lights_ies"};
    std::string escaped;
    for (const char letter : ies) escaped += letter == '\n' ? "%0a" : letter == ' ' ? "%20" : std::string(1, letter);
    file.json["extensions"]["EXT_lights_ies"]["lights"] = {
        {{"uri", "a%20lamp.ies"}},
        {{"bufferView", file.view(ies.data(), ies.size())}, {"mimeType", "application/x-ies-lm-63"}},
        {{"uri", "data:application/x-ies-lm-63," + escaped}}};
    const auto add = [&](nlohmann::json light) {
        file.addNode({{"extensions", {{"EXT_lights_ies", std::move(light)}}}});
    };
    for (const int light : {0, 1, 2, 1}) add({{"light", light}});
    add({{"light", 0}, {"multiplier", 2}, {"color", {1, 0.5, 0}}});
    add({{"light", 0}, {"multiplier", 0}});
    const Scene scene = load(file);
    ASSERT_EQ(scene.luminaireTypes.size(), 3u);
    ASSERT_EQ(scene.pointEmitters.size(), 5u) << "one is off";
    for (const PointEmitter& emitter : scene.pointEmitters) {
        ASSERT_TRUE(emitter.luminaire);
        EXPECT_LT(glm::length(emitter.luminaire->axes[2] - glm::dvec3(0, 0, -1)), 1e-9);
        EXPECT_LT(glm::length(emitter.luminaire->axes[0] - glm::dvec3(1, 0, 0)), 1e-9);
        EXPECT_EQ(scene.luminaireTypes[emitter.luminaire->type].goniogram.largest(), 100);
    }
    EXPECT_EQ(scene.pointEmitters[1].luminaire->type, scene.pointEmitters[3].luminaire->type) << "read once";
    EXPECT_NEAR(scene.pointEmitters[0].intensity.g, 1, 1e-6) << "candela";
    EXPECT_NEAR(scene.pointEmitters[4].intensity.r, 2, 1e-5) << "a factor of each channel";
    EXPECT_NEAR(scene.pointEmitters[4].intensity.g, 1, 1e-5);
    EXPECT_NEAR(scene.pointEmitters[4].intensity.b, 0, 1e-5);
}

TEST_F(GltfScene, WhatHasNoEffectIsListedOnce) {
    GltfFile file = square();
    file.json["extensionsUsed"] = {"KHR_materials_sheen", "KHR_lights_punctual"};
    file.addLight({{"type", "point"}, {"intensity", 1}, {"range", 4}});
    const int mesh = file.addSquare({{"mode", 1}});
    file.addNode({{"mesh", mesh}});
    file.addNode({{"mesh", mesh}});
    const std::vector<std::string> warnings = load(file).warnings;
    EXPECT_THAT(warnings, Contains(HasSubstr("not supported and without effect: KHR_materials_sheen, points and lines, "
                                             "range of lights.")));
}

TEST_F(GltfScene, FilesBesideIt) {
    const GltfFile file = square();
    files.write("a b.bin", file.buffer());
    const std::string path = files.write("scene.gltf", file.text("a%20b.bin"));
    EXPECT_EQ(loadScene(path).shapes.size(), 1u);
    EXPECT_EQ(loadScene(path, {}, {{}, Unknown::refused, LoadLimits{}}).shapes.size(), 1u);
}

} // namespace
} // namespace quasilux

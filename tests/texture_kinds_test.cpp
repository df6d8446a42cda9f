// Textures that are not of (u, v) alone: attributes of meshes, volumes, textures within checkerboards.
#include "scene/color.h"
#include "support/scene_files.h"
#include "support/texture_tints.h"
#include "support/vol_files.h"

#include <gtest/gtest.h>

namespace quasilux {
namespace {

using test::down;
using test::RayFrom;
using test::SceneFiles;
using test::sceneWith;
using test::tintsAt;

/// Two triangles with colours and numbers at their corners and colours of their own; (.3, -.2) is on the first one.
const char* const attributed =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
    "property float r\nproperty float g\nproperty float b\nproperty float w_x\nelement face 2\n"
    "property list uchar int vertex_indices\nproperty float f_x\nproperty float f_y\n"
    "property float f_z\nend_header\n-1 -1 0 .1 .2 .3 .1\n1 -1 0 .4 .5 .6 .5\n1 1 0 .9 .8 .7 .9\n"
    "-1 1 0 0 0 2 0\n3 0 1 2 .2 .4 .6\n3 0 2 3 .5 .6 .7\n";

std::string attributeTexture(const std::string& name, const std::string& scale, const std::string& as) {
    return "<texture type=\"mesh_attribute\" name=\"" + as + "\"><string name=\"name\" value=\"" + name +
           "\"/><float name=\"scale\" value=\"" + scale + "\"/></texture>";
}

// Values of Mitsuba 3.9.1, but for those above 1, which are taken as 1 before they are interpolated. Another shape
// of another texture lies below.
TEST(MeshAttribute, IsInterpolatedAsInMitsuba) {
    const struct {
        const char *name, *scale;
        glm::vec3 value, onSecond;
    } cases[] = {
        {"vertex_color", "1", {.495f, .515f, .535f}, {.34f, .33f, .72f}},
        {"vertex_color", "0.5", {.2475f, .2575f, .2675f}, {.17f, .165f, .56f}},
        {"vertex_w", "1", glm::vec3(.52f), glm::vec3(.34f)},
        {"face_f", "0.5", {.1f, .2f, .3f}, {.25f, .3f, .35f}},
        {"face_f", "2", {.4f, .8f, 1}, {1, 1, 1}},
    };
    SceneFiles files;
    files.write("a.ply", attributed);
    const char* const placements[] = {"", "<boolean name=\"flip_normals\" value=\"true\"/>",
                                      "<boolean name=\"face_normals\" value=\"true\"/>"};
    for (size_t k = 0; k < std::size(cases); ++k) {
        const auto& c = cases[k];
        const char* const placed = placements[k % std::size(placements)];
        SCOPED_TRACE(std::string(c.name) + " " + c.scale + " " + placed);
        const std::string shape =
            std::string("<shape type=\"ply\"><string name=\"filename\" value=\"a.ply\"/>") + placed;
        const std::string bsdf = "<bsdf type=\"twosided\"><bsdf type=\"diffuse\">" +
                                 attributeTexture(c.name, c.scale, "reflectance") + "</bsdf></bsdf>";
        const std::string first =
            "<bsdf id=\"first\" type=\"diffuse\">" + attributeTexture("face_f", "1", "reflectance") + "</bsdf>";
        const Scene scene = loadScene(files.write(
            "scene.xml", sceneWith(first +
                                   "<shape type=\"sphere\"><point name=\"center\" value=\"0,0,-9\"/></shape>"
                                   "<shape type=\"ply\"><string name=\"filename\" value=\"a.ply\"/><transform "
                                   "name=\"to_world\"><translate "
                                   "z=\"-3\"/></transform><ref id=\"first\"/></shape>" +
                                   shape + bsdf + "</shape>")));
        const auto tints = tintsAt(scene, {{{.3f, -.2f, 2}, down}, {{-.3f, .5f, 2}, down}, {{.3f, -.2f, -1}, down}});
        test::expectNear(tints[0], c.value, 2e-6f);
        test::expectNear(tints[1], c.onSecond, 2e-6f);
        test::expectNear(tints[2], {.2f, .4f, .6f}, 2e-6f);
    }
}

/// A grid over [-1, 1]^3 whose colours are linear between the centres of its 2 x 2 x 2 voxels: (x, y, z) in [0.1,
/// 0.9]^3 of places in [-1/2, 1/2]^3, and the value of the nearest of those beyond.
std::string colorCube(const SceneFiles& files, const std::string& parameters = "") {
    std::vector<float> values;
    for (int k = 0; k < 8; ++k)
        for (const int bit : {k & 1, k >> 1 & 1, k >> 2}) values.push_back(0.1f + 0.8f * float(bit));
    files.write("cube.vol", test::volFile({2, 2, 2}, 3, values));
    return R"(<volume type="gridvolume" name="volume"><string name="filename" value="cube.vol"/>)" + parameters +
           R"(<transform name="to_world"><scale value="2"/><translate x="-1" y="-1" z="-1"/></transform></volume>)";
}
glm::vec3 colorOfCube(const glm::vec3& place) { return 0.1f + 0.8f * glm::clamp(place + 0.5f, 0.f, 1.f); }

TEST(VolumeTexture, IsLookedUpAtThePlaceOfTheHit) {
    SceneFiles files;
    const std::string texture = "<bsdf type=\"diffuse\"><texture type=\"volume\" name=\"reflectance\">" +
                                colorCube(files) + "</texture></bsdf></shape>";
    // Without texture coordinates; on a sphere too, and beyond the grid's box.
    files.write("m.obj", "v -3 -3 0.2\nv 3 -3 0.2\nv 0 3 0.2\nf 1 2 3\n");
    const std::vector<RayFrom> rays{{{.3f, -.2f, 2}, down}, {{-.9f, .1f, 2}, down}, {{0, -2.5f, 2}, down}};
    const Scene flat = loadScene(files.write(
        "scene.xml", sceneWith("<shape type=\"obj\"><string name=\"filename\" value=\"m.obj\"/>" + texture)));
    const auto tints = tintsAt(flat, rays);
    for (size_t k = 0; k < rays.size(); ++k)
        test::expectNear(tints[k], colorOfCube({rays[k].origin.x, rays[k].origin.y, 0.2f}), 2e-6f);
    const Scene round = loadScene(
        files.write("scene.xml", sceneWith("<shape type=\"sphere\"><float name=\"radius\" value=\"0.5\"/>" + texture)));
    test::expectNear(tintsAt(round, {{{.3f, 0, 2}, down}})[0], colorOfCube({.3f, 0, .4f}), 2e-6f);
}

TEST(VolumeTexture, GivesNumbersAndColoursToo) {
    SceneFiles files;
    const auto tintOf = [&](const std::string& bsdf) {
        return tintsAt(loadScene(files.write("scene.xml", sceneWith("<shape type=\"rectangle\">" + bsdf + "</shape>"))),
                       {{{.3f, -.2f, 2}, down}})[0];
    };
    const glm::vec3 color = colorOfCube({.3f, -.2f, 0});
    const auto weightOf = [&](const std::string& volume) {
        return 1 - tintOf("<bsdf type=\"blendbsdf\"><texture type=\"volume\" name=\"weight\">" + volume +
                          "</texture><bsdf type=\"diffuse\"/><bsdf type=\"diffuse\"/></bsdf>")
                       .x;
    };
    EXPECT_NEAR(weightOf(colorCube(files)), luminance({color.x, color.y, color.z}), 2e-6);
    EXPECT_NEAR(
        weightOf("<volume type=\"constvolume\" name=\"volume\"><rgb name=\"value\" value=\"0.9,0.3,0.3\"/></volume>"),
        0.5, 2e-6)
        << "the mean, as in Mitsuba";
    const auto constant = [](const std::string& volume) {
        return "<bsdf type=\"diffuse\"><texture type=\"volume\" name=\"reflectance\">" + volume + "</texture></bsdf>";
    };
    test::expectNear(tintOf(constant("")), glm::vec3(0.75f));
    test::expectNear(tintOf(constant("<rgb name=\"volume\" value=\"0.1,0.2,0.3\"/>")), {.1f, .2f, .3f});
    test::expectNear(
        tintOf(constant(
            "<volume type=\"constvolume\" name=\"volume\"><rgb name=\"value\" value=\"0.4,0.2,0.3\"/></volume>")),
        {.4f, .2f, .3f});
    // Within a checkerboard, whose second square this is; as much as may be reflected.
    files.write("bright.vol", test::volFile({1, 1, 1}, 1, {7}));
    const std::string bright =
        R"(<texture type="volume" name="color0"><volume type="gridvolume" name="volume"><string name="filename" value="bright.vol"/></volume></texture>)";
    const Scene scene = loadScene(files.write(
        "scene.xml", sceneWith("<shape type=\"rectangle\"><bsdf type=\"diffuse\"><texture type=\"checkerboard\" "
                               "name=\"reflectance\">" +
                               bright + "</texture></bsdf></shape>")));
    test::expectNear(tintsAt(scene, {{{.3f, .2f, 2}, down}})[0], glm::vec3(1));
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_NE(scene.warnings[0].find("1 of the 1 values of the volume are above 1"), std::string::npos);
}

/// Two checkerboards within one.
std::string nestedBoards(const std::string& name) {
    return "<texture type=\"checkerboard\" name=\"" + name + R"("><texture type="checkerboard" name="color0">
<rgb name="color0" value=".1,.2,.6"/><rgb name="color1" value=".3,.5,.7"/>
<transform name="to_uv"><scale x="4" y="4"/></transform></texture>
<texture type="checkerboard" name="color1"><rgb name="color0" value=".8"/><transform name="to_uv"><translate x=".25"/></transform></texture></texture>)";
}

// Values of Mitsuba 3.9.1, which has the colours the other way round where it asks for a number.
TEST(NestedTextures, AreMitsubas) {
    const struct {
        glm::vec3 from, color;
        float number;
    } cases[] = {
        {{-.8f, -.8f, 2}, {.1f, .2f, .6f}, .2f}, {{-.55f, -.8f, 2}, {.3f, .5f, .7f}, .2f},
        {{.3f, -.8f, 2}, glm::vec3(.2f), .3f},   {{.8f, -.8f, 2}, glm::vec3(.8f), .3f},
        {{.9f, .9f, 2}, {.1f, .2f, .6f}, .8f},   {{-.3f, .4f, 2}, glm::vec3(.8f), .3f},
        {{-.8f, .4f, 2}, glm::vec3(.2f), .3f},
    };
    std::vector<RayFrom> rays;
    for (const auto& c : cases) rays.push_back({c.from, down});
    const auto colors = tintsAt(test::loadBody("<shape type=\"rectangle\"><bsdf type=\"diffuse\">" +
                                               nestedBoards("reflectance") + "</bsdf></shape>"),
                                rays);
    const auto numbers =
        tintsAt(test::loadBody("<shape type=\"rectangle\"><bsdf type=\"blendbsdf\">" + nestedBoards("weight") +
                               "<bsdf type=\"null\"/><bsdf type=\"diffuse\"/></bsdf></shape>"),
                rays);
    for (size_t k = 0; k < rays.size(); ++k) {
        SCOPED_TRACE(k);
        test::expectNear(colors[k], cases[k].color, 1e-6f);
        // The first lobe lets pass what the second one does not take.
        EXPECT_NEAR(numbers[k].x, 1 - cases[k].number, 1e-6f);
    }
}

} // namespace
} // namespace quasilux

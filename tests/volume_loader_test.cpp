// What a scene file says of volumes in media: values, defaults, places; and what is refused, hostile files too, at the
// line that names them.
#include "support/scene_files.h"
#include "support/vol_files.h"

#include <gmock/gmock.h>
#include <limits>

namespace quasilux {
namespace {

using test::errorOf;
using test::SceneFiles;
using test::sceneWith;
using test::volFile;
using testing::ElementsAre;
using testing::HasSubstr;

/// A heterogeneous medium; `content` starts at line 5, column 1.
std::string mediumOf(const std::string& content) {
    return sceneWith("<shape type=\"cube\"><bsdf type=\"null\"/><medium type=\"heterogeneous\" name=\"interior\">\n" +
                     content + "</medium></shape>");
}

std::string grid(const std::string& name, const std::string& file, const std::string& more = "") {
    return "<volume type=\"gridvolume\" name=\"" + name + "\">\n<string name=\"filename\" value=\"" + file + "\"/>" +
           more + "</volume>";
}

class Volumes : public testing::Test {
protected:
    Scene load(const std::string& content) const { return loadScene(files_.write("scene.xml", mediumOf(content))); }
    std::string error(const std::string& content) const {
        return errorOf(files_.write("scene.xml", mediumOf(content)));
    }
    std::string write(const std::string& name, const std::string& content) const { return files_.write(name, content); }

private:
    SceneFiles files_;
};

void expectBox(const shared::VolumeGrid& grid, const glm::vec3& lower, const glm::vec3& upper) {
    test::expectNear({grid.lower.x, grid.lower.y, grid.lower.z}, lower);
    test::expectNear({grid.upper.x, grid.upper.y, grid.upper.z}, upper);
}

TEST_F(Volumes, DefaultsAreThoseOfMitsuba) {
    const Scene scene = load("");
    const MediumDescription& medium = scene.media.at(0);
    ASSERT_TRUE(medium.extinction);
    EXPECT_FALSE(medium.albedoVolume);
    EXPECT_EQ(medium.albedo.r, 0.75f);
    EXPECT_EQ(medium.id, "heterogeneous@4");
    const VolumeDescription& volume = scene.volumes.at(*medium.extinction);
    EXPECT_THAT(volume.values, ElementsAre(1.f));
    expectBox(volume.device, {0, 0, 0}, {1, 1, 1});
}

TEST_F(Volumes, AGridIsReadWithItsPlace) {
    write("a.vol", volFile({3, 2, 1}, 1, {0, 1, 2, 3, 4, 5}, {0, 0, 0, 3, 2, 1}));
    const Scene scene = load(grid("sigma_t", "a.vol", R"(<boolean name="use_grid_bbox" value="true"/>
        <transform name="to_world"><scale value="2"/><translate x="1"/></transform>)") +
                             R"(<float name="scale" value="4"/>)");
    const MediumDescription& medium = scene.media.at(0);
    EXPECT_EQ(medium.extinctionScale, 4);
    EXPECT_NEAR(medium.sigmaT.r, 10, 1e-6);
    const VolumeDescription& volume = scene.volumes.at(0);
    EXPECT_EQ(volume.device.filter, VOLUME_TRILINEAR);
    EXPECT_EQ(volume.device.wrap, WRAP_CLAMP);
    EXPECT_THAT(volume.values, ElementsAre(0, 1, 2, 3, 4, 5));
    EXPECT_THAT(volume.device.size, ElementsAre(3, 2, 1));
    expectBox(volume.device, {1, 0, 0}, {7, 4, 2});
    EXPECT_NEAR(volume.device.toVoxels[0], 0.5, 1e-6); // a voxel is 2 long
    EXPECT_NEAR(volume.device.toVoxels[3], -0.5, 1e-6);
}

TEST_F(Volumes, ATurnedGridFillsTheBoxAboutIt) {
    write("a.vol", volFile({1, 1, 1}, 1, {1}));
    const Scene scene =
        load(grid("sigma_t", "a.vol", R"(<transform name="to_world"><rotate z="1" angle="45"/></transform>)"));
    const float half = std::sqrt(0.5f);
    expectBox(scene.volumes.at(0).device, {-half, 0, 0}, {half, 2 * half, 1});
}

TEST_F(Volumes, OneThatTwoMediaShareIsReadOnce) {
    write("a.vol", volFile({1, 1, 2}, 3, {1, 0.5f, 0, 1, 0.5f, 0.5f}));
    write("b.vol", volFile({1, 1, 2}, 1, {1, 3}));
    SceneFiles unused;
    const Scene scene = load(R"(<volume name="sigma_t" type="constvolume"/></medium>
        <medium name="exterior" type="heterogeneous"><ref name="albedo" id="a"/></medium></shape>
        <shape type="sphere"><bsdf type="null"/><medium name="interior" type="heterogeneous"><ref name="albedo" id="a"/></medium></shape>
        <volume type="gridvolume" id="b"><string name="filename" value="b.vol"/></volume>
        <volume type="gridvolume" id="a"><string name="filename" value="a.vol"/></volume><shape type="cube"><bsdf
        type="null"/><medium
        name="interior" type="heterogeneous">)");
    ASSERT_EQ(scene.media.size(), 4u);
    EXPECT_EQ(scene.media[1].albedoVolume, scene.media[2].albedoVolume);
    EXPECT_NEAR(scene.media[1].albedo.b, 0.25, 1e-6);
    EXPECT_THAT(scene.warnings, ElementsAre(HasSubstr("volume 'b' is used by no medium and no texture")));
}

TEST_F(Volumes, ColouredExtinctionIsRefused) {
    EXPECT_THAT(error(R"(<rgb name="sigma_t" value="1,2,3"/>)"),
                HasSubstr("scene.xml:5:1: parameter 'sigma_t': the extinction of a heterogeneous"));
    write("rgb.vol", volFile({1, 1, 1}, 3, {1, 1, 1}));
    EXPECT_THAT(error(grid("sigma_t", "rgb.vol")),
                HasSubstr("scene.xml:5:1: parameter 'sigma_t': the extinction of a heterogeneous"));
}

TEST_F(Volumes, AlbedoAboveOneIsRefused) {
    write("a.vol", volFile({1, 1, 2}, 1, {0.5f, 1.5f}));
    EXPECT_THAT(error(grid("albedo", "a.vol")), HasSubstr("scene.xml:5:1: an albedo has values above 1"));
}

TEST_F(Volumes, OutOfRangeOfSinglePrecision) {
    write("a.vol", volFile({1, 1, 1}, 1, {1e30f}));
    EXPECT_THAT(error(grid("sigma_t", "a.vol") + "\n<float name=\"scale\" value=\"1e30\"/>"),
                HasSubstr("scene.xml:7:1: sigma_t times scale"));
}

TEST_F(Volumes, HostileFilesAreRefusedAtTheLineThatNamesThem) {
    const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
    const std::string good = volFile({2, 2, 2}, 1, std::vector<float>(8, 1.f));
    const auto with = [&](size_t at, char byte) {
        std::string changed = good;
        changed[at] = byte;
        return changed;
    };
    const std::pair<std::string, std::string> cases[] = {
        {"", "it is no .vol file"},
        {"VOL", "it is no .vol file"},
        {std::string(100, 'x'), "it is no .vol file"},
        {good.substr(0, 47), "it is no .vol file"},
        {with(3, 2), "it is of version 2; expected version 3"},
        {with(4, 3), "its values are of encoding 3; expected 1"},
        {with(8, 0), "it has 0 x 2 x 2 voxels"},
        {with(11, 127), "voxels; expected 1 to 65536"},
        {with(20, 2), "it has 2 channels; expected 1 or 3"},
        {good.substr(0, good.size() - 1), "take 80 bytes; the file has 79"},
        {good + "x", "take 80 bytes; the file has 81"},
        {volFile({65536, 65536, 65536}, 3, {}), "take 3377699720527920 bytes; the file has 48"},
        {volFile({2, 1, 1}, 1, {0, nan}), "voxel 1, 0, 0 has the value nan"},
        {volFile({1, 2, 1}, 1, {0, infinity}), "voxel 0, 1, 0 has the value inf"},
        {volFile({1, 1, 2}, 1, {0, -1}), "voxel 0, 0, 1 has the value -1"},
    };
    for (const auto& [content, expected] : cases) {
        write("bad.vol", content);
        const std::string message = error(grid("sigma_t", "bad.vol"));
        EXPECT_THAT(message, HasSubstr("scene.xml:6:1: cannot read the volume"));
        EXPECT_THAT(message, HasSubstr(expected));
    }
    EXPECT_THAT(error(grid("sigma_t", "none.vol")), HasSubstr("scene.xml:6:1: "));
    write("flat.vol", volFile({1, 1, 1}, 1, {1}, {0, 0, 0, 0, 1, 1}));
    EXPECT_THAT(error(grid("sigma_t", "flat.vol", "<boolean name=\"use_grid_bbox\" value=\"true\"/>")),
                HasSubstr("scene.xml:6:1: the volume's box has no extent"));
}

TEST_F(Volumes, TheDensityOfFormerVersionsIsTheExtinction) {
    write("a.vol", volFile({3, 2, 1}, 1, {0, 1, 2, 3, 4, 5}, {0, 0, 0, 3, 2, 1}));
    const std::string former = "<string name=\"method\" value=\"woodcock\"/>" + grid("density", "a.vol");
    std::string scene = mediumOf(former);
    EXPECT_THAT(error(former), HasSubstr("method")) << "control";
    scene.replace(scene.find("3.0.0"), 5, "0.6.0");
    const Scene upgraded = loadScene(write("scene06.xml", scene));
    EXPECT_NEAR(upgraded.media.at(0).sigmaT.r, 2.5, 1e-6);
    expectBox(upgraded.volumes.at(0).device, {0, 0, 0}, {3, 2, 1});
}

TEST_F(Volumes, UnknownPluginsAndParameters) {
    EXPECT_THAT(error("<volume name=\"sigma_t\" type=\"gridvolum\"/>"), HasSubstr("Did you mean 'gridvolume'?"));
    EXPECT_THAT(error("<volume name=\"sigma_t\" type=\"constvolume\">\n<float name=\"valu\" value=\"1\"/></volume>"),
                HasSubstr("scene.xml:6:1: unknown parameter 'valu' of volume 'constvolume'"));
    EXPECT_THAT(error("<volume name=\"sigmat\" type=\"constvolume\"/>"), HasSubstr("scene.xml:5:1: "));
    write("a.vol", volFile({1, 1, 1}, 1, {1}));
    EXPECT_THAT(error(grid("sigma_t", "a.vol", "\n<string name=\"filter_type\" value=\"cubic\"/>")),
                HasSubstr("scene.xml:7:1: "));
}

} // namespace
} // namespace quasilux

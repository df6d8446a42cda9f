// What stands in other files: where these are looked for, and what they are within the file that includes them.
#include "scene/scene.h"

#include "support/scene_files.h"

#include <cmath>
#include <gmock/gmock.h>

namespace quasilux {
namespace {

using test::SceneFiles;
using test::sceneWith;

// In Mitsuba 3.9.1 includes are looked for beside the file that has them, spectra within an included file beside the
// one that includes it, before any <path> of that.
TEST(Includes, AndSpectraAreLookedForWhereMitsubaDoes) {
    SceneFiles files;
    const std::vector<std::string> folders = {"", "parts/", "parts/deep/", "other/"};
    for (const std::string& folder : folders) std::filesystem::create_directories(files.path(folder));
    const auto scene = [](const std::string& body) { return "<scene version=\"3.0.0\">" + body + "</scene>"; };
    const std::string matt = R"(<bsdf type="diffuse"><spectrum name="reflectance" filename="s.spd"/></bsdf>)";
    const auto found = [&](const std::string& body) { // the folder of the file that is used
        const Scene read = loadScene(files.write("scene.xml", sceneWith(body)));
        if (read.shapes.at(0).id != "matt") return read.shapes[0].id.substr(3);
        return folders.at(size_t(std::lround(10 * read.bsdfs.at(0).front.at(0).device.reflectance.g)) - 1);
    };
    for (size_t k = 0; k < folders.size(); ++k) {
        files.write(folders[k] + "ball.xml", scene("<shape type=\"sphere\" id=\"at " + folders[k] + "\"/>"));
        const std::string value = "0." + std::to_string(k + 1);
        files.write(folders[k] + "s.spd", "400 " + value + "\n700 " + value + "\n");
    }
    const std::string ball = R"(<include filename="ball.xml"/>)", other = R"(<path value="other"/>)",
                      matter = R"(<shape type="sphere" id="matt">)" + matt + "</shape>";
    files.write("parts/ball_in_part.xml", scene(ball));
    files.write("parts/matt.xml", scene(matter));
    files.write("parts/deep/matt.xml", scene(matter));
    files.write("parts/two.xml", scene(R"(<include filename="deep/matt.xml"/>)"));
    files.write("parts/own.xml", scene(R"(<path value="deep"/>)" + matter));
    EXPECT_EQ(found(other + ball), "");
    EXPECT_EQ(found(R"(<include filename="parts/ball_in_part.xml"/>)"), "parts/");
    EXPECT_EQ(found(other + R"(<include filename="parts/ball_in_part.xml"/>)"), "parts/");
    EXPECT_EQ(found(other + matter), "other/");
    EXPECT_EQ(found(R"(<include filename="parts/matt.xml"/>)"), "");
    EXPECT_EQ(found(other + R"(<include filename="parts/matt.xml"/>)"), "");
    EXPECT_EQ(found(R"(<include filename="parts/two.xml"/>)"), "parts/");
    EXPECT_EQ(found(R"(<include filename="parts/own.xml"/>)"), "parts/deep/");
}

// As in Mitsuba 3.9.1; that of a <scene> says nothing.
TEST(Includes, MayNameTheirObject) {
    SceneFiles files;
    const std::string texture = R"(type="checkerboard"><rgb name="color0" value="0.25"/></texture>)";
    files.write("plain.xml", "<texture version=\"3.0.0\" " + texture);
    files.write("named.xml", "<texture version=\"3.0.0\" name=\"other\" " + texture);
    files.write("scene_of_one.xml", "<scene version=\"3.0.0\"><texture name=\"reflectance\" " + texture + "</scene>");
    for (const std::string include :
         {R"("plain.xml" name="reflectance")", R"("named.xml" name="reflectance")", R"("scene_of_one.xml" name="x")"}) {
        const Scene scene = loadScene(files.write(
            "scene.xml", sceneWith("<shape type=\"cube\"><bsdf type=\"diffuse\"><include filename=" + include +
                                   "/></bsdf></shape>")));
        EXPECT_EQ(scene.textures.size(), 1u) << include;
    }
}

} // namespace
} // namespace quasilux

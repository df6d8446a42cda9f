// What makes `quasilux render` handy: several scenes, watching files, warnings as errors, terminals.
// What pictures are sent to these as: terminal_picture_test.
#include "compare/image_file.h"
#include "output/progress_line.h"
#include "scene/scene.h"
#include "scene/xml/read_files.h"
#include "support/program_runner.h"
#include "support/scene_files.h"
#include "util/error.h"
#include "util/stopwatch.h"

#include <OpenImageIO/imageio.h>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <gmock/gmock.h>
#include <thread>

namespace quasilux {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

TEST(ReadFiles, AreAllThatASceneWasReadFrom) {
    const test::SceneFiles files;
    files.write("metal.spd", "400 0.5\n700 0.5\n");
    files.write("part.xml", R"(<bsdf version="3.0.0" type="diffuse" id="d"><spectrum name="reflectance"
        filename="metal.spd"/></bsdf>)");
    files.write("ball.ply",
                "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n"
                "3 0 1 2\n");
    const std::string scene = files.write("scene.xml", R"(<scene version="3.0.0"><include filename="part.xml"/>
        <shape type="ply"><string name="filename" value="ball.ply"/><ref id="d"/></shape><emitter type="constant"/>
        <sensor type="perspective"/></scene>)");
    const auto wait = [] { std::this_thread::sleep_for(std::chrono::milliseconds(120)); };
    ReadFiles read;
    {
        const ReadFilesNoted noted(read);
        loadScene(scene);
    }
    EXPECT_EQ(read.count(), 4u);
    EXPECT_FALSE(read.haveChanged());
    for (const char* name : {"metal.spd", "part.xml", "ball.ply", "scene.xml"}) {
        ReadFiles before = read;
        wait();
        EXPECT_FALSE(before.haveChanged()) << name;
        const auto time = fs::last_write_time(files.path(name));
        fs::last_write_time(files.path(name), time + std::chrono::seconds(1));
        wait();
        EXPECT_TRUE(before.haveChanged()) << name;
        fs::last_write_time(files.path(name), time);
    }
    fs::remove(files.path("ball.ply"));
    wait();
    EXPECT_FALSE(read.haveChanged()) << "it may be in the middle of being replaced";
    ReadFiles missing;
    {
        const ReadFilesNoted noted(missing);
        EXPECT_THROW(loadScene(scene), InputError);
    }
    files.write("ball.ply", "");
    EXPECT_TRUE(missing.haveChanged()) << "what was missing is there";
    const size_t count = missing.count();
    EXPECT_THROW(loadScene(files.path("elsewhere.xml")), InputError);
    EXPECT_EQ(missing.count(), count) << "control: nobody notes any more";
}

class HabitsTest : public CommandLineTest {
protected:
    HabitsTest() {
        for (const char* name : {"a.xml", "b.xml"}) fs::copy_file(folder / "scene.xml", folder / name);
        std::ofstream(folder / "bad.xml") << "<scene version='3.0.0'>\n<shape type='no_such'/></scene>";
        std::ofstream(folder / "odd.xml") << replaced("<shape", "<shape type='no_such'/><shape");
    }
    ~HabitsTest() override {
        for (const char* name : {"QUASILUX_OUTPUT", "NO_COLOR"}) unsetenv(name);
    }

    std::string replaced(const std::string& from, const std::string& to) const {
        std::string text = readText(folder / "scene.xml");
        return text.replace(text.find(from), from.size(), to);
    }
    Outcome render(std::vector<std::string> more) const {
        more.insert(more.begin(), {"render", "--fixed", "--passes", "1"});
        return run(more);
    }
    /// Files that end so.
    std::vector<std::string> written(const std::string& end) const {
        std::vector<std::string> names;
        for (const auto& name : filesInFolder())
            if (fs::path(name).extension() == end) names.push_back(name);
        return names;
    }
};

TEST_F(HabitsTest, SceneAloneIsRendered) {
    const Outcome outcome = run({"a.xml", "--fixed", "--passes", "1"});
    EXPECT_EQ(outcome.exitCode, 0) << outcome.errors;
    EXPECT_THAT(outcome.output, HasSubstr("wrote a.exr"));
    EXPECT_THAT(run({"gone.xml"}).errors, HasSubstr("gone.xml"));
}

// A model that nothing lights yet: black by every method.
TEST_F(HabitsTest, ASceneWithoutLightIsBlack) {
    std::ofstream(folder / "off.xml") << replaced("value=\"1\"", "value=\"0\"");
    std::ofstream(folder / "none.xml") << replaced(R"(<emitter type="area"><rgb name="radiance" value="1"/></emitter>)",
                                                   R"(<bsdf type="plastic"/>)");
    const std::vector<std::vector<std::string>> methods = {{"--time", "0.2"},
                                                           {"--fixed", "--passes", "2"},
                                                           {"--fixed", "--passes", "2", "--direct", "photons"},
                                                           {"--fixed", "--passes", "2", "--map", "camera"}};
    const auto radiances = [&](const std::string& scene, const std::vector<std::string>& method, Outcome& outcome) {
        std::vector<std::string> arguments{"render", scene, "-o", "image.exr"};
        arguments.insert(arguments.end(), method.begin(), method.end());
        outcome = run(arguments);
        return readRadiance((folder / "image.exr").string()).radiance;
    };
    Outcome outcome;
    for (const char* scene : {"off.xml", "none.xml"})
        for (const auto& method : methods) {
            EXPECT_THAT(radiances(scene, method, outcome), testing::Each(0.0f)) << scene << method[0];
            EXPECT_EQ(outcome.exitCode, 0) << outcome.errors;
            EXPECT_THAT(outcome.errors, HasSubstr("so its image is black"));
            EXPECT_THAT(outcome.errors, Not(HasSubstr("not finite")));
        }
    std::ofstream(folder / "lit.xml") << replaced("<shape", "<emitter type=\"constant\"/><shape");
    EXPECT_THAT(radiances("lit.xml", methods[1], outcome), Not(testing::Each(0.0f))) << "control";
    EXPECT_THAT(outcome.errors, Not(HasSubstr("black"))) << "control";
    EXPECT_EQ(run({"info", "none.xml"}).exitCode, 0);
    EXPECT_EQ(run({"none.xml", "--strict", "--fixed", "--passes", "1"}).exitCode, 2);
}

TEST_F(HabitsTest, EachSceneHasItsOutput) {
    EXPECT_EQ(render({"a.xml", "b.xml", "--seed", "5", "--without", "bias", "-o", "{scene}_{seed}_{passes}.exr",
                      "--stats", "{scene}_{sensor}.json"})
                  .exitCode,
              0);
    EXPECT_THAT(written(".exr"), ElementsAre("a_5_1.exr", "b_5_1.exr"));
    EXPECT_THAT(written(".json"), ElementsAre("a_0.json", "b_0.json"));
}

TEST_F(HabitsTest, NoFileIsWrittenTwice) {
    expectRefused({"render", "a.xml", "b.xml", "-o", "c.exr"}, "a.xml and b.xml would both be written to c.exr: write "
                                                               "{scene} into the name");
    expectRefused({"render", "a.xml", "./a.xml"}, "would both be written to a.exr");
    expectRefused({"render", "a.xml", "b.xml", "--resume", "c.ckpt"}, "a checkpoint is of one scene");
    expectRefused({"render", "a.xml", "b.xml", "-o", "gone/{scene}.exr"}, "folder gone does not exist");
    expectRefused({"render", "a.xml", "-o", "{sceen}.exr"}, "unknown {sceen}");
    expectRefused({"render", "a.xml", "gone.xml"}, "cannot read the scene file 'gone.xml': there is no such file");
    expectRefused({"render", "a.xml", "b.xml", "-j", "2", "--watch"}, "excludes");
    expectRefused({"render", "a.xml", "--watch", "--checkpoint", "a.ckpt"}, "--watch excludes --checkpoint");
}

TEST_F(HabitsTest, OneSceneThatFailsStopsNoOther) {
    for (const char* jobs : {"1", "3"}) {
        const Outcome outcome = render({"a.xml", "bad.xml", "b.xml", "-j", jobs});
        EXPECT_EQ(outcome.exitCode, 2) << outcome.errors;
        EXPECT_THAT(written(".exr"), ElementsAre("a.exr", "b.exr"));
        EXPECT_THAT(outcome.output, testing::AllOf(HasSubstr("wrote a.exr"), HasSubstr("wrote b.exr")));
        const size_t list = outcome.errors.find("quasilux: error: 1 of 3 scenes failed:\n  bad.xml: bad.xml:2:");
        ASSERT_NE(list, std::string::npos) << outcome.errors;
        EXPECT_THAT(outcome.errors.substr(0, list), HasSubstr("quasilux: error: bad.xml:2:")) << "and when it came";
        for (const char* name : {"a.exr", "b.exr"}) fs::remove(folder / name);
    }
    EXPECT_EQ(render({"a.xml", "b.xml", "--device", "999"}).exitCode, 2);
}

// A signal while the next one loads ends the program at once.
TEST_F(HabitsTest, ASummaryIsThereWhenTheNextSceneBegins) {
    const auto isSaid = [&] { return readText(root / "stdout").find("wrote a.exr") != std::string::npos; };
    const Stopwatch watch;
    const Outcome outcome = runUntil(
        {"render", "a.xml", "b.xml", "--fixed", "--time", "0.1", "--passes", "1000000"},
        [&] { return isSaid() || watch.seconds() > 60; }, SIGKILL);
    EXPECT_EQ(outcome.exitCode, -1) << outcome.errors;
    EXPECT_THAT(outcome.output, HasSubstr("wrote a.exr"));
    EXPECT_THAT(outcome.output, Not(HasSubstr("wrote b.exr")));
}

TEST_F(HabitsTest, SeveralAtOnceNeedAFolderForWhatTheyPrint) {
    setenv("TMPDIR", (folder / "gone").c_str(), 1);
    const Outcome outcome = render({"a.xml", "b.xml", "-j", "2"});
    unsetenv("TMPDIR");
    EXPECT_EQ(outcome.exitCode, 1);
    EXPECT_THAT(outcome.errors, HasSubstr("no temporary file can be made: TMPDIR names no folder"));
}

TEST_F(HabitsTest, SeveralAtOnceAreTheSameImages) {
    EXPECT_EQ(render({"a.xml", "b.xml", "-j", "2", "-o", "{scene}_at_once.exr"}).exitCode, 0);
    EXPECT_EQ(render({"a.xml", "b.xml", "-o", "{scene}.exr"}).exitCode, 0);
    EXPECT_EQ(run({"compare", "a_at_once.exr", "a.exr", "--max-rmse", "1e-30", "--quiet"}).exitCode, 0);
}

TEST_F(HabitsTest, FilesHaveADefaultFolder) {
    fs::create_directory(folder / "out");
    fs::create_directory(folder / "other");
    setenv("QUASILUX_OUTPUT", "out", 1);
    EXPECT_EQ(render({"a.xml", "--stats", "s.json", "--png", "./p.png"}).exitCode, 0);
    EXPECT_TRUE(fs::exists(folder / "out/a.exr"));
    EXPECT_TRUE(fs::exists(folder / "out/s.json"));
    EXPECT_TRUE(fs::exists(folder / "p.png")) << "its name has a folder";
    EXPECT_EQ(render({"a.xml", "--folder", "other"}).exitCode, 0);
    EXPECT_TRUE(fs::exists(folder / "other/a.exr")) << "the option is stronger";
    setenv("QUASILUX_OUTPUT", "gone", 1);
    expectRefused({"render", "a.xml"}, "--folder gone (or QUASILUX_OUTPUT): folder gone does not exist");
    EXPECT_EQ(render({"a.xml", "-o", "./a.exr"}).exitCode, 0) << "nothing is to go there";
}

TEST_F(HabitsTest, WarningsCanBeErrors) {
    EXPECT_EQ(render({"odd.xml", "--lenient"}).exitCode, 0);
    fs::remove(folder / "odd.exr");
    const Outcome strict = render({"odd.xml", "--lenient", "--strict", "--quiet"});
    EXPECT_EQ(strict.exitCode, 2);
    EXPECT_THAT(strict.errors, HasSubstr("quasilux: warning: 1 thing is unknown"));
    EXPECT_THAT(strict.errors,
                HasSubstr("quasilux: error: --strict: the warnings above are errors, nothing is rendered"));
    EXPECT_THAT(written(".exr"), ElementsAre());
    EXPECT_EQ(render({"a.xml", "--strict"}).exitCode, 0) << "control: a scene without warnings";
    // Of what only the finished render knows, as in cli_test.
    const Outcome late = run({"render", QUASILUX_SOURCE_DIR "/scenes/cornell_phong.xml", "--fixed", "--photons", "200",
                              "--passes", "1", "-D", "resolution=32", "-o", "box.exr", "--strict"});
    EXPECT_EQ(late.exitCode, 1);
    EXPECT_THAT(late.errors, HasSubstr("the warning above is an error; the files have been written"));
    EXPECT_TRUE(fs::exists(folder / "box.exr"));
}

class WatchTest : public HabitsTest {
protected:
    WatchTest() {
        std::ofstream(folder / "part.xml") << radiance("1");
        std::ofstream(folder / "whole.xml") << replaced("<shape", "<include filename='part.xml'/><shape");
    }
    static std::string radiance(const std::string& value) {
        return "<emitter version='3.0.0' type='constant'><rgb name='radiance' value='" + value + "'/></emitter>";
    }
    /// Saves another radiance as editors do: a new file in the place of the old one.
    void save(const std::string& value) const {
        std::ofstream(folder / "part.new") << radiance(value);
        fs::rename(folder / "part.new", folder / "part.xml");
    }
    /// Until `isThere` or 20 s are over.
    static bool waitFor(const std::function<bool()>& isThere) {
        for (int k = 0; k < 400 && !isThere(); ++k) std::this_thread::sleep_for(std::chrono::milliseconds(50));
        return isThere();
    }
    size_t renders() const {
        const std::string text = readText(root / "stdout");
        size_t count = 0;
        for (size_t at = text.find("wrote"); at != std::string::npos; at = text.find("wrote", at + 1)) ++count;
        return count;
    }
};

TEST_F(WatchTest, RendersWhenAFileOfTheSceneChanges) {
    const pid_t process = start({"render", "whole.xml", "--fixed", "--passes", "1", "--watch"});
    EXPECT_TRUE(waitFor([&] { return renders() == 1; })) << readText(root / "stderr");
    save("2");
    EXPECT_TRUE(waitFor([&] { return renders() == 2; }));
    save("wrong");
    EXPECT_TRUE(waitFor([&] { return readText(root / "stderr").find("part.xml:1:") != std::string::npos; }));
    save("3");
    EXPECT_TRUE(waitFor([&] { return renders() == 3; }));
    kill(process, SIGINT);
    const Outcome outcome = end(process);
    EXPECT_EQ(outcome.exitCode, 0);
    EXPECT_EQ(renders(), 3u);
    const auto image = OIIO::ImageInput::open((folder / "whole.exr").string());
    std::vector<float> pixels(4 * 4 * 3);
    ASSERT_TRUE(image && image->read_image(0, 0, 0, 3, OIIO::TypeDesc::FLOAT, pixels.data()));
    EXPECT_NEAR(pixels[0], 3, 0.1) << "of the last file: a corner that sees the surroundings";
}

TEST_F(WatchTest, RendersWhenAGltfFileOrItsBufferChanges) {
    const std::string good = readText(QUASILUX_SOURCE_DIR "/tests/data/lit_floor.gltf");
    const size_t begin = good.find("data:"), length = good.find('"', begin) - begin;
    const float corners[] = {-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0};
    const uint16_t faces[] = {0, 1, 2, 0, 2, 3};
    std::ofstream(folder / "floor.bin", std::ios::binary)
        .write(reinterpret_cast<const char*>(corners), sizeof corners)
        .write(reinterpret_cast<const char*>(faces), sizeof faces);
    std::string scene = good;
    scene.replace(begin, length, "floor.bin");
    std::ofstream(folder / "floor.gltf") << scene;
    const pid_t process = start({"render", "floor.gltf", "--fixed", "--photons", "1000", "--passes", "1", "--watch"});
    EXPECT_TRUE(waitFor([&] { return renders() == 1; })) << readText(root / "stderr");
    std::ofstream(folder / "floor.bin") << "cut off";
    EXPECT_TRUE(waitFor([&] { return readText(root / "stderr").find("floor.gltf: ") != std::string::npos; }));
    std::ofstream(folder / "floor.gltf") << good;
    EXPECT_TRUE(waitFor([&] { return renders() == 2; }));
    kill(process, SIGINT);
    EXPECT_EQ(end(process).exitCode, 0);
}

TEST_F(WatchTest, GivesUpARenderWhoseSceneChanges) {
    const pid_t process =
        start({"render", "whole.xml", "--fixed", "--time", "500", "-o", "{scene}.exr", "--watch", "--json"});
    std::this_thread::sleep_for(std::chrono::seconds(3)); // into the render, as a rule
    save("bad");
    EXPECT_TRUE(waitFor([&] { return readText(root / "stderr").find("part.xml:1:") != std::string::npos; }));
    EXPECT_FALSE(fs::exists(folder / "whole.exr")) << "of an older scene";
    kill(process, SIGTERM);
    EXPECT_EQ(end(process).exitCode, 143);
}

TEST(ProgressLines, FollowEachOtherWhereThereIsNoTerminal) {
    std::FILE* file = std::tmpfile();
    ASSERT_NE(file, nullptr);
    {
        ProgressLine line(file, true, "box (1 of 2): ", std::chrono::milliseconds(30)), silent(file, false);
        line.update({.phase = "loading"});
        std::this_thread::sleep_for(std::chrono::milliseconds(40));
        for (int k = 0; k < 3; ++k) line.update({.phase = "rendering", .passes = 2, .secondsLeft = 24});
        silent.update({.phase = "silent"});
    }
    std::rewind(file);
    std::array<char, 256> text{};
    const size_t size = std::fread(text.data(), 1, text.size(), file);
    std::fclose(file);
    EXPECT_EQ(std::string(text.data(), size), "quasilux: box (1 of 2): rendering: pass 2, 0:24 left\n");
}

TEST_F(HabitsTest, PictureIsShownOnATerminalAlone) {
    const std::vector<std::string> line{"render", "a.xml", "--fixed", "--passes", "1", "--show", "kitty"};
    EXPECT_THAT(runOnTerminal(line).output, HasSubstr("\033_Ga=T,f=100"));
    const Outcome piped = run(line);
    EXPECT_EQ(piped.exitCode, 0);
    EXPECT_THAT(piped.output, Not(HasSubstr("\033")));
    EXPECT_THAT(piped.errors, HasSubstr("stdout is no terminal"));
    expectRefused({"render", "a.xml", "--show", "png"}, "expected sixel or kitty");
}

TEST_F(HabitsTest, ColourIsOfTerminalsThatWantIt) {
    setenv("TERM", "xterm", 1);
    const std::vector<std::string> line{"render", "gone.xml"};
    EXPECT_THAT(runOnTerminal(line).output, HasSubstr("quasilux: \033[1;31merror:\033[0m "));
    EXPECT_THAT(run(line).errors, HasSubstr("quasilux: error: "));
    setenv("NO_COLOR", "1", 1);
    EXPECT_THAT(runOnTerminal(line).output, HasSubstr("quasilux: error: "));
}

} // namespace
} // namespace quasilux

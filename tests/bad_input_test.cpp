// Bad input to the whole program: exit code 2, a message at the file and line that says what was expected, nothing
// written. What each message says in full is tested in scene_errors_test and mesh_errors_test; here the way from there
// to the user.
#include "support/program_runner.h"

#include <fstream>

namespace quasilux {
namespace {

class BadInput : public CommandLineTest {
protected:
    /// A scene of which `change` replaces the piece of the same kind.
    void expectSceneRefused(const std::string& shapes, const std::string& message, bool withSensor = true) const {
        std::ofstream scene(folder / "bad.xml");
        scene << "<scene version=\"3.0.0\">\n"; // line 1
        scene << (withSensor ? "<sensor type=\"perspective\"><float name=\"fov\" value=\"40\"/></sensor>\n"
                             : "\n"); // line 2
        scene << shapes;              // from line 3
        scene << "\n</scene>\n";
        scene.close();
        expectRefused(
            {"render", "bad.xml", "-o", "out.exr", "--png", "out.png", "--stats", "out.json", "--passes", "1"},
            message);
    }

    static constexpr const char* light =
        "<shape type=\"rectangle\"><emitter type=\"area\"><rgb name=\"radiance\" value=\"1\"/></emitter></shape>\n";
};

TEST_F(BadInput, MissingFile) { expectRefused({"render", "nowhere.xml"}, "nowhere.xml"); }

TEST_F(BadInput, MalformedXml) { expectSceneRefused("<shape type=\"rectangle\"", "bad.xml:"); }

TEST_F(BadInput, UnknownPlugin) {
    expectSceneRefused(std::string(light) + "<bsdf type=\"difuse\" id=\"a\"/>", "bad.xml:4:");
    expectSceneRefused(std::string(light) + "<bsdf type=\"difuse\" id=\"a\"/>", "diffuse");
}

TEST_F(BadInput, WrongType) {
    expectSceneRefused(std::string(light) + "<shape type=\"sphere\"><string name=\"radius\" value=\"1\"/></shape>",
                       "bad.xml:4:");
}

TEST_F(BadInput, NotANumberInATransform) {
    expectSceneRefused(
        std::string(light) +
            "<shape type=\"cube\">\n<transform name=\"to_world\"><translate x=\"nan\"/></transform></shape>",
        "bad.xml:5:");
}

TEST_F(BadInput, EmitterWithoutArea) {
    expectSceneRefused("<shape type=\"rectangle\"><transform name=\"to_world\"><scale x=\"0\"/></transform>"
                       "<emitter type=\"area\"><rgb name=\"radiance\" value=\"1\"/></emitter></shape>",
                       "bad.xml:3:");
    std::ofstream(folder / "flat.obj") << "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n";
    expectSceneRefused("<shape type=\"obj\"><string name=\"filename\" value=\"flat.obj\"/>"
                       "<emitter type=\"area\"><rgb name=\"radiance\" value=\"1\"/></emitter></shape>",
                       "area");
}

TEST_F(BadInput, MeshWithBadIndices) {
    std::ofstream(folder / "bad.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n";
    expectSceneRefused(std::string(light) + "<shape type=\"obj\"><string name=\"filename\" value=\"bad.obj\"/></shape>",
                       "bad.obj:4");
}

TEST_F(BadInput, NoSensor) { expectSceneRefused(light, "sensor", false); }

TEST_F(BadInput, OutputFolderMissing) {
    expectRefused({"render", "scene.xml", "-o", "no/such/folder/out.exr"}, "no/such/folder");
}

TEST_F(BadInput, UnknownQuasiSpecularId) {
    expectRefused({"render", "scene.xml", "--quasi-specular", "glossy"}, "glossy");
}

TEST_F(BadInput, ParameterGivenTwice) {
    expectRefused({"render", "scene.xml", "-D", "width=1", "-D", "width=2"}, "'width' is given twice");
}

// Negative control: the same scene without a fault is rendered.
TEST_F(BadInput, AGoodSceneIsNotRefused) {
    const auto outcome = run({"render", "scene.xml", "-o", "out.exr", "--passes", "1"});
    EXPECT_EQ(outcome.exitCode, 0) << outcome.errors;
    EXPECT_TRUE(std::filesystem::exists(folder / "out.exr"));
}

} // namespace
} // namespace quasilux

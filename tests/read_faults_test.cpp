// Each opening and each reading of each kind of file that a scene may name fails once (shims/failing_calls.cpp): the file is named, and none is
// taken for what could be read of it. The device has no room for either scene, so that they end when all is read, and nothing is compiled.
#include "support/gltf_files.h"
#include "support/luminaire_files.h"
#include "support/program_runner.h"

#include <fstream>
#include <gmock/gmock.h>
#include <set>

namespace quasilux {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr const char* withAllKinds = R"(<scene version="3.0.0">
<include filename="part.xml"/>
<sensor type="perspective"><film type="hdrfilm"><integer name="width" value="4"/><integer name="height" value="4"/></film></sensor>
<shape type="ply"><string name="filename" value="tetrahedron.ply"/></shape>
<shape type="serialized"><string name="filename" value="triangle.serialized"/></shape>
<shape type="bsplinecurve"><string name="filename" value="hair.txt"/></shape>
<shape type="rectangle"><bsdf type="diffuse"><texture type="bitmap" name="reflectance"><string name="filename" value="plain.png"/></texture>
</bsdf></shape>
<shape type="rectangle"><bsdf type="diffuse"><texture type="bitmap" name="reflectance"><string name="filename" value="plain.hdr"/></texture>
</bsdf></shape>
<shape type="rectangle"><bsdf type="diffuse"><spectrum name="reflectance" filename="leaf.spd"/></bsdf></shape>
<shape type="sphere"><bsdf type="null"/><medium name="interior" type="heterogeneous"><float name="albedo" value="0.5"/>
<volume name="sigma_t" type="gridvolume"><string name="filename" value="small.vol"/></volume></medium></shape>
<emitter type="quasilux_ies"><string name="filename" value="lamp.ies"/></emitter>
<emitter type="quasilux_ies"><string name="filename" value="panel.ldt"/></emitter>
<emitter type="quasilux_perez_sky"><string name="weather" value="summer.epw"/><integer name="month" value="6"/>
<integer name="day" value="21"/><integer name="hour" value="12"/></emitter>
</scene>
)";

class ReadFaultsTest : public CommandLineTest {
protected:
    void write(const std::string& name, const std::string& content) {
        std::ofstream(folder / name, std::ios::binary) << content;
        files_.insert(name);
    }
    /// Files of tests/.
    void take(const std::vector<std::string>& names) {
        for (const std::string& name : names) {
            const fs::path from = fs::path(QUASILUX_SOURCE_DIR) / "tests" / name;
            fs::copy_file(from, folder / from.filename());
            files_.insert(from.filename());
        }
    }
    /// The seed of an image, without the letter before it that says what is asked of it.
    void takeImage(const std::string& name) {
        write(name, readText(fs::path(QUASILUX_SOURCE_DIR) / "tests/fuzz/seeds/image" / name).substr(1));
    }

    Outcome runFailing(const Variables& variables) const {
        return runWith(QUASILUX_FAILING_CALLS, {"render", scene_, "--fixed", "--device-memory", "1000", "-o", "a.exr"},
                       variables);
    }

    std::map<std::string, unsigned> countCalls() const {
        const fs::path file = root / "counts";
        const Outcome outcome = runFailing({{"QUASILUX_COUNT_CALLS", file.string()}});
        EXPECT_EQ(outcome.exitCode, 2);
        EXPECT_THAT(outcome.errors, HasSubstr("in one buffer")) << "control: all has been read";
        std::map<std::string, unsigned> counts;
        std::ifstream stream(file);
        std::string name;
        for (unsigned count = 0; stream >> name >> count;) counts[name] = count;
        return counts;
    }

    std::string fileIn(const std::string& errors) const {
        for (const std::string& file : files_)
            if (errors.find('\'' + file) != std::string::npos || errors.find('/' + file) != std::string::npos)
                return file;
        return "";
    }

    void expectAllAreNamed() {
        std::set<std::string> named;
        const auto counts = countCalls();
        for (const char* const call : {"fopen", "read", "fread"})
            for (unsigned at = 1; at <= counts.at(call); ++at) {
                SCOPED_TRACE(fmt::format("{}, call {}", call, at));
                const Outcome outcome =
                    runFailing({{"QUASILUX_FAIL_CALL", call}, {"QUASILUX_FAIL_AT", std::to_string(at)}});
                EXPECT_EQ(outcome.exitCode, 2);
                EXPECT_NE(fileIn(outcome.errors), "") << outcome.errors;
                named.insert(fileIn(outcome.errors));
            }
        EXPECT_EQ(named, files_);
    }

    std::string scene_;
    std::set<std::string> files_; ///< that it is read from
};

TEST_F(ReadFaultsTest, OfAScene) {
    take({"data/quads.obj", "data/tetrahedron.ply", "data/triangle.serialized", "data/leaf.spd",
          "fuzz/seeds/vol/small.vol", "fuzz/seeds/eulumdat/panel.ldt", "fuzz/seeds/weather/summer.epw"});
    takeImage("plain.png");
    takeImage("plain.hdr");
    write("hair.txt", "0 0 0 0.1\n1 0 0 0.1\n2 1 0 0.1\n3 1 0 0.1\n");
    write("part.xml",
          R"(<scene version="3.0.0"><shape type="obj"><string name="filename" value="quads.obj"/></shape></scene>)");
    test::IesText lamp;
    lamp.tilt = "lamp.tlt\n";
    write("lamp.ies", lamp.text());
    write("lamp.tlt", "1\n2\n0 90\n1 0.9\n");
    write("scene.xml", withAllKinds);
    scene_ = "scene.xml";
    expectAllAreNamed();
}

TEST_F(ReadFaultsTest, OfAModel) {
    takeImage("plain.png");
    test::GltfFile model;
    model.add("images", {{"uri", "plain.png"}});
    model.add("textures", {{"source", 0}});
    model.add("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
    model.addNode({{"mesh", model.addSquare({{"material", 0}})}});
    model.addLight({{"type", "point"}});
    write("plain.bin", model.buffer());
    write("scene.gltf", model.text("plain.bin"));
    scene_ = "scene.gltf";
    expectAllAreNamed();
}

} // namespace
} // namespace quasilux

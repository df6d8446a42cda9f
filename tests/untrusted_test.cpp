// Scenes of others (`--untrusted`): no file outside of their folder, and limits on what they take while they are
// loaded. Hostile ones are refused at file:line:column, with the limit and what to do.
#include "support/program_runner.h"
#include "support/scene_files.h"
#include "support/vol_files.h"

#include "scene/load_guard.h"
#include "util/process_memory.h"

#include <OpenImageIO/imageio.h>
#include <cerrno>
#include <chrono>
#include <fmt/format.h>
#include <sys/stat.h>
#include <system_error>

namespace quasilux {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

class Untrusted : public testing::Test {
protected:
    Untrusted() {
        fs::create_directories(inside);
        fs::create_directories(root.path() / "outside");
        put("outside/secret.obj", triangle);
        put("outside/part.xml", "<scene version=\"3.0.0\"><shape type=\"cube\"/></scene>");
        put("scene/near.obj", triangle);
    }

    void put(const std::string& name, const std::string& content) const {
        std::ofstream(root.path() / name, std::ios::binary) << content;
    }
    /// The message, or empty where the scene is loaded; `body` is in line 4.
    std::string load(const std::string& body, const LoadLimits& limits = {}) const {
        put("scene/scene.xml", test::sceneWith(body));
        return refusal([&] {
                   loadScene((inside / "scene.xml").string(), {}, {{}, Unknown::refused, limits});
               })
            .value_or("");
    }
    static std::string obj(const std::string& file) {
        return "<shape type=\"obj\"><string name=\"filename\" value=\"" + file + "\"/></shape>";
    }
    static std::string include(const std::string& file) { return "<include filename=\"" + file + "\"/>"; }
    /// A limit is named, the place, and what to do.
    static auto names(const std::string& place, const std::string& limit) {
        return AllOf(HasSubstr(place + ": more than "), HasSubstr("--limit " + limit + "=N"),
                     HasSubstr("leave out --untrusted"));
    }
    template <typename Change>
    static LoadLimits limitedTo(const Change& change) {
        LoadLimits limits;
        change(limits);
        return limits;
    }

    static constexpr const char* triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    TemporaryFolder root;
    fs::path inside = root.path() / "scene";
};

TEST_F(Untrusted, PlainScenesAreLoaded) {
    put("scene/part.xml", "<scene version=\"3.0.0\"><path value=\".\"/><shape type=\"cube\"/></scene>");
    EXPECT_EQ(load(obj("near.obj") + include("part.xml")), "");
    EXPECT_EQ(load("<path value=\".\"/>" + obj("../scene/near.obj")), ""); // out of it, and in again
}

TEST_F(Untrusted, FilesOutsideAreRefused) {
    const std::string absolute = (root.path() / "outside").string();
    fs::create_symlink("../outside/secret.obj", inside / "link.obj");
    fs::create_symlink("../outside", inside / "folder");
    put("scene/luminaire.ies", "IESNA91\nTILT=../outside/secret.obj\n1 1000 1 2 1 1 2 0 0 0\n1 1 50\n0 90\n0\n10 20\n");
    const std::string luminaire =
        "<emitter type=\"quasilux_ies\"><string name=\"filename\" value=\"luminaire.ies\"/></emitter>";
    const std::vector<std::pair<std::string, std::string>> hostile{
        {obj("../outside/secret.obj"), "scene.xml:4:19"},
        {obj(absolute + "/secret.obj"), "scene.xml:4:19"},
        {obj("link.obj"), "scene.xml:4:19"},
        {obj("folder/secret.obj"), "scene.xml:4:19"},
        {obj("../../../../../../../../etc/passwd"), "scene.xml:4:19"},
        {obj("../scene-2/near.obj"), "scene.xml:4:19"}, // a folder whose name begins alike
        {include("../outside/part.xml"), "scene.xml:4:1"},
        {"<path value=\"../outside\"/>" + obj("secret.obj"), "scene.xml:4:1"},
        {"<path value=\"/\"/>", "scene.xml:4:1"},
        {luminaire, "luminaire.ies:2"}};
    for (const auto& [body, place] : hostile)
        EXPECT_THAT(load(body), AllOf(HasSubstr(place), HasSubstr("lies outside of the scene's folder"),
                                      HasSubstr("--allow-outside")))
            << body;
    // Controls: with leave, and where the scene is trusted.
    const auto leave = limitedTo([](LoadLimits& limits) { limits.staysInside = false; });
    for (const char* file : {"../outside/secret.obj", "link.obj"}) {
        EXPECT_EQ(load(obj(file), leave), "");
        EXPECT_EQ(loadScene((inside / "scene.xml").string()).shapes.size(), 1u);
    }
}

// A pipe would wait for ever, a device has no end.
TEST_F(Untrusted, PipesAndDevicesAreRefusedInAnyScene) {
    ASSERT_EQ(mkfifo((inside / "pipe.obj").c_str(), 0600), 0);
    const auto leave = limitedTo([](LoadLimits& limits) { limits.staysInside = false; });
    for (const std::string file : {"pipe.obj", "/dev/zero", "/dev/stdin", "."}) {
        const auto refused = AllOf(HasSubstr("scene.xml:4:19: cannot read the mesh file"),
                                   HasSubstr(file == "." ? "it is a folder" : "no plain file"));
        EXPECT_THAT(load(obj(file), leave), refused);
        EXPECT_THAT(test::errorOf((inside / "scene.xml").string()), refused);
    }
}

// "Billion laughs": each file includes the next ten times.
TEST_F(Untrusted, IncludesThatMultiplyAreRefused) {
    const auto file = [](const std::string& each) {
        std::string content = "<scene version=\"3.0.0\">";
        for (unsigned k = 0; k < 10; ++k) content += each;
        return content + "</scene>";
    };
    for (unsigned k = 1; k < 6; ++k)
        put(fmt::format("scene/laugh{}.xml", k), file(include(fmt::format("laugh{}.xml", k + 1))));
    put("scene/laugh6.xml", file("<shape type=\"cube\"/>"));
    const auto start = std::chrono::steady_clock::now();
    EXPECT_THAT(load(include("laugh1.xml"), limitedTo([](LoadLimits& limits) { limits.elements = 20000; })),
                names("laugh6.xml:1:124", "elements"));
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
}

TEST_F(Untrusted, DeepIncludesAreRefused) {
    constexpr unsigned deep = 80;
    for (unsigned k = 1; k < deep; ++k)
        put(fmt::format("scene/deep{}.xml", k),
            "<scene version=\"3.0.0\">" + include(fmt::format("deep{}.xml", k + 1)) + "</scene>");
    put(fmt::format("scene/deep{}.xml", deep), "<shape type=\"cube\"/>");
    EXPECT_THAT(load(include("deep1.xml")), names("deep7.xml:1:24", "nesting"));
    EXPECT_THAT(test::errorOf((inside / "scene.xml").string()),
                HasSubstr("more than 64 files that include each other"));
    // Elements within elements, over several files: the stack has an end for scenes that are trusted, too.
    const auto nested = [](unsigned count, const std::string& within) {
        std::string content;
        for (unsigned k = 0; k < count; ++k) content += "<bsdf type=\"twosided\">";
        content += within;
        for (unsigned k = 0; k < count; ++k) content += "</bsdf>";
        return content;
    };
    put("scene/inner.xml", nested(40, "<bsdf type=\"diffuse\"/>"));
    load(nested(40, include("inner.xml")));
    EXPECT_THAT(test::errorOf((inside / "scene.xml").string()), HasSubstr("inner.xml:1:"));
}

// What refers twice to what refers twice to …, and long chains, in scenes that are trusted, too.
TEST_F(Untrusted, ReferencesThatMultiplyAreRefused) {
    const auto chain = [](unsigned length, const std::string& type, bool twice) {
        std::string body = "<bsdf type=\"null\" id=\"b0\"/>\n";
        for (unsigned k = 1; k <= length; ++k) {
            const std::string reference = fmt::format("<ref id=\"b{}\"/>", k - 1);
            body +=
                fmt::format("<bsdf type=\"{}\" id=\"b{}\">{}{}</bsdf>\n", type, k, reference, twice ? reference : "");
        }
        return body + fmt::format("<shape type=\"cube\"><ref id=\"b{}\"/></shape>", length);
    };
    const auto both = [&](const std::string& body, const std::string& message) {
        EXPECT_THAT(load(body), HasSubstr(message));
        EXPECT_THAT(test::errorOf((inside / "scene.xml").string()), HasSubstr(message));
    };
    both(chain(60, "blendbsdf", true), "objects within others come to more than 1000000");
    both(chain(20000, "mask", false), "lies within more than 64 others");
    EXPECT_EQ(load(chain(8, "blendbsdf", true)), ""); // control
    // Long names are compared with no others, and quoted in part.
    const std::string name(60000, 'a');
    const std::string error =
        load("<bsdf type=\"diffuse\" id=\"" + name + "b\"/><shape type=\"cube\"><ref id=\"" + name + "\"/></shape>");
    EXPECT_THAT(error, HasSubstr("no object has the id"));
    EXPECT_LT(error.size(), 10000u);
}

TEST_F(Untrusted, LimitsAreNamed) {
    const auto files = limitedTo([](LoadLimits& limits) { limits.files = 2; });
    put("scene/other.obj", triangle);
    EXPECT_EQ(load(obj("near.obj") + obj("near.obj"), files), ""); // and the scene itself
    EXPECT_THAT(load(obj("near.obj") + "\n" + obj("other.obj"), files), names("scene.xml:5:19", "files"));
    put("scene/large.obj", std::string((2 << 20) + 1, '#') + '\n' + triangle);
    EXPECT_THAT(load(obj("large.obj"), limitedTo([](LoadLimits& limits) { limits.mebibytes = 2; })),
                names("scene.xml:4:19", "mebibytes"));
    put("scene/plain.pfm", "PF\n2 1\n-1.0\n" + std::string(24, '\0'));
    const std::string texture =
        "<texture type=\"bitmap\" id=\"t\"><string name=\"filename\" value=\"plain.pfm\"/></texture>";
    EXPECT_EQ(load(texture), "");
    EXPECT_THAT(load(texture, limitedTo([](LoadLimits& limits) { limits.pixels = 1; })),
                names("scene.xml:4:31", "pixels"));
    EXPECT_THAT(load(texture, limitedTo([](LoadLimits& limits) { limits.seconds = 0; })),
                HasSubstr("--limit seconds=N"));
}

// Where a scene cannot be read about the origin of its file it is read about its sensor; one that is refused is not,
// and one whose sensor is far off counts each image once.
TEST_F(Untrusted, LimitsHoldWhereTheSensorIsFarOff) {
    const auto loadFrom = [&](const std::string& x, const std::string& body, const LoadLimits& limits) {
        put("scene/scene.xml", "<scene version=\"3.0.0\"><sensor type=\"perspective\"><transform name=\"to_world\">"
                               "<translate x=\"" +
                                   x + "\"/></transform></sensor><emitter type=\"point\"/>\n" + body + "</scene>");
        return refusal([&] {
                   loadScene((inside / "scene.xml").string(), {}, {{}, Unknown::refused, limits});
               })
            .value_or("");
    };
    put("scene/large.obj", std::string((2 << 20) + 1, '#') + '\n' + triangle);
    for (const char* x : {"0", "5"}) {
        EXPECT_THAT(loadFrom(x, obj("large.obj"), limitedTo([](LoadLimits& limits) { limits.mebibytes = 2; })),
                    names("scene.xml:2:19", "mebibytes"));
        EXPECT_THAT(loadFrom(x, obj("near.obj"), limitedTo([](LoadLimits& limits) { limits.files = 1; })),
                    names("scene.xml:2:19", "files"));
    }
    put("scene/plain.pfm", "PF\n2 1\n-1.0\n" + std::string(24, '\0'));
    const std::string textured =
        "<shape type=\"rectangle\"><bsdf type=\"diffuse\"><texture type=\"bitmap\" name=\"reflectance\">"
        "<string name=\"filename\" value=\"plain.pfm\"/></texture></bsdf></shape>";
    for (const char* x : {"0", "100000"})
        EXPECT_EQ(loadFrom(x, textured, limitedTo([](LoadLimits& limits) { limits.pixels = 2; })), "") << x;
}

// A file of a thousandth of what it says it holds.
TEST_F(Untrusted, MemoryIsLimited) {
    if (dataBytes() == 0) GTEST_SKIP() << "the system has no such limit";
    std::string lines;
    for (unsigned k = 0; k < 300000; ++k) lines += "v 0 0 1\n";
    put("scene/many.obj", lines + triangle);
    // First, as memory that is free again would be taken once more.
    EXPECT_THAT(load(obj("many.obj"), limitedTo([](LoadLimits& limits) { limits.memory = 4; })),
                names("scene.xml:4:19", "memory"));
    EXPECT_EQ(load(obj("many.obj")), ""); // the limit is gone
}

TEST_F(Untrusted, MemoryOfImagesIsLimited) {
    if (dataBytes() == 0) GTEST_SKIP() << "the system has no such limit";
    const OIIO::ImageSpec spec(4096, 2048, 3, OIIO::TypeDesc::HALF);
    const std::vector<float> black(spec.image_pixels() * 3);
    const auto threads = OIIO::get_int_attribute("exr_threads");
    OIIO::attribute("exr_threads", -1); // a pool of them would be known from then on
    const auto image = OIIO::ImageOutput::create("a.exr");
    ASSERT_TRUE(image->open((inside / "black.exr").string(), spec) &&
                image->write_image(OIIO::TypeDesc::FLOAT, black.data()) && image->close());
    OIIO::attribute("exr_threads", threads);
    const std::string texture = "<shape type=\"rectangle\"><bsdf type=\"diffuse\"><texture type=\"bitmap\" "
                                "name=\"reflectance\">\n<string name=\"filename\" value=\"black.exr\"/></texture>"
                                "</bsdf></shape>";
    for (const unsigned mebibytes : {1, 2, 4, 8, 12, 16, 18, 19, 20, 22, 24, 32, 64})
        EXPECT_THAT(load(texture, limitedTo([&](LoadLimits& limits) { limits.memory = mebibytes; })),
                    names("scene.xml:5:1", "memory"))
            << mebibytes;
    EXPECT_EQ(load(texture), "");
    EXPECT_EQ(OIIO::get_int_attribute("exr_threads"), threads);
}

// Of what is thrown where memory is short, and otherwise.
TEST_F(Untrusted, LackOfMemoryIsToldFromOtherErrors) {
    LoadGuard guard("scene.xml", LoadLimits{});
    const auto message = [&](const std::function<void()>& work) {
        return refusal([&] { guard.withinMemory(work); }).value_or("");
    };
    const auto limited = names("scene.xml", "memory");
    using std::errc;
    const auto fail = [](errc code) { return [=] { throw std::system_error(std::make_error_code(code)); }; };
    EXPECT_THAT(message(fail(errc::resource_unavailable_try_again)), limited); // no thread can be begun
    EXPECT_THROW(message(fail(errc::no_such_file_or_directory)), std::system_error);
    const auto damaged = [] { throw InputError("the image is damaged"); };
    EXPECT_EQ(message(damaged), "the image is damaged");
    EXPECT_THAT(message([&] {
                    errno = ENOMEM; // as malloc leaves it
                    damaged();
                }),
                limited);
}

// 10⁵ of each in a file of 2 MB: each compared with all before it, they took 15 s and more.
TEST_F(Untrusted, ManyNamesTakeNoLongTime) {
    std::string keys, properties, values;
    for (unsigned k = 0; k < 100000; ++k) {
        keys += fmt::format(" a{}=\"1\"", k);
        properties += fmt::format("property float a{}_x\n", k);
        values += " 0";
    }
    const auto start = std::chrono::steady_clock::now();
    EXPECT_THAT(load("<?quasilux" + keys + "?>"), HasSubstr("unknown key 'a0'"));
    put("scene/many.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty "
                          "float z\n" +
                              properties + "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0" +
                              values + "\n1 0 0" + values + "\n0 1 0" + values + "\n3 0 1 2\n");
    EXPECT_EQ(load("<shape type=\"ply\"><string name=\"filename\" value=\"many.ply\"/></shape>"), "");
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5));
}

// Headers that promise a billion of something.
TEST_F(Untrusted, HeadersAreNotBelieved) {
    put("scene/huge.ply", "ply\nformat ascii 1.0\nelement vertex 1000000000\nproperty float x\nproperty float "
                          "y\nproperty float z\nelement face 1000000000\nproperty list uchar int "
                          "vertex_indices\nend_header\n0 0 0\n");
    put("scene/huge.vol", test::volFile({65535, 65535, 65535}, 3, {0}));
    put("scene/huge.pfm", "PF\n1000000000 1000000000\n-1.0\n");
    put("scene/wide.pfm", "PF\n8000 8000\n-1.0\n");
    const std::string volume =
        "<volume type=\"gridvolume\" id=\"v\"><string name=\"filename\" value=\"huge.vol\"/></volume>";
    const auto texture = [](const std::string& file) {
        return "<texture type=\"bitmap\" id=\"t\"><string name=\"filename\" value=\"" + file + "\"/></texture>";
    };
    const std::vector<std::pair<std::string, std::string>> cases{
        {"<shape type=\"ply\"><string name=\"filename\" value=\"huge.ply\"/></shape>", "huge.ply:"},
        {volume, "huge.vol"},
        {texture("huge.pfm"), "huge.pfm"},
        {texture("wide.pfm"), "wide.pfm"}};
    for (const auto& [body, file] : cases) {
        EXPECT_THAT(load(body), HasSubstr(file));
        EXPECT_THAT(test::errorOf((inside / "scene.xml").string()), HasSubstr(file)); // trusted
    }
    // Nothing is taken for the 768 MB that it promises.
    EXPECT_THAT(load(texture("wide.pfm"), limitedTo([](LoadLimits& limits) { limits.memory = 128; })),
                HasSubstr("it ends before its last row"));
}

// Formats whose readers might follow to other files.
TEST_F(Untrusted, ImagesAreOfPlainFormats) {
    put("scene/film.avi", "RIFF");
    EXPECT_THAT(load("<texture type=\"bitmap\" id=\"t\"><string name=\"filename\" value=\"film.avi\"/></texture>"),
                AllOf(HasSubstr("scene.xml:4:31"), HasSubstr(".exr")));
}

class UntrustedCommand : public CommandLineTest {};

TEST_F(UntrustedCommand, EndsWithTwo) {
    std::ofstream(root / "outside.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    std::ofstream(folder / "hostile.xml")
        << test::sceneWith(R"(<shape type="obj"><string name="filename" value="../outside.obj"/></shape>)");
    for (const char* command : {"render", "info"}) {
        expectRefused({command, "hostile.xml", "--untrusted"}, "hostile.xml:4:19: '");
        expectRefused({command, "hostile.xml", "--untrusted", "--allow-outside", "--limit", "files=1"},
                      "--limit files=N with a larger N");
    }
    expectRefused({"render", "hostile.xml", "--allow-outside"}, "--allow-outside requires --untrusted");
    expectRefused({"render", "hostile.xml", "--untrusted", "--limit", "fils=3"}, "did you mean 'files'");
    expectRefused({"render", "hostile.xml", "--untrusted", "--limit", "files=0"}, "a whole number from 1");
    const Outcome outcome = run({"render", "hostile.xml", "--untrusted", "--allow-outside", "-o", "a.exr", "--passes",
                                 "1", "--limit", "files=2", "--limit", "seconds=50", "-D", "none=1"});
    EXPECT_EQ(outcome.exitCode, 2); // of the definition alone
    EXPECT_THAT(outcome.errors, HasSubstr("parameter 'none' is not used"));
}

} // namespace
} // namespace quasilux

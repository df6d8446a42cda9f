// Scene files that are refused as a whole: missing, empty, of another kind, too deep, too large.
#include "support/scene_files.h"

#include <gmock/gmock.h>

namespace quasilux {
namespace {

using test::errorOf;
using test::SceneFiles;
using test::sceneWith;

struct BadFile {
    const char* name;
    const char* content;
    const char* expected;
};
void PrintTo(const BadFile& bad, std::ostream* out) { *out << bad.content; }

class BadSceneFile : public testing::TestWithParam<BadFile> {};

TEST_P(BadSceneFile, IsRefused) {
    SceneFiles files;
    EXPECT_THAT(errorOf(files.write("scene.xml", GetParam().content)), testing::HasSubstr(GetParam().expected));
}

const BadFile badFiles[] = {
    {"Empty", "", "malformed XML"},
    {"NoEndTag", "<scene version=\"3.0.0\">\n<!-- </x> --><shape name='>'/>\n<a><b>\n</a></scene>",
     "scene.xml:4:1: malformed XML: </a> where <b> of line 3 is open; expected </b> first."},
    {"ByteOrderMark", "\xef\xbb\xbf<scene version=\"3.0.0\"><a><b></a></scene>",
     "scene.xml:1:30: malformed XML: </a> where <b> of line 1 is open; expected </b> first."},
    {"NoLastEndTag", "<scene version=\"3.0.0\">\n<a></a>\n",
     "scene.xml:3:1: malformed XML: the file ends, but <scene> of line 1 has no end; expected </scene>."},
    {"EndTagTooMany", "<scene version=\"3.0.0\"></scene\n>\n</scene>",
     "scene.xml:3:1: malformed XML: </scene> ends nothing; remove it."},
    {"QuoteNotClosed", "<scene version=\"3.0.0\">\n<a b=\"1></a></scene>", "malformed XML: Error parsing"},
    {"NoSensor", "<scene version=\"3.0.0\"><emitter type=\"point\"/></scene>", "scene.xml: the scene has no <sensor>"},
    {"NoVersion", "<scene/>", "scene.xml:1:1: <scene> needs the attribute 'version'"},
    {"BadVersion", "<scene version=\"three\"/>", "scene.xml:1:1: version 'three' is not a version"},
    {"OtherRoot", "<bsdf type=\"diffuse\"/>", "scene.xml:1:1: the outermost element is <bsdf>"},
    {"TwoRoots", "<scene version=\"3.0.0\"/>\n<scene version=\"3.0.0\"/>", "scene.xml:2:1: a second outermost element"},
    {"InstructionOutside", "<?quasilux bdd=\"1\"?><scene version=\"3.0.0\"/>",
     "scene.xml:1:1: <?quasilux?> outside of the scene"},
};
INSTANTIATE_TEST_SUITE_P(Files, BadSceneFile, testing::ValuesIn(badFiles),
                         [](const auto& row) { return std::string(row.param.name); });

TEST(MissingScene, IsNamed) {
    EXPECT_THAT(errorOf("/nonexistent/scene.xml"),
                testing::HasSubstr("cannot read the scene file '/nonexistent/scene.xml'"));
}

TEST(FolderAsScene, IsRefused) { EXPECT_THAT(errorOf("/"), testing::HasSubstr("cannot read the scene file")); }

TEST(UnusedOption, IsRefusedWithTheNearestName) {
    SceneFiles files;
    const std::string path = files.write("scene.xml", sceneWith("<default name=\"size\" value=\"1\"/>"));
    EXPECT_THAT(errorOf(path, {{"siez", "2"}}),
                testing::HasSubstr("parameter 'siez' is not used by the scene. Did you mean 'size'?"));
}

TEST(ErrorInAnIncludedFile, NamesThatFile) {
    SceneFiles files;
    files.write("part.xml", "<scene version=\"3.0.0\">\n  <shape type=\"cone\"/></scene>");
    EXPECT_THAT(errorOf(files.write("scene.xml", sceneWith("<include filename=\"part.xml\"/>"))),
                testing::HasSubstr("part.xml:2:3: unknown shape plugin 'cone'"));
}

TEST(DeepNesting, IsRefusedInsteadOfACrash) {
    std::string body;
    for (int i = 0; i < 100000; ++i) body += "<bsdf type=\"twosided\">";
    for (int i = 0; i < 100000; ++i) body += "</bsdf>";
    SceneFiles files;
    EXPECT_THAT(errorOf(files.write("scene.xml", sceneWith(body))),
                testing::HasSubstr("elements nested deeper than 64"));
}

TEST(DoublingDefinitions, AreRefusedInsteadOfFillingTheMemory) {
    std::string values = "<default name=\"a0\" value=\"xx\"/>", blends = "<bsdf type=\"diffuse\" id=\"b0\"/>";
    for (int i = 1; i < 60; ++i) {
        const std::string before = std::to_string(i - 1), now = std::to_string(i),
                          ref = "<ref id=\"b" + before + "\"/>";
        values += "<default name=\"a" + now + "\" value=\"$a" + before + "$a" + before + "\"/>";
        blends += "<bsdf type=\"blendbsdf\" id=\"b" + now + "\">" + ref + ref + "</bsdf>";
    }
    SceneFiles files;
    EXPECT_THAT(errorOf(files.write("values.xml", sceneWith(values))),
                testing::HasSubstr("a value grows to more than"));
    EXPECT_THAT(errorOf(files.write("blends.xml", sceneWith(blends))), testing::HasSubstr("more than 32 lobes"));
}

} // namespace
} // namespace quasilux

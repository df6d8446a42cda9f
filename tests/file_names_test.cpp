// Names of files by pattern.
#include "cli/file_names.h"
#include "support/scene_files.h"
#include "util/error.h"

#include <gmock/gmock.h>

namespace quasilux {
namespace {

using testing::HasSubstr;

TEST(FileNames, AreFilledInSteps) {
    const std::string pattern = "out/{scene}_{sensor}_{seed}_{passes}.exr";
    const std::string early = fillName(pattern, {{"scene", "a/b"}, {"sensor", "1"}});
    EXPECT_EQ(early, "out/a_b_1_{seed}_{passes}.exr");
    EXPECT_EQ(fillName(early, namePartsOf(7, 42)), "out/a_b_1_7_42.exr");
    EXPECT_THAT(namePartsOf("x/box.xml").at("date"), testing::MatchesRegex("20[0-9][0-9]-[01][0-9]-[0-3][0-9]"));
    EXPECT_EQ(namePartsOf("x/box.xml").at("scene"), "box");
}

TEST(FileNames, WithoutAFolderGoIntoTheOneGiven) {
    const test::SceneFiles files;
    const std::string folder = files.path("");
    EXPECT_EQ(inFolder(folder, "a.exr"), files.path("a.exr"));
    EXPECT_EQ(inFolder(folder, "b/a.exr"), "b/a.exr");
    EXPECT_EQ(inFolder("", "a.exr"), "a.exr");
    EXPECT_THAT(failureOf([&] { inFolder(files.path("none"), "a.exr"); }).value_or(""),
                HasSubstr("none does not exist, create it first"));
}

std::string whyNot(const std::string& pattern, NameNeeded when = NameNeeded::whenWritten) {
    return failureOf([&] { checkNamePattern(pattern, "--output", when); }).value_or("");
}

TEST(FileNames, WhatCannotBeFilledIsRefused) {
    EXPECT_EQ(whyNot("out/{date}/{scene}_{passes}.exr"), "");
    EXPECT_THAT(whyNot("{scne}.exr"), HasSubstr("unknown {scne}, expected scene, sensor, date, seed or passes, did "
                                                "you mean 'scene'?"));
    EXPECT_THAT(whyNot("{scene.exr"), HasSubstr("without '}'"));
    EXPECT_THAT(whyNot("{passes}/a.exr"), HasSubstr("too late to be part of a folder's name"));
    EXPECT_THAT(whyNot("{seed}.ckpt", NameNeeded::beforeLoading), HasSubstr("known too late for this name"));
}

} // namespace
} // namespace quasilux

// The documentation holds: every quasilux command in README.md and docs/ runs, every script exists and parses, every
// relative link leads somewhere.
#include "support/documents.h"
#include "util/temporary_folder.h"

#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <regex>
#include <set>
#include <sstream>
#include <unistd.h>

namespace quasilux {
namespace {

namespace fs = std::filesystem;

using test::pages;
using test::root;

std::vector<fs::path> documents() {
    std::vector<fs::path> list{root / "README.md", root / "CONTRIBUTING.md", root / "CHANGELOG.md"};
    for (const auto& page : pages()) list.push_back(page);
    return list;
}

/// Lines of the ```sh blocks that start with `program`.
std::vector<std::string> commandsOf(const std::string& markdown, const std::string& program) {
    std::vector<std::string> commands;
    bool inBlock = false;
    std::istringstream stream(markdown);
    for (std::string line; std::getline(stream, line);) {
        if (line.rfind("```", 0) == 0)
            inBlock = line == "```sh";
        else if (inBlock && line.rfind(program + ' ', 0) == 0)
            commands.push_back(line);
    }
    return commands;
}

/// The same command at a hundredth of its work: one pass of a small image, no stop rule of its own. An image that is
/// compared with a reference keeps its size.
std::string shortened(const std::string& command) {
    if (command.rfind("quasilux bench", 0) == 0) {
        const bool compared = command.find("--reference") != std::string::npos;
        return std::regex_replace(command, std::regex(" --time [^ ]+"), " --time 0.1") +
               (compared ? "" : " -D resolution=16");
    }
    if (command.rfind("quasilux report", 0) == 0)
        return std::regex_replace(command, std::regex(" --time [^ ]+"), "") + " --time 0.1 -D resolution=16";
    if (command.rfind("quasilux render", 0) != 0) return command;
    const std::regex stopRule(" --(time|passes|error)[ =][^ ]+");
    const bool compared = command.find("out/compared.exr") != std::string::npos;
    return std::regex_replace(command, stopRule, "") + " --passes 1" + (compared ? "" : " -D resolution=16");
}

/// Runs a command in a folder that has the scenes and an empty out/; the exit code.
int runInFolder(const fs::path& folder, const std::string& command) {
    const std::string arguments = command.substr(std::string("quasilux").size());
    const std::string line = fmt::format("cd '{}' && '{}'{} >log 2>&1", folder.string(), QUASILUX_PROGRAM, arguments);
    const int status = std::system(line.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

class ReadmeCommandTest : public testing::Test {
protected:
    ReadmeCommandTest() {
        fs::create_directory_symlink(root / "scenes", folder / "scenes");
        fs::create_directory(folder / "out");
    }

    TemporaryFolder temporary;
    fs::path folder = temporary.path();
};

TEST_F(ReadmeCommandTest, EveryCommandRuns) {
    std::set<std::string> commands; // pages repeat some
    for (const auto& document : documents())
        for (const auto& command : commandsOf(readText(document), "quasilux")) {
            if (!commands.insert(shortened(command)).second) continue;
            SCOPED_TRACE(document.filename().string() + ": " + command);
            EXPECT_EQ(runInFolder(folder, shortened(command)), 0) << readText(folder / "log");
        }
    EXPECT_GE(commands.size(), 4u);
}

TEST_F(ReadmeCommandTest, AWrongCommandWouldBeNoticed) {
    const std::string markdown = "```sh\nquasilux info scenes/cornell_phong.xml --no-such-option\n```\n";
    const auto commands = commandsOf(markdown, "quasilux");
    ASSERT_EQ(commands.size(), 1u);
    EXPECT_EQ(runInFolder(folder, shortened(commands.front())), 2);
    EXPECT_EQ(runInFolder(folder, "quasilux info scenes/no-such-scene.xml"), 2);
}

bool parses(const fs::path& script) {
    return std::system(("bash -n '" + script.string() + "' 2>/dev/null").c_str()) == 0;
}

TEST_F(ReadmeCommandTest, EveryScriptExistsAndParses) {
    const std::string readme = readText(root / "README.md");
    EXPECT_THAT(commandsOf(readme, "bash"), testing::IsSupersetOf({"bash scripts/demo.sh", "bash scripts/test.sh"}));
    const std::regex script("scripts/[A-Za-z0-9_.]+");
    for (std::sregex_iterator match(readme.begin(), readme.end(), script), end; match != end; ++match)
        EXPECT_TRUE(fs::exists(root / match->str())) << match->str();
    EXPECT_TRUE(parses(root / ".ci" / "run"));
    for (const auto& entry : fs::directory_iterator(root / "scripts"))
        EXPECT_TRUE(entry.path().extension() != ".sh" || parses(entry.path())) << entry.path();
    std::ofstream(folder / "broken.sh") << "if true; then\n";
    EXPECT_FALSE(parses(folder / "broken.sh"));
}

/// Targets of relative links and pictures that do not exist, seen from `folder`.
std::vector<std::string> brokenLinks(const std::string& markdown, const fs::path& folder) {
    std::vector<std::string> broken;
    const std::regex link("\\]\\(([^)#:]+)(#[^)]*)?\\)");
    for (std::sregex_iterator match(markdown.begin(), markdown.end(), link), end; match != end; ++match)
        if (!fs::exists(folder / match->str(1))) broken.push_back(match->str(1));
    return broken;
}

TEST(Links, LeadToFiles) {
    for (const auto& document : documents())
        EXPECT_THAT(brokenLinks(readText(document), document.parent_path()), testing::IsEmpty()) << document;
}

TEST(Links, ABrokenOneWouldBeNoticed) {
    const std::string markdown =
        "[a](README.md) ![b](docs/no-such.png) [c](docs/gone.md#part) [d](https://example.org/x)";
    EXPECT_THAT(brokenLinks(markdown, root), testing::ElementsAre("docs/no-such.png", "docs/gone.md"));
}

} // namespace
} // namespace quasilux

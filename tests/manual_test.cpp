// Man pages and completions say what the program takes, and a shell understands them.
#include "cli/manual_pages.h"
#include "cli/option_list.h"
#include "cli/options.h"
#include "support/program_runner.h"

#include <cstdio>
#include <fmt/format.h>
#include <fstream>
#include <gmock/gmock.h>
#include <regex>

namespace quasilux {
namespace {

using testing::HasSubstr;

class ManualTest : public CommandLineTest {
protected:
    ManualTest() { declareOptions(app_, options_); }

    std::string written(const std::string& name) {
        EXPECT_EQ(run({"manual", "share"}).exitCode, 0);
        return readText(folder / "share" / name);
    }
    /// What bash offers after these words; the last one has been begun.
    std::string offered(const std::vector<std::string>& words) {
        std::ofstream(folder / "script")
            << written("bash-completion/completions/quasilux")
            << fmt::format("\nCOMP_WORDS=({})\nCOMP_CWORD={}\n_quasilux\necho \"${{COMPREPLY[*]}}\"\n",
                           fmt::join(words, " "), words.size() - 1);
        const std::string line = fmt::format("cd '{}' && bash script >out 2>&1", folder.string());
        EXPECT_EQ(std::system(line.c_str()), 0);
        return readText(folder / "out");
    }

    CLI::App app_{"What it is.", "quasilux"};

private:
    Options options_;
};

/// A page as it is read: without the marks of troff.
std::string plain(const std::string& page) {
    return std::regex_replace(std::regex_replace(page, std::regex("\\\\f[BIR]|\\\\&"), ""), std::regex("\\\\-"), "-");
}

TEST_F(ManualTest, EveryCommandAndOptionIsThere) {
    const std::string program = plain(written("man/man1/quasilux.1")), bash = bashCompletion(app_),
                      zsh = zshCompletion(app_), fish = fishCompletion(app_);
    size_t count = 0;
    for (CLI::App* command : listedCommands(app_)) {
        const std::string name = command->get_name();
        EXPECT_THAT(program, HasSubstr("quasilux-" + name + "(1)"));
        const std::string page = plain(readText(folder / ("share/man/man1/quasilux-" + name + ".1")));
        EXPECT_THAT(page, HasSubstr("quasilux-" + name + " - " + command->get_description()));
        const size_t inZsh = zsh.find("\n" + name + ")\n");
        const size_t inBash = bash.find(" " + name + ") options=");
        ASSERT_NE(inZsh, std::string::npos) << name;
        ASSERT_NE(inBash, std::string::npos) << name;
        for (const ListedOption& option : listedOptions(*command)) {
            EXPECT_THAT(page, HasSubstr(option.description));
            for (const auto& spelling : option.names) {
                ++count;
                EXPECT_THAT(page, HasSubstr(spelling));
                if (option.isPositional) continue;
                EXPECT_NE(bash.substr(inBash, bash.find(";;", inBash) - inBash).find(spelling), std::string::npos)
                    << spelling;
                EXPECT_NE(zsh.substr(inZsh, zsh.find(";;", inZsh) - inZsh).find("'" + spelling + "["),
                          std::string::npos)
                    << spelling;
                EXPECT_THAT(fish, HasSubstr(spelling.substr(0, 2) == "--" ? " -l " + spelling.substr(2)
                                                                          : " -s " + spelling.substr(1)));
            }
        }
    }
    EXPECT_GT(count, 100u);
}

TEST_F(ManualTest, ProgramAndCodeWriteTheSame) {
    EXPECT_EQ(written("bash-completion/completions/quasilux"), bashCompletion(app_));
    EXPECT_EQ(readText(folder / "share/zsh/site-functions/_quasilux"), zshCompletion(app_));
    EXPECT_EQ(readText(folder / "share/fish/vendor_completions.d/quasilux.fish"), fishCompletion(app_));
}

TEST_F(ManualTest, BashOffersWhatFits) {
    EXPECT_EQ(offered({"quasilux", "rend"}), "render\n");
    EXPECT_EQ(offered({"quasilux", "scen"}), "scene.xml\n");
    EXPECT_EQ(offered({"quasilux", "scene.xml", "--varia"}), "--variant\n") << "as of render";
    EXPECT_EQ(offered({"quasilux", "render", "--varia"}), "--variant\n");
    EXPECT_EQ(offered({"quasilux", "render", "--variant", "''"}), "main alternative\n");
    EXPECT_EQ(offered({"quasilux", "render", "--variant", "a"}), "alternative\n");
    EXPECT_EQ(offered({"quasilux", "render", "scen"}), "scene.xml\n");
    EXPECT_EQ(offered({"quasilux", "compare", "--varia"}), "\n");
    EXPECT_EQ(offered({"quasilux", "render", "--time", "1"}), "\n");
}

TEST_F(ManualTest, MarksOfTroffInTextsAreText) {
    CLI::App app("'One' of \\these - dots", "quasilux");
    app.add_subcommand("sub", ".hidden");
    EXPECT_THAT(manualPage(app), HasSubstr("\n\\&'One' of \\ethese \\- dots\n"));
    EXPECT_THAT(manualPage(app), HasSubstr("\n\\&.hidden\n"));
}

TEST_F(ManualTest, FolderThatCannotBeMade) {
    std::ofstream(folder / "file") << "";
    const Outcome outcome = run({"manual", "file/share"});
    EXPECT_EQ(outcome.exitCode, 2);
    EXPECT_THAT(outcome.errors, HasSubstr("file/share"));
}

} // namespace
} // namespace quasilux

// Links of the documents lead where they say: to headings that exist, to symbols that the linked source file has, and
// from docs/README.md to every page. Pages of the guide and of the method can be read in ten minutes. Diagrams are
// those of their script.
#include "support/documents.h"
#include "util/temporary_folder.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <regex>
#include <set>
#include <sstream>

namespace quasilux {
namespace {

namespace fs = std::filesystem;

using test::pages;
using test::root;

struct Link {
    std::string text, file, anchor;
};

std::vector<Link> linksOf(const std::string& markdown) {
    std::vector<Link> links;
    const std::regex link("\\[([^\\]]*)\\]\\(([^)#:]*)(#[^)]*)?\\)");
    for (std::sregex_iterator match(markdown.begin(), markdown.end(), link), end; match != end; ++match)
        links.push_back({match->str(1), match->str(2), match->str(3)});
    return links;
}

/// The anchor that GitHub and MkDocs make of a heading: words in lower case, joined by '-', punctuation left out.
std::string anchorOf(const std::string& heading) {
    std::string anchor = "#";
    for (const char c : heading) {
        const auto byte = static_cast<unsigned char>(c);
        if (c == ' ')
            anchor += '-';
        else if (std::isalnum(byte) || c == '-' || c == '_' || byte >= 0x80)
            anchor += static_cast<char>(byte < 0x80 ? std::tolower(byte) : byte);
    }
    return anchor;
}

std::set<std::string> anchorsOf(const std::string& markdown) {
    std::set<std::string> anchors;
    std::istringstream stream(markdown);
    bool inBlock = false;
    for (std::string line; std::getline(stream, line);) {
        if (line.rfind("```", 0) == 0) inBlock = !inBlock;
        const size_t level = line.find_first_not_of('#');
        if (!inBlock && level > 0 && level < line.size() && line[level] == ' ')
            anchors.insert(anchorOf(line.substr(level + 1)));
    }
    return anchors;
}

/// Links to headings that do not exist, of a page in `folder` whose own text is `markdown`.
std::vector<std::string> lostAnchors(const std::string& markdown, const fs::path& folder) {
    std::vector<std::string> lost;
    for (const auto& link : linksOf(markdown)) {
        const bool isPage = link.file.empty() || fs::path(link.file).extension() == ".md";
        if (link.anchor.empty() || !isPage) continue;
        const auto anchors = anchorsOf(link.file.empty() ? markdown : readText(folder / link.file));
        if (anchors.count(link.anchor) == 0) lost.push_back(link.file + link.anchor);
    }
    return lost;
}

/// A name in backquotes that links to a source file; of Class::name the last part.
std::string symbolOf(const Link& link) {
    static const std::regex symbol("`(?:[A-Za-z_]\\w*::)*([A-Za-z_]\\w*)`");
    std::smatch match;
    const std::string extension = fs::path(link.file).extension().string();
    const bool isSource = extension == ".cl" || extension == ".clh" || extension == ".cpp" || extension == ".h";
    return isSource && std::regex_match(link.text, match, symbol) ? match.str(1) : "";
}

struct Symbols {
    std::set<std::string> found;
    std::vector<std::string> lost;
};

Symbols symbolsOf(const std::string& markdown, const fs::path& folder) {
    Symbols symbols;
    for (const auto& link : linksOf(markdown)) {
        const std::string name = symbolOf(link);
        if (name.empty()) continue;
        if (std::regex_search(readText(folder / link.file), std::regex("\\b" + name + "\\b")))
            symbols.found.insert(name);
        else
            symbols.lost.push_back(name + " in " + link.file);
    }
    return symbols;
}

TEST(DocumentLinks, LeadToHeadings) {
    for (const auto& page : pages())
        EXPECT_THAT(lostAnchors(readText(page), page.parent_path()), testing::IsEmpty()) << page;
    EXPECT_THAT(lostAnchors(readText(root / "README.md"), root), testing::IsEmpty());
}

TEST(DocumentLinks, ALostHeadingWouldBeNoticed) {
    const std::string markdown = "# Title\n```sh\n# no heading\n```\n[a](#title) [b](#no-heading) [c](README.md#gone)";
    EXPECT_THAT(lostAnchors(markdown, root), testing::ElementsAre("#no-heading", "README.md#gone"));
}

TEST(DocumentLinks, SymbolsAreInTheFilesThatTheyLinkTo) {
    for (const auto& page : pages())
        EXPECT_THAT(symbolsOf(readText(page), page.parent_path()).lost, testing::IsEmpty()) << page;
    const fs::path method = root / "docs" / "method";
    EXPECT_GE(symbolsOf(readText(method / "a-photon.md"), method).found.size(), 25u);
    EXPECT_GE(symbolsOf(readText(method / "a-camera-path.md"), method).found.size(), 25u);
}

TEST(DocumentLinks, ALostSymbolWouldBeNoticed) {
    const std::string markdown = "[`lawLightTaken`](kernels/law.clh) [`lawLight`](kernels/law.clh) "
                                 "[`Film::develops`](host/render/film.cpp) [`addSample`](kernels/no-such.clh)";
    const Symbols symbols = symbolsOf(markdown, root);
    EXPECT_THAT(symbols.found, testing::ElementsAre("lawLightTaken"));
    EXPECT_THAT(symbols.lost, testing::ElementsAre("lawLight in kernels/law.clh", "develops in host/render/film.cpp",
                                                   "addSample in kernels/no-such.clh"));
}

/// Pages below docs/ that `index`, a text in docs/, does not link to.
std::vector<std::string> pagesNotIn(const std::string& index) {
    std::set<fs::path> linked{root / "docs" / "README.md"};
    for (const auto& link : linksOf(index)) linked.insert((root / "docs" / link.file).lexically_normal());
    std::vector<std::string> missing;
    for (const auto& page : pages())
        if (linked.count(page) == 0) missing.push_back(fs::relative(page, root).string());
    return missing;
}

TEST(DocumentLinks, TheIndexHasEveryPage) {
    const std::string index = readText(root / "docs" / "README.md");
    EXPECT_THAT(pagesNotIn(index), testing::IsEmpty());
    EXPECT_THAT(pagesNotIn(std::regex_replace(index, std::regex("method/theory\\.md"), "method/gone.md")),
                testing::ElementsAre("docs/method/theory.md"));
}

bool isDrawnBy(const std::string& script, const fs::path& folder) {
    return std::system(fmt::format("python3 '{}' '{}'", script, folder.string()).c_str()) == 0;
}

TEST(Diagrams, AreThoseThatTheScriptDraws) {
    const TemporaryFolder drawn;
    ASSERT_TRUE(isDrawnBy((root / "scripts" / "diagrams.py").string(), drawn.path()));
    for (const char* name : {"pass.svg", "classes.svg", "split.svg"}) {
        const std::string kept = readText(root / "docs" / "figures" / name);
        EXPECT_GT(kept.size(), 1000u) << name;
        EXPECT_EQ(readText(drawn.path() / name), kept) << name << ": run scripts/diagrams.py";
    }
    EXPECT_FALSE(isDrawnBy((root / "scripts" / "no-such.py").string(), drawn.path()));
}

/// All, or those of the text alone: tables, formulas and commands are looked up.
size_t wordsOf(const std::string& page, bool all) {
    std::istringstream lines(page);
    size_t words = 0;
    bool inBlock = false;
    for (std::string line; std::getline(lines, line);) {
        if (line.rfind("```", 0) == 0) inBlock = !inBlock;
        if (!all && (inBlock || line.rfind('|', 0) == 0 || line.rfind("    ", 0) == 0)) continue;
        std::istringstream stream(line);
        for (std::string word; stream >> word;) ++words;
    }
    return words;
}

// At 200 words a minute.
TEST(DocumentLinks, PagesOfGuideAndMethodTakeTenMinutes) {
    for (const auto& page : pages()) {
        const fs::path folder = page.parent_path().filename();
        if (folder != "guide" && folder != "method") continue;
        EXPECT_LE(wordsOf(readText(page), folder == "guide"), 2000u) << page;
    }
}

} // namespace
} // namespace quasilux

// Every reader takes its seeds, and each cut off and with altered bytes, with an InputError or none: what libFuzzer
// found (scripts/fuzz.sh) stays mended. Under the sanitizers too.
#include "fuzz/targets.h"
#include "support/read_text.h"

#include <algorithm>
#include <random>

namespace quasilux {
namespace {

namespace fs = std::filesystem;

const fs::path seeds = QUASILUX_SOURCE_DIR "/tests/fuzz/seeds";

class FuzzSeeds : public testing::TestWithParam<std::string> {};

std::vector<std::string> seedsOf(const std::string& target) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(seeds / target)) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    std::vector<std::string> contents;
    for (const fs::path& file : files) contents.push_back(readText(file));
    return contents;
}

TEST_P(FuzzSeeds, AreReadOrRefused) {
    const auto read = fuzz::targets.at(GetParam());
    const auto contents = seedsOf(GetParam());
    ASSERT_FALSE(contents.empty());
    std::mt19937 random(24);
    const auto below = [&](size_t end) { return std::uniform_int_distribution<size_t>(0, end - 1)(random); };
    constexpr unsigned changes = 12;
    for (const std::string& seed : contents) {
        EXPECT_NO_THROW(read(seed)); // of an InputError it catches itself
        for (unsigned k = 0; k < changes && !seed.empty(); ++k) {
            EXPECT_NO_THROW(read(seed.substr(0, below(seed.size()))));
            std::string altered = seed;
            for (unsigned byte = 0; byte < 1 + k / 4; ++byte)
                altered[below(altered.size())] = static_cast<char>(below(256));
            EXPECT_NO_THROW(read(altered));
        }
    }
}

std::vector<std::string> names() {
    std::vector<std::string> all;
    for (const auto& [name, target] : fuzz::targets) all.push_back(name);
    return all;
}

INSTANTIATE_TEST_SUITE_P(Readers, FuzzSeeds, testing::ValuesIn(names()),
                         [](const auto& reader) { return reader.param; });

// Control: what is no InputError would be seen.
TEST(FuzzSeeds, ThrowsOfReadersAreSeen) {
    EXPECT_THROW(fuzz::expectInputErrors([] { throw std::runtime_error(""); }), std::runtime_error);
    EXPECT_NO_THROW(fuzz::expectInputErrors([] { throw InputError(""); }));
    size_t folders = 0;
    for (const auto& entry : fs::directory_iterator(seeds)) folders += fuzz::targets.contains(entry.path().filename());
    EXPECT_EQ(folders, fuzz::targets.size());
}

} // namespace
} // namespace quasilux

// Pieces of a film are what the developed image has there, also of a film in several buffers.
#include "render/film_cut.h"

#include <gtest/gtest.h>
#include <random>

namespace quasilux {
namespace {

constexpr unsigned width = 37, height = 23, passes = 3;

// Any sums will do: both ways must make the same of them.
void fillWithNoise(Film& film) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> uniform(0, 4);
    for (unsigned pass = 0; pass < passes; ++pass) {
        film.beginPass(pass);
        film.endPass();
    }
    for (Film::Part& part : film.parts()) {
        std::vector<float> sums(part.sums.size());
        for (float& sum : sums) sum = uniform(random);
        part.sums.write(sums);
    }
}

class FilmCutTest : public testing::TestWithParam<uint64_t> {
protected:
    FilmCutTest() {
        fillWithNoise(film);
        whole = film.develop(passes);
    }

    size_t at(unsigned x, unsigned y) const { return 3 * (size_t(y) * width + x); }

    Device device;
    Film film{device, width, height, FilmLayout{}, GetParam()};
    FilmImage whole;
    FilmCutter cutter{device};
};

TEST_P(FilmCutTest, PixelsAreThoseOfTheImage) {
    const FilmCutChoice choice{5, 3, 20, 17, 1, CUT_ALL, FilmCutChoice::Content::all, {}};
    const FilmImage cut = cutter.develop(film, passes, choice);
    ASSERT_EQ(cut.width, choice.width);
    ASSERT_EQ(cut.height, choice.height);
    for (unsigned y = 0; y < cut.height; ++y)
        for (unsigned k = 0; k < 3 * cut.width; ++k) {
            const size_t from = at(choice.x, choice.y + y) + k, to = 3 * size_t(y) * cut.width + k;
            ASSERT_EQ(cut.radiance[to], whole.radiance[from]);
            ASSERT_EQ(cut.standardError[to], whole.standardError[from]);
            ASSERT_EQ(cut.bias[to], whole.bias[from]);
            ASSERT_EQ(cut.components[LIGHT_DIFFUSE].radiance[to], whole.components[LIGHT_DIFFUSE].radiance[from]);
            ASSERT_EQ(cut.components[LIGHT_CAUSTIC].biasError[to], whole.components[LIGHT_CAUSTIC].biasError[from]);
        }
}

// Of blocks of four pixels a side; the last ones reach beyond the film and are smaller.
TEST_P(FilmCutTest, ValuesAreMeansOfBlocks) {
    FilmCutChoice choice{0, 0, width, height, 4, CUT_ALL, FilmCutChoice::Content::values, {}};
    for (const auto component : {std::optional<unsigned>(), std::optional<unsigned>(FILM_EMISSION)}) {
        choice.component = component;
        const auto& values = component ? whole.components[*component].radiance : whole.radiance;
        const FilmImage cut = cutter.develop(film, passes, choice);
        ASSERT_EQ(cut.width, 10u);
        ASSERT_EQ(cut.height, 6u);
        for (unsigned y = 0; y < cut.height; ++y)
            for (unsigned x = 0; x < cut.width; ++x) {
                double sum = 0, pixels = 0;
                for (unsigned v = 4 * y; v < std::min(4 * y + 4, height); ++v)
                    for (unsigned u = 4 * x; u < std::min(4 * x + 4, width); ++u, ++pixels) sum += values[at(u, v)];
                ASSERT_NEAR(cut.radiance[3 * (size_t(y) * cut.width + x)], sum / pixels, 1e-5);
            }
    }
}

// The same blocks by one pixel in each row, each in another column.
TEST_P(FilmCutTest, DiagonalsAreMeansOfFewerPixels) {
    const FilmCutChoice choice{0, 0, width, height, 4, CUT_DIAGONAL, FilmCutChoice::Content::values, {}};
    const FilmImage cut = cutter.develop(film, passes, choice);
    for (unsigned y = 0; y < cut.height; ++y)
        for (unsigned x = 0; x < cut.width; ++x) {
            const unsigned columns = std::min(4u, width - 4 * x), rows = std::min(4u, height - 4 * y);
            double sum = 0;
            for (unsigned k = 0; k < rows; ++k) sum += whole.radiance[at(4 * x + k % columns, 4 * y + k)];
            ASSERT_NEAR(cut.radiance[3 * (size_t(y) * cut.width + x)], sum / rows, 1e-5);
        }
}

TEST_P(FilmCutTest, ErrorsAreThoseOfThePixelInTheMiddle) {
    const FilmCutChoice choice{2, 1, 30, 20, 5, CUT_MIDDLE, FilmCutChoice::Content::errors, {}};
    const FilmImage cut = cutter.develop(film, passes, choice);
    ASSERT_EQ(cut.width, 6u);
    ASSERT_FALSE(cut.hasComponents());
    for (unsigned y = 0; y < cut.height; ++y)
        for (unsigned x = 0; x < cut.width; ++x) {
            const size_t from = at(2 + 5 * x + 2, 1 + 5 * y + 2), to = 3 * (size_t(y) * cut.width + x);
            ASSERT_EQ(cut.standardError[to], whole.standardError[from]);
            ASSERT_EQ(cut.biasError[to + 1], whole.biasError[from + 1]);
        }
}

// In the middle of a pass: its pixels so far have one pass more, and each is the mean of its own.
TEST_P(FilmCutTest, PixelsAheadAreMeansOfTheirOwnPasses) {
    constexpr unsigned ahead = 5 * width + 7;
    const FilmCutChoice choice{0, 0, width, height, 1, CUT_ALL, FilmCutChoice::Content::values, {}};
    unsigned calls = 0;
    film.watchRows([&] { ++calls; });
    film.noteAhead(ahead);
    EXPECT_EQ(calls, 1u);
    const FilmImage inPass = cutter.develop(film, passes, choice);
    film.endPass();
    for (size_t k = 0; k < inPass.radiance.size(); ++k) {
        const double factor = k / 3 < ahead ? double(passes) / (passes + 1) : 1;
        ASSERT_NEAR(inPass.radiance[k], whole.radiance[k] * factor, 1e-6) << k;
    }
    EXPECT_EQ(cutter.develop(film, passes, choice).radiance, whole.radiance);
}

constexpr uint64_t smallBuffer = 64 * 1024; // of the film, several are needed
INSTANTIATE_TEST_SUITE_P(Buffers, FilmCutTest, testing::Values(Film::inOneBuffer, smallBuffer));

TEST(FilmCutBuffers, OfTheSecondCaseAreSeveral) {
    Device device;
    EXPECT_GT(Film(device, width, height, {}, smallBuffer).parts().size(), 2u);
}

} // namespace
} // namespace quasilux

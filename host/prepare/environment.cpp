#include "prepare/environment.h"

#include "prepare/environment_cells.h"
#include "scene/skies/sky_image.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numbers>

namespace quasilux {

namespace {

using std::numbers::pi;

// Share of directions that are even over rows, and over the cells of a row, whatever their radiance: or else a dim
// pixel beside a bright one had a probability below the step of random numbers.
constexpr double evenShare = 1.0 / 256;
constexpr double steps = 1 << 24; // of random numbers in [0,1)

// Sums of probabilities in proportion to `weights`, in steps of random numbers.
void addSums(const std::vector<double>& weights, std::vector<float>& sums) {
    double all = 0, below = 0;
    for (const double weight : weights) all += weight;
    const double even = (all > 0 ? evenShare : 1) / static_cast<double>(weights.size());
    const double scale = all > 0 ? (1 - evenShare) / all : 0;
    for (const double weight : weights) {
        below += scale * weight + even;
        sums.push_back(static_cast<float>(std::min(std::round(below * steps) / steps, 1.0)));
    }
    sums.back() = 1;
}

struct Probabilities {
    std::vector<float> rows, columns, blocks; // as shared::EnvironmentMap has them
};

// Of the cells when `base` is taken off their weights.
Probabilities probabilitiesOf(const EnvironmentCells& of, float base) {
    const auto weightsOfRow = [&](unsigned row) {
        auto weights = of.weightsOfRow(row);
        for (float& weight : weights) weight = std::max(weight - base, 0.f);
        return weights;
    };
    Probabilities found;
    found.columns.reserve(size_t(of.down()) * of.across());
    std::vector<double> cells(of.across()), rows;
    auto upper = weightsOfRow(0);
    for (unsigned row = 0; row < of.down(); ++row) {
        auto lower = weightsOfRow(row + 1);
        double all = 0;
        for (unsigned column = 0; column < of.across(); ++column) {
            const unsigned next = column + 1 == of.across() ? 0 : column + 1;
            cells[column] = double(upper[column]) + upper[next] + lower[column] + lower[next];
            all += cells[column];
        }
        const size_t first = found.columns.size();
        addSums(cells, found.columns);
        for (size_t end = first + ENVMAP_BLOCK;; end += ENVMAP_BLOCK) {
            found.blocks.push_back(found.columns[std::min(end, found.columns.size()) - 1]);
            if (end >= found.columns.size()) break;
        }
        rows.push_back(all * std::sin(pi * (row + 0.5) / of.down())); // in proportion to the difference of cosines
        upper = std::move(lower);
    }
    addSums(rows, found.rows);
    return found;
}

// Over the sphere, of the image as it is looked up: linear in the angle between rows.
Rgb meanRadiance(const EnvironmentImage& image) {
    const std::vector<double> weights = solidAnglesOfRows(image.height);
    double sum[3] = {0, 0, 0};
    for (unsigned row = 0; row < image.height; ++row) {
        double ofRow[3] = {0, 0, 0};
        for (unsigned column = 0; column < image.width; ++column) {
            const Rgb& pixel = image.pixels[size_t(row) * image.width + column];
            ofRow[0] += pixel.r;
            ofRow[1] += pixel.g;
            ofRow[2] += pixel.b;
        }
        for (int c = 0; c < 3; ++c) sum[c] += weights[row] * ofRow[c] / (4 * pi * image.width);
    }
    return {static_cast<float>(sum[0]), static_cast<float>(sum[1]), static_cast<float>(sum[2])};
}

double radianceByFlux(const EnvironmentImage& image) {
    const std::vector<double> weights = solidAnglesOfRows(image.height);
    double sum = 0, squares = 0;
    for (size_t k = 0; k < image.pixels.size(); ++k) {
        const double radiance = mean(image.pixels[k]), weight = weights[k / image.width];
        sum += weight * radiance;
        squares += weight * radiance * radiance;
    }
    return sum > 0 ? squares / sum : 0;
}

template <typename T>
unsigned append(const std::vector<T>& records, std::vector<uint32_t>& words) {
    const auto first = static_cast<unsigned>(words.size());
    words.resize(first + records.size() * sizeof(T) / sizeof(uint32_t));
    std::memcpy(words.data() + first, records.data(), records.size() * sizeof(T));
    return first;
}

} // namespace

EnvironmentTable makeEnvironmentTable(const EnvironmentImage& image) {
    EnvironmentTable table;
    const EnvironmentCells cells(image);
    const auto mean = static_cast<float>(cells.meanWeight());
    const std::array<Probabilities, 2> probabilities{probabilitiesOf(cells, 0), probabilitiesOf(cells, mean)};
    constexpr unsigned headWords = sizeof(shared::EnvironmentMap) / sizeof(uint32_t);
    size_t words = 2 * headWords + 3 * image.pixels.size() + cells.weights().size();
    for (const auto& p : probabilities) words += p.rows.size() + p.columns.size() + p.blocks.size();
    table.words.reserve(words);
    table.words.resize(2 * size_t{headWords});
    const unsigned texels = append(image.pixels, table.words),
                   weights = cells.weights().empty() ? 0 : append(cells.weights(), table.words);
    std::array<shared::EnvironmentMap, 2> heads{};
    for (unsigned k = 0; k < 2; ++k) {
        const unsigned before = k * headWords; // offsets are from each head on
        const unsigned rows = append(probabilities[k].rows, table.words) - before,
                       columns = append(probabilities[k].columns, table.words) - before,
                       blocks = append(probabilities[k].blocks, table.words) - before;
        heads[k] = {image.width,
                    image.height,
                    texels - before,
                    cells.across(),
                    cells.down(),
                    weights > 0 ? weights - before : 0,
                    rows,
                    columns,
                    blocks,
                    k == 0 ? 0 : mean};
    }
    std::memcpy(table.words.data(), heads.data(), sizeof heads);
    table.meanRadiance = meanRadiance(image);
    table.radianceByFlux = radianceByFlux(image);
    return table;
}

} // namespace quasilux

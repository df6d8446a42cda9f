#include "prepare/goniogram_table.h"

#include "prepare/pack.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

namespace quasilux {

namespace {

constexpr double radiansOfDegree = std::numbers::pi / 180;
// Degrees: within a row of cells the density takes the sine as linear, so that rows are to be narrow.
constexpr double highestRow = 5;
constexpr double numberSteps = 1 << 24; // of random numbers in [0,1)

/// The same goniogram, with rows between where its own are far apart.
Goniogram withNarrowRows(const Goniogram& given) {
    Goniogram out = given;
    out.polar.clear();
    std::vector<std::pair<size_t, double>> places; // row, share of the way to the next
    for (size_t row = 0; row + 1 < given.polar.size(); ++row) {
        const double height = given.polar[row + 1] - given.polar[row];
        const int parts = std::max(1, static_cast<int>(std::ceil(height / highestRow - 1e-9)));
        for (int k = 0; k < parts; ++k) places.emplace_back(row, static_cast<double>(k) / parts);
    }
    places.emplace_back(given.polar.size() - 1, 0);
    const auto next = [&](size_t row) { return std::min(row + 1, given.polar.size() - 1); };
    for (const auto& [row, share] : places)
        out.polar.push_back(std::lerp(given.polar[row], given.polar[next(row)], share));
    out.candela.clear();
    for (size_t k = 0; k < given.azimuth.size(); ++k)
        for (const auto& [row, share] : places)
            out.candela.push_back(std::lerp(given.at(k, row), given.at(k, next(row)), share));
    return out;
}

/// Sums of probabilities in proportion to `weights`, in steps of random numbers: at least one where a weight is above
/// 0, none where it is
/// 0. Even where all are 0, which is never looked at.
void addStepSums(std::vector<double> weights, std::vector<float>& sums) {
    double all = 0;
    for (const double weight : weights) all += weight;
    if (!(all > 0)) {
        std::fill(weights.begin(), weights.end(), 1.0);
        all = static_cast<double>(weights.size());
    }
    auto left = static_cast<double>(std::count_if(weights.begin(), weights.end(), [](double w) { return w > 0; }));
    double below = 0, step = 0;
    for (const double weight : weights) {
        below += weight;
        if (weight > 0) {
            left -= 1;
            step = std::clamp(std::round(below / all * numberSteps), step + 1, numberSteps - left);
            if (left == 0) step = numberSteps;
        }
        sums.push_back(static_cast<float>(step / numberSteps));
    }
}

/// Of the intensity times a sine that is linear in the row, by cell and by row.
void addProbabilities(const Goniogram& goniogram, std::vector<float>& rowSums, std::vector<float>& columnSums) {
    std::vector<double> rows;
    for (size_t row = 0; row + 1 < goniogram.polar.size(); ++row) {
        const double a = goniogram.polar[row] * radiansOfDegree, b = goniogram.polar[row + 1] * radiansOfDegree;
        const double upper = std::sin(a) / 3 + std::sin(b) / 6, lower = std::sin(a) / 6 + std::sin(b) / 3;
        std::vector<double> cells;
        double all = 0;
        for (size_t k = 0; k + 1 < goniogram.azimuth.size(); ++k) {
            cells.push_back((b - a) * (goniogram.azimuth[k + 1] - goniogram.azimuth[k]) *
                            (upper * (goniogram.at(k, row) + goniogram.at(k + 1, row)) +
                             lower * (goniogram.at(k, row + 1) + goniogram.at(k + 1, row + 1))));
            all += cells.back();
        }
        rows.push_back(all);
        addStepSums(std::move(cells), columnSums);
    }
    addStepSums(std::move(rows), rowSums);
}

/// The least angle s so that the intensity at an angle a from the axis is at most cos(a - s) of the largest, a >= s.
double spreadOf(const Goniogram& goniogram) {
    if (!goniogram.isOfAxis) return std::numbers::pi;
    double spread = 0;
    const double largest = goniogram.largest();
    for (size_t k = 0; k < goniogram.azimuth.size(); ++k)
        for (size_t row = 0; row < goniogram.polar.size(); ++row) {
            const double share = goniogram.at(k, row) / largest;
            if (share > 0) spread = std::max(spread, goniogram.polar[row] * radiansOfDegree - std::acos(share));
        }
    return spread;
}

template <typename T>
unsigned appendWords(const std::vector<T>& values, std::vector<uint32_t>& words, size_t first) {
    const auto at = static_cast<unsigned>(words.size() - first);
    words.resize(words.size() + values.size());
    static_assert(sizeof(T) == sizeof(uint32_t));
    std::memcpy(words.data() + first + at, values.data(), values.size() * sizeof(T));
    return at;
}

std::vector<float> singles(const std::vector<double>& values, double factor) {
    std::vector<float> out;
    out.reserve(values.size());
    for (const double value : values) out.push_back(static_cast<float>(factor * value));
    return out;
}

/// About the axes of the table, which are those of the luminaire in another order.
void setShape(const LuminaireType& type, shared::GoniogramTable& head) {
    const LuminousShape& shape = type.goniogram.shape;
    using Kind = LuminousShape::Kind;
    if (!type.fromShape || shape.kind == Kind::point) return; // LUMINOUS_POINT
    const glm::dmat3& axes = type.goniogram.axes;
    const glm::dvec3 half = glm::dvec3(shape.sizeC0, shape.sizeC90, shape.height) / (2 * type.metresPerUnit);
    glm::dvec3 ofTable;
    int rod = 0; // axis of the table
    const int along = shape.kind == Kind::rodAlongC0 ? 0 : shape.kind == Kind::rodAlongC90 ? 1 : 2;
    for (int k = 0; k < 3; ++k) {
        ofTable[k] = glm::dot(glm::abs(axes[k]), half);
        if (std::abs(axes[k][along]) > 0.5) rod = k;
    }
    head.halfSize = pack(ofTable);
    head.shape = shape.kind == Kind::box         ? LUMINOUS_BOX
                 : shape.kind == Kind::ellipsoid ? LUMINOUS_ELLIPSOID
                                                 : LUMINOUS_ROD_X + unsigned(rod);
}

} // namespace

GoniogramKind addGoniogram(const LuminaireType& type, std::vector<uint32_t>& words) {
    const Goniogram goniogram = withNarrowRows(type.goniogram);
    const size_t first = words.size();
    shared::GoniogramTable head{};
    words.resize(first + sizeof head / sizeof(uint32_t));
    head.rows = static_cast<unsigned>(goniogram.polar.size());
    head.columns = static_cast<unsigned>(goniogram.azimuth.size());
    head.polars = appendWords(singles(goniogram.polar, radiansOfDegree), words, first);
    head.azimuths = appendWords(singles(goniogram.azimuth, radiansOfDegree), words, first);
    std::vector<float> sines, rowSums, columnSums;
    sines.reserve(goniogram.polar.size());
    for (const double polar : goniogram.polar) sines.push_back(static_cast<float>(std::sin(polar * radiansOfDegree)));
    head.sines = appendWords(sines, words, first);
    head.intensities = appendWords(singles(goniogram.candela, 1), words, first);
    addProbabilities(goniogram, rowSums, columnSums);
    head.rowSums = appendWords(rowSums, words, first);
    head.columnSums = appendWords(columnSums, words, first);
    setShape(type, head);
    std::memcpy(words.data() + first, &head, sizeof head);
    return {static_cast<unsigned>(first), goniogram.lumens(), spreadOf(goniogram), glm::length(unpack(head.halfSize)),
            goniogram.axes};
}

} // namespace quasilux

#include "prepare/environment_cells.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

namespace quasilux {

namespace {

// Rows of larger cells, tried in turn, twice as many along each: tables of 64 KiB and 256 KiB.
constexpr unsigned rowsOfCells[] = {64, 128};
// A sample's second moment may be so much above that of the image's own cells.
constexpr double secondMomentAllowed = 1.02;

float brightness(const Rgb& color) { return color.r + color.g + color.b; }

// Where a coordinate lies among corners that are 1 apart: between which two, and how far along.
struct Between {
    unsigned first, second;
    double along;
};

Between amongRows(unsigned row, unsigned height, unsigned down) {
    const double place = double(row) * down / (height - 1);
    const unsigned first = std::min(static_cast<unsigned>(place), down - 1);
    return {first, first + 1, place - first};
}

Between amongColumns(unsigned column, unsigned width, unsigned across) {
    const double place = (column + 0.5) * across / width - 0.5;
    const unsigned first = place < 0 ? across - 1 : static_cast<unsigned>(place);
    return {first, first + 1 == across ? 0 : first + 1, place - std::floor(place)};
}

// Of a pixel as a solid angle, up to a factor; one at a pole has a little of it.
double weightOfRow(unsigned row, unsigned height) {
    const double step = std::numbers::pi / (height - 1);
    return std::sin(std::clamp<double>(row, 0.25, height - 1.25) * step);
}

// Beside a pole the cosine runs as the angle squared: there the density is never to fall faster than the radiance.
void raisePole(std::span<float> pole, std::span<const float> next) {
    for (size_t k = 0; k < pole.size(); ++k) pole[k] = std::max(pole[k], next[k]);
}

} // namespace

EnvironmentCells::EnvironmentCells(const EnvironmentImage& image)
    : image_(&image), across_(image.width), down_(image.height - 1) {
    for (const unsigned down : rowsOfCells) {
        if (2 * down > down_ || 4 * down > across_) return;
        EnvironmentCells larger(image, down);
        if (larger.secondMoment() > secondMomentAllowed) continue;
        *this = std::move(larger);
        return;
    }
}

// Each corner has the mean of the pixels about it, weighted by what they count in its hat function.
EnvironmentCells::EnvironmentCells(const EnvironmentImage& image, unsigned down)
    : image_(&image), across_(2 * down), down_(down) {
    std::vector<double> sums(size_t(down_ + 1) * across_), shares(sums.size());
    const auto add = [&](size_t corner, double share, double value) {
        sums[corner] += share * value;
        shares[corner] += share;
    };
    for (unsigned row = 0; row < image.height; ++row) {
        const Between r = amongRows(row, image.height, down_);
        const double solidAngle = weightOfRow(row, image.height);
        for (unsigned column = 0; column < image.width; ++column) {
            const Between c = amongColumns(column, image.width, across_);
            const double value = brightness(image.pixels[size_t(row) * image.width + column]);
            const size_t upper = size_t(r.first) * across_, lower = size_t(r.second) * across_;
            const double above = solidAngle * (1 - r.along), below = solidAngle * r.along;
            add(upper + c.first, above * (1 - c.along), value);
            add(upper + c.second, above * c.along, value);
            add(lower + c.first, below * (1 - c.along), value);
            add(lower + c.second, below * c.along, value);
        }
    }
    weights_.resize(sums.size());
    for (size_t k = 0; k < sums.size(); ++k) weights_[k] = static_cast<float>(shares[k] > 0 ? sums[k] / shares[k] : 0);
    const auto rowOf = [&](unsigned row) { return std::span(weights_).subspan(size_t(row) * across_, across_); };
    raisePole(rowOf(0), rowOf(1));
    raisePole(rowOf(down_), rowOf(down_ - 1));
}

double EnvironmentCells::secondMoment() const {
    double squares = 0, densities = 0, sum = 0;
    for (unsigned row = 0; row < image_->height; ++row) {
        const Between r = amongRows(row, image_->height, down_);
        const double solidAngle = weightOfRow(row, image_->height);
        for (unsigned column = 0; column < image_->width; ++column) {
            const Between c = amongColumns(column, image_->width, across_);
            const float *upper = weights_.data() + size_t(r.first) * across_,
                        *lower = weights_.data() + size_t(r.second) * across_;
            const double density = std::lerp(std::lerp<double>(upper[c.first], upper[c.second], c.along),
                                             std::lerp<double>(lower[c.first], lower[c.second], c.along), r.along);
            const double value = brightness(image_->pixels[size_t(row) * image_->width + column]);
            densities += solidAngle * density;
            sum += solidAngle * value;
            if (value > 0) squares += solidAngle * value * value / density;
        }
    }
    return sum > 0 ? squares * densities / (sum * sum) : 1;
}

double EnvironmentCells::meanWeight() const {
    double sum = 0, solidAngles = 0;
    for (unsigned row = 0; row <= down_; ++row) {
        const double solidAngle = weightOfRow(row, down_ + 1);
        for (const float weight : weightsOfRow(row)) sum += solidAngle * weight;
        solidAngles += solidAngle * across_;
    }
    return sum / solidAngles;
}

std::vector<float> EnvironmentCells::weightsOfRow(unsigned row) const {
    if (!weights_.empty()) {
        const auto first = weights_.begin() + std::ptrdiff_t(row) * across_;
        return {first, first + across_};
    }
    const auto ofPixels = [&](unsigned r) {
        std::vector<float> weights(across_);
        for (unsigned column = 0; column < across_; ++column)
            weights[column] = brightness(image_->pixels[size_t(r) * across_ + column]);
        return weights;
    };
    std::vector<float> weights = ofPixels(row);
    if (row == 0) raisePole(weights, ofPixels(1));
    if (row == down_) raisePole(weights, ofPixels(row - 1));
    return weights;
}

} // namespace quasilux

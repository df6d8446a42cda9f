#include "prepare/environment_cells.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace quasilux {

namespace {

// Rows of larger cells, tried in turn, twice as many along each: tables of 64 KiB and 256 KiB.
constexpr unsigned rowsOfCells[] = {64, 128};
// A sample's second moment may be so much above that of the image's own cells.
constexpr double secondMomentAllowed = 1.02;

float brightness(const Rgb& color) { return color.r + color.g + color.b; }

// Where a coordinate lies among corners that are 1 apart: in which gap, and how far along.
struct Between {
    unsigned first;
    double along;
};

Between amongRows(unsigned row, unsigned height, unsigned down) {
    const double place = double(row) * down / (height - 1);
    const unsigned first = std::min(static_cast<unsigned>(place), down - 1);
    return {first, place - first};
}

Between amongColumns(unsigned column, unsigned width, unsigned across) {
    const double place = (column + 0.5) * across / width - 0.5;
    return place < 0 ? Between{across - 1, place + 1}
                     : Between{static_cast<unsigned>(place), place - std::floor(place)};
}

// Of a pixel as a solid angle, up to a factor; one at a pole has a little of it.
double weightOfRow(unsigned row, unsigned height) {
    const double step = std::numbers::pi / (height - 1);
    return std::sin(std::clamp<double>(row, 0.25, height - 1.25) * step);
}

// Beside a pole the cosine runs as the angle squared: there the density is never to fall faster than the radiance.
void raisePole(std::vector<float>& pole, const std::vector<float>& next) {
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
            const size_t upper = size_t(r.first) * across_, lower = upper + across_;
            const unsigned next = c.first + 1 == across_ ? 0 : c.first + 1;
            const double above = solidAngle * (1 - r.along), below = solidAngle * r.along;
            add(upper + c.first, above * (1 - c.along), value);
            add(upper + next, above * c.along, value);
            add(lower + c.first, below * (1 - c.along), value);
            add(lower + next, below * c.along, value);
        }
    }
    weights_.resize(sums.size());
    for (size_t k = 0; k < sums.size(); ++k) weights_[k] = static_cast<float>(shares[k] > 0 ? sums[k] / shares[k] : 0);
    for (unsigned k = 0; k < across_; ++k) {
        float* column = weights_.data() + k;
        column[0] = std::max(column[0], column[across_]);
        column[size_t(down_) * across_] =
            std::max(column[size_t(down_) * across_], column[size_t(down_ - 1) * across_]);
    }
}

double EnvironmentCells::secondMoment() const {
    double squares = 0, densities = 0, sum = 0;
    for (unsigned row = 0; row < image_->height; ++row) {
        const Between r = amongRows(row, image_->height, down_);
        const double solidAngle = weightOfRow(row, image_->height);
        for (unsigned column = 0; column < image_->width; ++column) {
            const Between c = amongColumns(column, image_->width, across_);
            const unsigned next = c.first + 1 == across_ ? 0 : c.first + 1;
            const float *upper = weights_.data() + size_t(r.first) * across_, *lower = upper + across_;
            const double density = std::lerp(std::lerp<double>(upper[c.first], upper[next], c.along),
                                             std::lerp<double>(lower[c.first], lower[next], c.along), r.along);
            const double value = brightness(image_->pixels[size_t(row) * image_->width + column]);
            densities += solidAngle * density;
            sum += solidAngle * value;
            if (value > 0) squares += solidAngle * value * value / density;
        }
    }
    return sum > 0 ? squares * densities / (sum * sum) : 1;
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

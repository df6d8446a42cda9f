#include "scene/skies/sky_image.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace quasilux {

namespace {

using std::numbers::pi;

Rgb middle(Rgb a, Rgb b) { return {(a.r + b.r) / 2, (a.g + b.g) / 2, (a.b + b.b) / 2}; }

bool isHorizon(unsigned row, unsigned height) { return 2 * row == height - 1; }

} // namespace

std::vector<double> solidAnglesOfRows(unsigned height) {
    const double step = pi / (height - 1);
    std::vector<double> weights(height);
    for (unsigned row = 0; row + 1 < height; ++row) {
        const double a = row * step, b = (row + 1) * step, all = std::cos(a) - std::cos(b);
        const double lower =
            (std::sin(b) - std::sin(a)) / step - std::cos(b); // integral of sin weighted by (angle - a) / step
        weights[row] += 2 * pi * (all - lower);
        weights[row + 1] += 2 * pi * lower;
    }
    return weights;
}

namespace {

/// Of the rows, the integral over the upper half of what is 1 on a row and falls linearly to 0 at those beside it,
/// times the cosine from the zenith. Sums to pi.
std::vector<double> groundWeightsOfRows(unsigned height) {
    const double step = pi / (height - 1);
    std::vector<double> weights(height);
    for (unsigned row = 0; row + 1 < height && row * step < pi / 2; ++row) {
        const double a = row * step, b = std::min(a + step, pi / 2);
        const double all = (std::cos(2 * a) - std::cos(2 * b)) / 4; // of sin cos
        const double lower =                                        // of sin cos weighted by (angle - a) / step
            ((std::sin(2 * b) - std::sin(2 * a)) / 4 - (b - a) * std::cos(2 * b) / 2) / (2 * step);
        weights[row] += 2 * pi * (all - lower);
        weights[row + 1] += 2 * pi * lower;
    }
    return weights;
}

} // namespace

glm::dvec3 irradianceOfGround(const EnvironmentImage& image) {
    const std::vector<double> weights = groundWeightsOfRows(image.height);
    glm::dvec3 sum{0};
    for (unsigned row = 0; row < image.height && weights[row] > 0; ++row) {
        glm::dvec3 ofRow{0};
        for (unsigned column = 0; column < image.width; ++column) {
            const Rgb& pixel = image.pixels[size_t(row) * image.width + column];
            ofRow += glm::dvec3(pixel.r, pixel.g, pixel.b);
        }
        sum += ofRow * (weights[row] / image.width);
    }
    return sum;
}

// Rows from the zenith down, columns as kernels/emitters/envmap.clh has them: from -z over +x of the image, whose y is
// up.
glm::dvec3 directionOfSkyPixel(unsigned column, unsigned row, unsigned height) {
    const double polar = pi * row / (height - 1), turn = pi * (column + 0.5) / (height - 1);
    const double across = std::sin(polar);
    return {across * std::sin(turn), across * std::cos(turn), isHorizon(row, height) ? 0 : std::cos(polar)};
}

EnvironmentImage makeSkyImage(unsigned height, const glm::dmat3& axes, Rgb ground,
                              const std::function<Rgb(const glm::dvec3&)>& radiance) {
    EnvironmentImage image;
    image.width = 2 * (height - 1);
    image.height = height;
    image.axes = {axes[0], axes[2], -axes[1]};
    image.pixels.assign(size_t(image.width) * height, ground);
    for (unsigned row = 0; 2 * row <= height - 1; ++row)
        for (unsigned column = 0; column < image.width; ++column) {
            const Rgb seen = radiance(directionOfSkyPixel(column, row, height));
            image.pixels[size_t(row) * image.width + column] = isHorizon(row, height) ? middle(seen, ground) : seen;
        }
    return image;
}

void takeSunOffGround(EnvironmentImage& image) {
    const Rgb sun = image.groundBySun;
    for (unsigned row = image.height / 2; row < image.height; ++row) {
        const float share = isHorizon(row, image.height) ? 0.5f : 1.0f;
        for (unsigned column = 0; column < image.width; ++column) {
            Rgb& pixel = image.pixels[size_t(row) * image.width + column];
            // Not below 0 by rounding.
            pixel = {std::max(pixel.r - share * sun.r, 0.0f), std::max(pixel.g - share * sun.g, 0.0f),
                     std::max(pixel.b - share * sun.b, 0.0f)};
        }
    }
    image.groundBySun = {};
}

} // namespace quasilux

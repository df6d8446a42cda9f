#include "scene/skies/sky_image.h"

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

// Rows from the zenith down, columns as kernels/emitters/envmap.clh has them: from -z over +x of the image, whose y is up.
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

} // namespace quasilux

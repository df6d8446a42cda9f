#include "scene/skies/sun_disc.h"

#include "scene/skies/sky_image.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace quasilux {

namespace {

using std::numbers::pi;

constexpr unsigned coarsestRows = coarsestSkyHeight - 1, finestRows = 2 * coarsestRows; // half a turn
constexpr double pixelsAcross = 4;
constexpr int samplesAcrossPixel = 8; // along each side of a pixel

bool isOnDisc(const SunDisc& disc, const glm::dvec3& direction) {
    return direction.z >= 0 && glm::dot(direction, disc.towards) >= std::cos(disc.halfAngle);
}

/// Irradiance of a plane that faces the disc.
glm::dvec3 irradianceOf(const SunDisc& disc) {
    constexpr int rings = 128, sectors = 256;
    const glm::dvec3 side = glm::normalize(
        glm::cross(disc.towards, std::abs(disc.towards.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0)));
    const glm::dvec3 other = glm::cross(disc.towards, side);
    const double sine = std::sin(disc.halfAngle);
    glm::dvec3 sum{0};
    for (int ring = 0; ring < rings; ++ring) {
        const double across = sine * std::sqrt((ring + 0.5) / rings); // even by solid angle times cosine
        for (int sector = 0; sector < sectors; ++sector) {
            const double turn = 2 * pi * (sector + 0.5) / sectors;
            const glm::dvec3 direction = std::sqrt(1 - across * across) * disc.towards +
                                         across * (std::cos(turn) * side + std::sin(turn) * other);
            if (direction.z >= 0) sum += disc.radiance(direction);
        }
    }
    return sum * (pi * sine * sine / (rings * sectors));
}

/// Mean radiance over the pixel's own part of the sky; 0 outside of the disc.
glm::dvec3 meanOverPixel(const SunDisc& disc, unsigned column, unsigned row, unsigned height) {
    glm::dvec3 sum{0};
    double weight = 0;
    for (int j = 0; j < samplesAcrossPixel; ++j) {
        const double polar = pi * (row + (j + 0.5) / samplesAcrossPixel - 0.5) / (height - 1), across = std::sin(polar);
        if (across <= 0) continue; // beyond the zenith
        for (int i = 0; i < samplesAcrossPixel; ++i) {
            const double turn = pi * (column + (i + 0.5) / samplesAcrossPixel) / (height - 1);
            const glm::dvec3 direction(across * std::sin(turn), across * std::cos(turn), std::cos(polar));
            if (isOnDisc(disc, direction)) sum += across * disc.radiance(direction);
            weight += across;
        }
    }
    return sum / weight;
}

struct DiscPixel {
    size_t pixel;
    glm::dvec3 radiance;
};

} // namespace

double narrowestHalfAngle() { return pi / finestRows; }

unsigned skyHeightFor(double halfAngle) {
    const double rows = std::ceil(pi * pixelsAcross / (2 * halfAngle) / 2) * 2; // even: the horizon lies in the middle
    return static_cast<unsigned>(std::clamp<double>(rows, coarsestRows, finestRows)) + 1;
}

void addSunDisc(EnvironmentImage& sky, const SunDisc& disc) {
    const std::vector<double> solidAngles = solidAnglesOfRows(sky.height);
    const double reach = std::cos(std::min(disc.halfAngle + 2 * pi / (sky.height - 1), pi / 2));
    std::vector<DiscPixel> pixels;
    glm::dvec3 inImage{0};
    for (unsigned row = 0; 2 * row <= sky.height - 1; ++row)
        for (unsigned column = 0; column < sky.width; ++column) {
            const double cosine = glm::dot(directionOfSkyPixel(column, row, sky.height), disc.towards);
            if (cosine < reach) continue;
            const glm::dvec3 radiance = meanOverPixel(disc, column, row, sky.height);
            if (radiance == glm::dvec3(0)) continue;
            pixels.push_back({size_t(row) * sky.width + column, radiance});
            inImage += radiance * (solidAngles[row] / sky.width * cosine);
        }
    sky.hasSun = true;
    const glm::dvec3 irradiance = irradianceOf(disc);
    glm::dvec3 correction{0}; // the disc against its pixels
    for (int c = 0; c < 3; ++c) correction[c] = inImage[c] > 0 ? irradiance[c] / inImage[c] : 0;
    for (const DiscPixel& drawn : pixels) {
        const glm::dvec3 radiance = drawn.radiance * correction;
        Rgb& to = sky.pixels[drawn.pixel];
        to = {to.r + static_cast<float>(radiance.x), to.g + static_cast<float>(radiance.y),
              to.b + static_cast<float>(radiance.z)};
    }
}

} // namespace quasilux

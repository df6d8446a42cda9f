// Images of surroundings, how Mitsuba looks them up, and their integrals.
#pragma once

#include "scene/scene.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

namespace quasilux::test {

inline EnvironmentImage imageOf(unsigned width, unsigned height, const std::function<Rgb(unsigned, unsigned)>& pixel) {
    EnvironmentImage image{width, height, {}, glm::dmat3(1)};
    for (unsigned row = 0; row < height; ++row)
        for (unsigned column = 0; column < width; ++column) image.pixels.push_back(pixel(column, row));
    return image;
}

inline glm::dmat3 turned() {
    const glm::dvec3 x = glm::normalize(glm::dvec3(1, 2, -0.5)),
                     y = glm::normalize(glm::cross(x, glm::dvec3(0.3, -1, 0.8)));
    return {x, y, glm::cross(x, y)};
}

inline EnvironmentImage mitsubaImage() {
    return imageOf(6, 5, [](unsigned c, unsigned r) {
        return Rgb{float((c * 7 + r * 3) % 11 + 1) / 4, float((c + r) % 4) * 0.5f, 0.25f * float(r + 1)};
    });
}

struct NamedImage {
    const char* name;
    EnvironmentImage image;
};
// A coloured gradient, turned; a small sun in a dim sky; light from the poles' pixels alone; from the ring beside a
// pole alone; one pixel among black ones, mirrored; the fewest pixels; many pixels without contrast, which larger cells
// sample.
inline std::vector<NamedImage> images() {
    std::vector<NamedImage> all = {
        {"gradient", mitsubaImage()},
        {"sun", imageOf(144, 16,
                        [](unsigned c, unsigned r) {
                            return c == 9 && r == 4 ? Rgb{4000, 3000, 2000} : Rgb{0.1f, 0.2f, 0.3f};
                        })},
        {"poles", imageOf(8, 6,
                          [](unsigned c, unsigned r) {
                              return r % 5 == 0 ? Rgb{1, float(c), 0} : Rgb{};
                          })},
        {"ring", imageOf(8, 9,
                         [](unsigned c, unsigned r) {
                             return r == 1 || r == 7 ? Rgb{0, 1, float(c)} : Rgb{};
                         })},
        {"one", imageOf(9, 7,
                        [](unsigned c, unsigned r) {
                            return c == 0 && r == 3 ? Rgb{0, 5, 0} : Rgb{};
                        })},
        {"fewest", imageOf(1, 2,
                           [](unsigned, unsigned r) {
                               return Rgb{1, float(r + 1), 2};
                           })},
        {"smooth", imageOf(300, 141, [](unsigned c, unsigned r) {
             const float turn = 2 * std::numbers::pi_v<float> * (float(c) + 0.5f) / 300, down = float(r) / 140;
             return Rgb{1 + 0.8f * std::cos(turn), 1 + 0.5f * std::sin(turn) * down, 0.3f + down};
         })}};
    all[0].image.axes = turned();
    all[4].image.axes = turned() * glm::dmat3(-1, 0, 0, 0, 1, 0, 0, 0, 1);
    return all;
}

// Mitsuba's lookup, in double precision.
inline glm::dvec3 lookUp(const EnvironmentImage& image, const glm::dvec3& direction) {
    const glm::dvec3 d = glm::transpose(image.axes) * direction;
    const double turns = std::atan2(d.x, -d.z) / (2 * std::numbers::pi),
                 x = (turns - std::floor(turns)) * image.width - 0.5;
    const double y = std::acos(std::clamp(d.y, -1.0, 1.0)) / std::numbers::pi * (image.height - 1);
    const int column = int(std::floor(x)), row = std::min(int(y), int(image.height) - 2);
    const auto at = [&](int c, int r) {
        const Rgb& p = image.pixels[size_t(r) * image.width + size_t(c + int(image.width)) % image.width];
        return glm::dvec3(p.r, p.g, p.b);
    };
    return glm::mix(glm::mix(at(column, row), at(column + 1, row), x - column),
                    glm::mix(at(column, row + 1), at(column + 1, row + 1), x - column), y - row);
}

inline glm::dvec3 directionOf(double cosine, double azimuth) {
    const double sine = std::sqrt(1 - cosine * cosine);
    return {sine * std::sin(azimuth), cosine, -sine * std::cos(azimuth)};
}

// Midpoint rule over cosine and azimuth about the image's own axes.
inline glm::dvec3 integral(const EnvironmentImage& image, const std::function<double(const glm::dvec3&)>& weight) {
    constexpr int cosines = 2000, azimuths = 720;
    glm::dvec3 sum(0);
    for (int i = 0; i < cosines; ++i)
        for (int j = 0; j < azimuths; ++j) {
            const glm::dvec3 d =
                image.axes * directionOf(2 * (i + 0.5) / cosines - 1, 2 * std::numbers::pi * (j + 0.5) / azimuths);
            if (const double w = weight(d); w != 0) sum += w * lookUp(image, d);
        }
    return sum * (4 * std::numbers::pi / (cosines * azimuths));
}

} // namespace quasilux::test

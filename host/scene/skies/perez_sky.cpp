#include "scene/skies/perez_sky.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace quasilux {

namespace {

using std::numbers::pi;

constexpr size_t categories = 8; // of clearness, from overcast to clear
constexpr std::array<double, categories - 1> categoryEnds = {1.065, 1.23, 1.5, 1.95, 2.8, 4.5, 6.2}; // 1990, table 1

struct Four {
    double x1, x2, x3, x4;
};

// 1993, table 1: a, b, c, d, e of each category.
constexpr std::array<std::array<Four, 5>, categories> shapes = {{
    {{{1.3525, -0.2576, -0.2690, -1.4366},
      {-0.7670, 0.0007, 1.2734, -0.1233},
      {2.8000, 0.6004, 1.2375, 1.0000},
      {1.8734, 0.6297, 0.9738, 0.2809},
      {0.0356, -0.1246, -0.5718, 0.9938}}},
    {{{-1.2219, -0.7730, 1.4148, 1.1016},
      {-0.2054, 0.0367, -3.9128, 0.9156},
      {6.9750, 0.1774, 6.4477, -0.1239},
      {-1.5798, -0.5081, -1.7812, 0.1080},
      {0.2624, 0.0672, -0.2190, -0.4285}}},
    {{{-1.1000, -0.2515, 0.8952, 0.0156},
      {0.2782, -0.1812, -4.5000, 1.1766},
      {24.7219, -13.0812, -37.7000, 34.8438},
      {-5.0000, 1.5218, 3.9229, -2.6204},
      {-0.0156, 0.1597, 0.4199, -0.5562}}},
    {{{-0.5484, -0.6654, -0.2672, 0.7117},
      {0.7234, -0.6219, -5.6812, 2.6297},
      {33.3389, -18.3000, -62.2500, 52.0781},
      {-3.5000, 0.0016, 1.1477, 0.1062},
      {0.4659, -0.3296, -0.0876, -0.0329}}},
    {{{-0.6000, -0.3566, -2.5000, 2.3250},
      {0.2937, 0.0496, -5.6812, 1.8415},
      {21.0000, -4.7656, -21.5906, 7.2492},
      {-3.5000, -0.1554, 1.4062, 0.3988},
      {0.0032, 0.0766, -0.0656, -0.1294}}},
    {{{-1.0156, -0.3670, 1.0078, 1.4051},
      {0.2875, -0.5328, -3.8500, 3.3750},
      {14.0000, -0.9999, -7.1406, 7.5469},
      {-3.4000, -0.1078, -1.0750, 1.5702},
      {-0.0672, 0.4016, 0.3017, -0.4844}}},
    {{{-1.0000, 0.0211, 0.5025, -0.5119},
      {-0.3000, 0.1922, 0.7023, -1.6317},
      {19.0000, -5.0000, 1.2438, -1.9094},
      {-4.0000, 0.0250, 0.3844, 0.2656},
      {1.0468, -0.3788, -2.4517, 1.4656}}},
    {{{-1.0500, 0.0289, 0.4260, 0.3590},
      {-0.3250, 0.1156, 0.7781, 0.0025},
      {31.0625, -14.5000, -46.1148, 55.3750},
      {-7.2312, 0.4050, 13.3500, 0.6234},
      {1.5000, -0.6426, 1.8564, 0.5636}}},
}};

// 1990, table 4.
constexpr std::array<Four, categories> diffuseEfficacies = {{{97.24, -0.46, 12.00, -8.91},
                                                             {107.22, 1.15, 0.59, -3.95},
                                                             {104.97, 2.96, -5.53, -8.77},
                                                             {102.39, 5.59, -13.95, -13.90},
                                                             {100.71, 5.94, -22.75, -23.74},
                                                             {106.42, 3.83, -36.15, -28.83},
                                                             {141.88, 1.90, -53.24, -14.03},
                                                             {152.23, 0.35, -45.27, -7.98}}};
constexpr std::array<Four, categories> directEfficacies = {{{57.20, -4.55, -2.98, 117.12},
                                                            {98.99, -3.46, -1.21, 12.38},
                                                            {109.83, -4.90, -1.71, -8.81},
                                                            {110.34, -5.84, -1.99, -4.56},
                                                            {106.36, -3.97, -1.75, -6.16},
                                                            {107.19, -1.25, -1.51, -26.73},
                                                            {105.75, 0.77, -1.26, -34.44},
                                                            {101.18, 1.58, -1.10, -8.29}}};

constexpr double solarConstant = 1367; // W/m^2, as in 1990
constexpr double darkest = 0.01;       // brightness, below which nothing was measured

size_t categoryOf(double clearness) {
    return static_cast<size_t>(std::upper_bound(categoryEnds.begin(), categoryEnds.end(), clearness) -
                               categoryEnds.begin());
}

/// Path through the air over that from the zenith (Kasten 1966). `zenith` in radians.
double airMass(double zenith) { return 1 / (std::cos(zenith) + 0.15 * std::pow(93.885 - zenith * 180 / pi, -1.253)); }

std::array<double, 5> shapeOf(size_t category, double zenith, double brightness) {
    const auto& p = shapes.at(category);
    // Skies with little cloud have never been seen darker (as in Radiance's gendaylit).
    if (category > 0 && category < 5) brightness = std::max(brightness, 0.2);
    std::array<double, 5> found{};
    for (size_t k = 0; k < found.size(); ++k) {
        const Four& x = p.at(k);
        found.at(k) = x.x1 + x.x2 * zenith + brightness * (x.x3 + x.x4 * zenith); // 1993, eq. 6
    }
    if (category == 0) { // eqs. 7 and 8
        const Four &c = p[2], &d = p[3];
        found[2] = std::exp(std::pow(brightness * (c.x1 + c.x2 * zenith), c.x3)) - c.x4;
        found[3] = -std::exp(brightness * (d.x1 + d.x2 * zenith)) + d.x3 + brightness * d.x4;
    }
    return found;
}

} // namespace

PerezSky::PerezSky(const Radiation& radiation, const glm::dvec3& sun) : sun_(sun) {
    const double zenith = std::acos(std::clamp(sun.z, 0.0, 1.0)), cubed = 1.041 * zenith * zenith * zenith;
    clearness_ = ((radiation.diffuseHorizontal + radiation.directNormal) / radiation.diffuseHorizontal + cubed) /
                 (1 + cubed); // 1990, eq. 1
    brightness_ = std::max(airMass(zenith) * radiation.diffuseHorizontal / (solarConstant * radiation.sunNearness),
                           darkest); // eq. 2
    const size_t category = categoryOf(clearness_);
    const double water = std::exp(0.07 * radiation.dewPoint - 0.075); // cm, eq. 3
    const Four &diffuse = diffuseEfficacies.at(category), &direct = directEfficacies.at(category);
    diffuseEfficacy_ = // eq. 7
        diffuse.x1 + diffuse.x2 * water + diffuse.x3 * std::cos(zenith) + diffuse.x4 * std::log(brightness_);
    directEfficacy_ = std::max( // eq. 8
        direct.x1 + direct.x2 * water + direct.x3 * std::exp(5.73 * zenith - 5) + direct.x4 * brightness_, 0.0);
    shape_ = shapeOf(category, zenith, brightness_);
}

Radiation radiationOfIlluminances(double directNormal, double diffuseHorizontal, Radiation about,
                                  const glm::dvec3& sun) {
    constexpr int steps = 200;
    static constexpr double usual = 110, least = 20; // lm/W
    about.directNormal = directNormal / usual;
    about.diffuseHorizontal = diffuseHorizontal / usual;
    for (int step = 0; step < steps; ++step) {
        const PerezSky sky(about, sun);
        const auto towardsStated = [](double now, double stated, double efficacy) {
            return 0.8 * now + 0.2 * stated / std::max(efficacy, least);
        };
        about.directNormal = towardsStated(about.directNormal, directNormal, sky.directEfficacy());
        about.diffuseHorizontal = towardsStated(about.diffuseHorizontal, diffuseHorizontal, sky.diffuseEfficacy());
    }
    return about;
}

double PerezSky::luminance(const glm::dvec3& direction) const {
    if (direction.z < 0) return 0;
    const auto& [a, b, c, d, e] = shape_;
    const double cosine = std::clamp(glm::dot(direction, sun_), -1.0, 1.0);
    // 1993, eq. 1. b is positive for a few bright, clear skies, whose horizon is that of half a degree above it.
    const double gradation = 1 + a * std::exp(b / std::max(direction.z, 0.01));
    return std::max(gradation * (1 + c * std::exp(d * std::acos(cosine)) + e * cosine * cosine), 0.0);
}

} // namespace quasilux

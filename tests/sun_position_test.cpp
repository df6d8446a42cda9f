// Where the sun stands, against the published example of NREL's solar position algorithm (Reda & Andreas,
// NREL/TP-560-34302, 2004) and against values of the algorithm itself as the Python package pvlib 0.16.1 has it
// (spa.solar_position_numpy, without refraction).
#include "scene/skies/sun_position.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace quasilux {
namespace {

constexpr double degree = std::numbers::pi / 180, allowed = 0.01;

double between(const SunPosition& sun, double azimuth, double elevation) {
    return std::acos(glm::dot(towards(sun), towards({azimuth * degree, elevation * degree}))) / degree;
}

TEST(SunPosition, IsThatOfThePublishedExample) {
    SunPosition sun = sunPosition({39.742476, -105.1786}, {2003, 10, 17, 12 + 30.0 / 60 + 30.0 / 3600, -7});
    EXPECT_NEAR(sun.elevation / degree, 39.872046, allowed) << "table A5.1, without refraction";
    EXPECT_NEAR(sun.azimuth / degree + 360, 194.34024, allowed);
    sun.elevation += refraction(sun.elevation, 820, 11);
    EXPECT_NEAR(90 - sun.elevation / degree, 50.11162, allowed);
}

struct Known {
    int year, month, day;
    double hour, latitude, longitude, azimuth, elevation; // universal time; degrees
};
const Known known[] = {
    {1950, 2, 4, 11.98, 13.4, -169.7, 115.64951, -83.07538},  {1960, 6, 5, 22.28, -56.7, -133.3, 340.19091, 8.66691},
    {1970, 10, 27, 14.93, -17.3, 4.1, 267.54947, 39.65098},   {1980, 6, 19, 6.61, -47.8, 103.7, 338.54550, 15.94541},
    {1990, 3, 19, 12.3, 41.8, 17.7, 208.68036, 43.87254},     {2000, 12, 28, 4.91, 7.1, -5.9, 112.32968, -23.57062},
    {2010, 12, 10, 14.2, -34.9, 108.8, 216.30978, -22.64877}, {2020, 11, 25, 3.09, -4.3, -80.2, 228.92906, -50.86593},
    {2030, 1, 3, 21.5, -9.2, -126.8, 224.07600, 70.57447},    {2040, 11, 19, 4.85, 53, -101.8, 319.77269, -51.25557},
    {2050, 8, 1, 4.82, -20.4, -11.2, 81.62939, -34.06149},    {2060, 5, 26, 16.74, -21.2, -173.9, 73.56807, -18.28274},
    {2070, 4, 5, 23.91, -5.3, 68.8, 85.20476, -23.55370},     {2080, 11, 2, 0.82, 45.7, 31.6, 68.56551, -39.50397},
    {2090, 1, 9, 7.62, -54.2, -117.8, 185.03133, -13.66164},  {2100, 6, 1, 20.14, -4.4, -134.2, 22.71746, 61.12310},
};

TEST(SunPosition, IsNrelsFrom1950To2100) {
    for (const Known& k : known) {
        const SunPosition sun = sunPosition({k.latitude, k.longitude}, {k.year, k.month, k.day, k.hour, 0});
        EXPECT_LT(between(sun, k.azimuth, k.elevation), allowed) << k.year << '-' << k.month << '-' << k.day;
    }
}

// The sun moves by 0.01 degrees in 2.4 seconds.
TEST(SunPositionControl, FiveSecondsShow) {
    int missed = 0;
    for (const Known& k : known) {
        const SunPosition sun =
            sunPosition({k.latitude, k.longitude}, {k.year, k.month, k.day, k.hour + 5.0 / 3600, 0});
        if (between(sun, k.azimuth, k.elevation) > allowed) ++missed;
    }
    EXPECT_EQ(missed, static_cast<int>(std::size(known)));
}

TEST(SunPosition, ZonesAreHoursAheadOfUniversalTime) {
    const SunPosition here = sunPosition({10, 20}, {2024, 2, 29, 12, 5.5}),
                      there = sunPosition({10, 20}, {2024, 2, 29, 6.5, 0});
    EXPECT_NEAR(here.azimuth, there.azimuth, 1e-9);
    EXPECT_NEAR(here.elevation, there.elevation, 1e-9);
}

TEST(SunPosition, AirLiftsItByHalfADegreeAtTheHorizon) {
    EXPECT_NEAR(refraction(0, 1010, 10) / degree, 0.4830, 1e-4);
    EXPECT_NEAR(refraction(45 * degree, 1010, 10) / degree, 0.0168, 0.0002);
    EXPECT_EQ(refraction(-1 * degree, 1010, 10), 0);
}

} // namespace
} // namespace quasilux

// Coefficients of the Hosek-Wilkie sky and sun; their licence stands in the files that hold them.
#pragma once

namespace quasilux {

inline constexpr int hosekWilkieTurbidities = 10;    ///< 1, 2, ... 10
inline constexpr int hosekWilkieControlPoints = 6;   ///< by the third root of the sun's elevation
inline constexpr int hosekWilkieShapeParameters = 9; ///< A to G, I, H of the formula
inline constexpr int hosekWilkieSunElevations = 46;  ///< pi/2 (k/45)^3
inline constexpr int hosekWilkieLimbPowers = 6;      ///< of the cosine on the sun's surface

/// By turbidity, albedo (0 and 1), control point, channel, parameter.
extern const double hosekWilkieSkyShape[hosekWilkieTurbidities * 2 * 6 * 3 * 9];
/// By turbidity, albedo, control point, channel.
extern const double hosekWilkieSkyRadiance[hosekWilkieTurbidities * 2 * 6 * 3];
/// By turbidity, elevation, channel, power.
extern const double hosekWilkieSun[hosekWilkieTurbidities * hosekWilkieSunElevations * 3 * 6];

} // namespace quasilux

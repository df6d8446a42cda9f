// The developed film: means over passes and their standard error. Row 0 is the top; pixels are interleaved RGB.
#pragma once

#include "shared_types.h"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace quasilux {

struct FilmImage {
    unsigned width = 0, height = 0;
    unsigned passes = 0;
    std::vector<float> radiance;      ///< width*height*3, W sr^-1 m^-2: the sum of the components
    std::vector<float> standardError; ///< width*height*3, of `radiance`, from independent passes
    /// By FILM component (LIGHT_* and FILM_EMISSION), each width*height*3, or empty where the scene has no such light.
    std::array<std::vector<float>, FILM_COMPONENTS> components;
    /// Their standard errors, by LIGHT_*.
    std::array<std::vector<float>, LIGHT_CLASSES> componentError;

    /// Estimate of the bias that the density radius leaves in `radiance`, and the standard error of that estimate:
    /// width*height*3, W sr^-1 m^-2; empty where it was not estimated (docs/method/accuracy.md).
    std::vector<float> bias, biasError;
    /// The same by LIGHT_*; empty, too, where the scene has no such light.
    std::array<std::vector<float>, LIGHT_CLASSES> componentBias, componentBiasError;

    /// Or else the image is black, or its film kept none.
    bool hasComponents() const {
        return std::any_of(components.begin(), components.end(), [](const auto& one) { return !one.empty(); });
    }
};

/// Layer name of a component: "direct", "caustic", "quasi_caustic", "diffuse", "emission".
std::string componentName(unsigned component);

} // namespace quasilux

// The developed film: means over passes and their standard error. Row 0 is the top; pixels are interleaved RGB.
#pragma once

#include "shared_types.h"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace quasilux {

/// Radiance by pixel and channel (W sr^-1 m^-2) and what is known of its error. Each has width*height*3 values or is empty.
struct RadianceEstimate {
    std::vector<float> radiance;      ///< mean over passes
    std::vector<float> standardError; ///< of `radiance`, from independent passes
    /// Estimate of the bias that the density radius leaves in `radiance`, and the standard error of that estimate; empty
    /// where it was not estimated (docs/method/accuracy.md).
    std::vector<float> bias, biasError;

    void resize(size_t values, bool hasError, bool hasBias) {
        radiance.resize(values);
        standardError.resize(hasError ? values : 0);
        bias.resize(hasBias ? values : 0);
        biasError.resize(hasBias ? values : 0);
    }
    void dropBias() {
        bias.clear();
        biasError.clear();
    }
    bool operator==(const RadianceEstimate&) const = default;
};

/// The whole image, the sum of its components.
struct FilmImage : RadianceEstimate {
    unsigned width = 0, height = 0;
    unsigned passes = 0;
    /// Batches of passes, complete or not, that `standardError` is from: single passes at first, later several in a row.
    unsigned batches = 0;
    /// By FILM component (LIGHT_* and FILM_EMISSION, which has no error); empty where the scene has no such light.
    std::array<RadianceEstimate, FILM_COMPONENTS> components;

    /// Or else the values of `standardError` say nothing.
    bool isErrorKnown() const { return batches > 1 && !standardError.empty(); }
    /// Or else the image is black, or its film kept none.
    bool hasComponents() const {
        return std::any_of(components.begin(), components.end(), [](const auto& one) { return !one.radiance.empty(); });
    }
};

/// Layer name of a component: "direct", "caustic", "quasi_caustic", "diffuse", "emission".
std::string componentName(unsigned component);

} // namespace quasilux

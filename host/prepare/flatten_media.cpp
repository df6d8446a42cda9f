// Media into the kernels' table, with the first size of their density kernels (docs/method/volume-density.md).
#include "prepare/device_scene.h"
#include "prepare/medium_shape.h"
#include "prepare/pack.h"
#include "scene/color.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace quasilux {

namespace {

using std::numbers::pi;

// Photons that a ball is to hold in pass 0, were the collisions of a pass spread evenly.
constexpr double photonsInBall = 200;
constexpr double largestBall = 0.05;  // of the extent
constexpr double causticFactor = 0.5; // on it: focused light varies faster
// Of a flat kernel. Light in a plate varies over its thickness along it; across it, that which has not scattered yet
// varies over a mean free path, the rest over a transport mean free path or the thickness.
constexpr double flatRadius = 1.4;            // of the thickness
constexpr double flatHeightUnscattered = 0.5; // of the mean free path
constexpr double flatHeightScattered = 0.5;   // of the transport mean free path
constexpr double flatHeightOfThickness = 0.1;

struct KernelSize {
    double radius = 0, halfHeight = 0;
};

KernelSize flatKernel(const MediumDescription& medium, const MediumShape& shape, unsigned lightClass) {
    const double freePath = 1 / std::max(mean(medium.sigmaT), 1e-30);
    const double transportPath = freePath / (1 - mean(medium.albedo) * medium.g);
    const bool unscattered = lightClass == LIGHT_DIRECT || lightClass == LIGHT_CAUSTIC;
    const double height = unscattered ? flatHeightUnscattered * freePath : flatHeightScattered * transportPath;
    return {flatRadius * shape.thickness, std::min(height, flatHeightOfThickness * shape.thickness)};
}

KernelSize ballKernel(const MediumDescription& medium, const MediumShape& shape, unsigned photons,
                      unsigned lightClass) {
    const double opticalDepth = mean(medium.sigmaT) * shape.extent;
    const double collisions = photons * std::max(opticalDepth, 1e-3);
    const double radius = std::cbrt(photonsInBall * shape.volume / (4.0 / 3 * pi * collisions));
    const double factor = lightClass == LIGHT_CAUSTIC ? causticFactor : 1.0;
    return {factor * std::min(radius, largestBall * shape.extent), 0};
}

} // namespace

MediumTables flattenMedia(const Scene& scene, const std::vector<MediumDecision>& split, unsigned photons) {
    MediumTables tables;
    for (unsigned k = 0; k < scene.media.size(); ++k) {
        const auto& description = scene.media[k];
        const MediumShape shape = findMediumShape(scene, k);
        shared::Medium medium{};
        medium.phase = description.phase;
        medium.g = static_cast<float>(description.g);
        medium.sigmaT = description.sigmaT;
        medium.albedo = description.albedo;
        medium.level = split[k].level;
        medium.genuineDiffuseShare = static_cast<float>(split[k].genuineDiffuseShare);
        medium.kernelAxis = pack(shape.axis);
        for (unsigned c = 0; c < LIGHT_CLASSES; ++c) {
            const KernelSize size =
                shape.isPlate ? flatKernel(description, shape, c) : ballKernel(description, shape, photons, c);
            medium.kernelRadius[c] = static_cast<float>(size.radius);
            medium.kernelHalfHeight[c] = static_cast<float>(size.halfHeight);
        }
        medium.firstPlane = static_cast<unsigned>(tables.planes.size());
        medium.planeCount = static_cast<unsigned>(shape.planes.size());
        tables.planes.insert(tables.planes.end(), shape.planes.begin(), shape.planes.end());
        tables.media.push_back(medium);
    }
    return tables;
}

} // namespace quasilux

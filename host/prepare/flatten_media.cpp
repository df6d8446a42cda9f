// Media into the kernels' table, with the first size of their density kernels (docs/method/volume-density.md).
#include "prepare/bounding_sphere.h"
#include "prepare/device_scene.h"
#include "prepare/medium_shape.h"
#include "prepare/pack.h"
#include "prepare/scene_tables.h"
#include "prepare/volume_tables.h"
#include "scene/color.h"

#include <algorithm>
#include <cmath>
#include <limits>
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

/// Of what the medium fills: no more than the box of its extinction.
MediumShape withinBox(MediumShape shape, const shared::VolumeGrid& grid) {
    const glm::dvec3 extent(double(grid.upper.x) - grid.lower.x, double(grid.upper.y) - grid.lower.y,
                            double(grid.upper.z) - grid.lower.z);
    shape.isPlate = false;
    shape.volume = std::min(shape.volume, extent.x * extent.y * extent.z);
    shape.extent = std::min(shape.extent, std::max({extent.x, extent.y, extent.z}));
    return shape;
}

// Densities and the shares of the scattering below each, as PhasePart has them.
void appendTable(const std::vector<double>& densities, std::vector<float>& values) {
    const double step = 2.0 / static_cast<double>(densities.size() - 1);
    std::vector<double> below = {0};
    for (size_t i = 0; i + 1 < densities.size(); ++i)
        below.push_back(below.back() + pi * step * (densities[i] + densities[i + 1]));
    for (const double density : densities) values.push_back(static_cast<float>(density));
    for (const double share : below) values.push_back(static_cast<float>(share / below.back()));
}

void appendParts(const MediumDescription& description, shared::Medium& medium, MediumTables& tables) {
    medium.firstPart = static_cast<unsigned>(tables.parts.size());
    medium.partCount = static_cast<unsigned>(description.phaseParts.size());
    double sum = 0;
    for (const PhasePartDescription& described : description.phaseParts) {
        shared::PhasePart part{};
        sum += described.weight;
        part.phase = described.phase;
        part.g = static_cast<float>(described.g);
        part.weight = static_cast<float>(described.weight);
        part.weightCdf = &described == &description.phaseParts.back() ? 1.f : static_cast<float>(sum);
        part.firstValue = static_cast<unsigned>(tables.values.size());
        part.valueCount = static_cast<unsigned>(described.values.size());
        if (!described.values.empty()) appendTable(described.values, tables.values);
        tables.parts.push_back(part);
    }
}

// Beyond it roulette ends paths in a medium without a border: timesBeyondScene() in kernels/medium.clh.
void setReach(const Scene& scene, shared::Medium& medium) {
    const Sphere bounds = boundingSphere(scene);
    const glm::dvec3 camera = scene.sensor.toWorld[3], center = bounds.center;
    double extinction = std::numeric_limits<double>::infinity(); // the smallest that hinders anything
    for (const float channel : {medium.sigmaT.r, medium.sigmaT.g, medium.sigmaT.b})
        if (channel > 0) extinction = std::min(extinction, double(channel));
    const double reach = std::max(double(bounds.radius), glm::distance(camera, center)) + 1 / extinction;
    medium.sceneCenter = pack(center);
    medium.inverseReach = static_cast<float>(1 / reach);
}

} // namespace

unsigned appendMedia(MediumTables tables, SceneTableWriter& words) {
    constexpr size_t perMedium = sizeof(shared::Medium) / 4, perGrid = sizeof(shared::VolumeGrid) / 4,
                     perPart = sizeof(shared::PhasePart) / 4;
    const size_t grids = perMedium * tables.media.size(), parts = grids + perGrid * tables.grids.size(),
                 values = parts + perPart * tables.parts.size(); // words from the first medium on
    for (size_t k = 0; k < tables.media.size(); ++k) {
        shared::Medium& medium = tables.media[k];
        for (unsigned* grid : {&medium.extinctionGrid, &medium.albedoGrid})
            if (*grid != 0) *grid = static_cast<unsigned>(grids + perGrid * (*grid - 1) - perMedium * k);
        medium.firstPart = static_cast<unsigned>(parts + perPart * medium.firstPart - perMedium * k);
    }
    for (size_t k = 0; k < tables.grids.size(); ++k)
        tables.grids[k].firstValue += static_cast<unsigned>(values - grids - perGrid * k);
    for (size_t k = 0; k < tables.parts.size(); ++k)
        tables.parts[k].firstValue += static_cast<unsigned>(values - parts - perPart * k);
    const unsigned first = words.append(tables.media);
    words.append(tables.grids);
    words.append(tables.parts);
    words.append(tables.values);
    return first;
}

MediumTables flattenMedia(const Scene& scene, const std::vector<MediumDecision>& split, unsigned photons) {
    MediumTables tables;
    for (const VolumeDescription& volume : scene.volumes) appendVolume(volume, tables);
    for (unsigned k = 0; k < scene.media.size(); ++k) {
        const auto& description = scene.media[k];
        MediumShape shape = findMediumShape(scene, k);
        if (description.extinction) shape = withinBox(std::move(shape), tables.grids[*description.extinction]);
        shared::Medium medium{};
        medium.phase = description.phase;
        medium.g = static_cast<float>(description.g);
        appendParts(description, medium, tables);
        medium.sigmaT = description.sigmaT;
        medium.albedo = description.albedo;
        medium.extinctionGrid = description.extinction ? *description.extinction + 1 : 0;
        medium.albedoGrid = description.albedoVolume ? *description.albedoVolume + 1 : 0;
        medium.extinctionScale = description.extinctionScale;
        medium.level = split[k].level;
        medium.genuineDiffuseShare = static_cast<float>(split[k].genuineDiffuseShare);
        medium.kernelAxis = pack(shape.axis);
        for (unsigned c = 0; c < LIGHT_CLASSES; ++c) {
            const KernelSize size =
                shape.isPlate ? flatKernel(description, shape, c) : ballKernel(description, shape, photons, c);
            medium.kernelRadius[c] = static_cast<float>(size.radius);
            medium.kernelHalfHeight[c] = static_cast<float>(size.halfHeight);
        }
        if (shape.isUnbounded && !description.extinction) setReach(scene, medium);
        medium.firstPlane = static_cast<unsigned>(tables.planes.size());
        medium.planeCount = static_cast<unsigned>(shape.planes.size());
        tables.planes.insert(tables.planes.end(), shape.planes.begin(), shape.planes.end());
        tables.media.push_back(medium);
    }
    return tables;
}

} // namespace quasilux

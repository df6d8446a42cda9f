#include "render/coarse_camera.h"

#include <algorithm>
#include <cmath>

namespace quasilux {

namespace {

constexpr double coarseSide = 128; // of the image at most, about

} // namespace

unsigned coarseBlock(const shared::Camera& camera) {
    return static_cast<unsigned>(
        std::max(1.0, std::ceil(std::sqrt(double(camera.width) * camera.height) / coarseSide)));
}

shared::Camera coarseCamera(shared::Camera camera, unsigned block) {
    camera.width = (camera.width + block - 1) / block;
    camera.height = (camera.height + block - 1) / block;
    for (auto* step : {&camera.stepX, &camera.stepY}) {
        step->x *= static_cast<float>(block);
        step->y *= static_cast<float>(block);
        step->z *= static_cast<float>(block);
    }
    return camera;
}

} // namespace quasilux

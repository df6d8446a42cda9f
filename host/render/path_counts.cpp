#include "render/path_counts.h"

#include "render/coarse_camera.h"

#include <algorithm>

namespace quasilux {

namespace {

uint64_t sumOver(const shared::Camera& camera, unsigned block, const std::vector<uint32_t>& counts) {
    const unsigned columns = (camera.width + block - 1) / block;
    uint64_t sum = 0;
    for (size_t k = 0; k < counts.size(); ++k) {
        const uint64_t x = k % columns * block, y = k / columns * block;
        sum += counts[k] * (std::min<uint64_t>(camera.width, x + block) - x) *
               (std::min<uint64_t>(camera.height, y + block) - y);
    }
    return sum;
}

PlannedBuffer<uint32_t> countsOf(size_t blocks, const std::string& owner) {
    return {owner + "camera paths by block", blocks};
}

} // namespace

PathCounts::PathCounts(Device& device, const shared::Camera& camera, uint32_t paths, const std::string& owner)
    : PathCounts(device, camera, std::max(camera.width, camera.height), {paths}, owner) {}

PathCounts::PathCounts(Device& device, const shared::Camera& camera, unsigned block,
                       const std::vector<uint32_t>& counts, const std::string& owner)
    : counts_(countsOf(counts.size(), owner).make(device)), block_(block), sum_(sumOver(camera, block, counts)) {
    counts_.write(counts);
}

BufferSizes PathCounts::plan(const shared::Camera& camera, bool byBlock, const std::string& owner) {
    const shared::Camera coarse = coarseCamera(camera, coarseBlock(camera));
    return sizesOf(countsOf(byBlock ? size_t{coarse.width} * coarse.height : 1, owner));
}

} // namespace quasilux

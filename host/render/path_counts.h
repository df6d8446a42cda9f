// How many camera paths each pixel has in a pass, on the device (pathsAt() in kernels/camera_paths.cl).
#pragma once

#include "pass_types.h"
#include "render/planned_buffer.h"

#include <vector>

namespace quasilux {

class PathCounts {
public:
    /// All pixels of `camera` have so many. `owner`: put before the buffer's name.
    PathCounts(Device& device, const shared::Camera& camera, uint32_t paths, const std::string& owner = "");
    /// By block of `block` x `block` pixels.
    PathCounts(Device& device, const shared::Camera& camera, unsigned block, const std::vector<uint32_t>& counts,
               const std::string& owner = "");

    /// The counts of a camera, of one block or of coarseBlock() pixels each, by label.
    static BufferSizes plan(const shared::Camera& camera, bool byBlock, const std::string& owner = "");

    const Buffer<uint32_t>& counts() const { return counts_; }
    /// CameraParams::pathBlock.
    unsigned block() const { return block_; }
    /// Of all pixels.
    uint64_t sum() const { return sum_; }

private:
    Buffer<uint32_t> counts_;
    unsigned block_;
    uint64_t sum_ = 0;
};

} // namespace quasilux

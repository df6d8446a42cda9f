// What textures are where rays hit a scene.
#pragma once

#include "prepare/device_scene.h"
#include "support/test_kernels.h"

#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace quasilux::test {

constexpr glm::vec3 down{0, 0, -1};

struct RayFrom {
    glm::vec3 origin, direction;
};
/// The factor on the first lobe where rays hit, as the kernels have it.
inline std::vector<glm::vec3> tintsAt(const Scene& scene, const std::vector<RayFrom>& rays,
                                      const std::string& options = "") {
    const DeviceScene flat = flattenScene(scene);
    EXPECT_TRUE(flat.features.textures);
    Device& device = testDevice();
    Program program = testProgram("textures.cl", flat.features.options() + " " + bvhOptions(flat.bvh) + options);
    Buffer<shared::BvhNode> nodes(device, flat.bvh.nodes, "nodes");
    Buffer<shared::PrimitiveBlock> blocks(device, flat.bvh.blocks, "blocks");
    Buffer<uint32_t> tables(device, flat.tables, "tables");
    std::vector<float> numbers;
    for (const RayFrom& ray : rays)
        for (const glm::vec3& v : {ray.origin, ray.direction}) numbers.insert(numbers.end(), {v.x, v.y, v.z});
    Buffer<float> in(device, numbers, "rays"), out(device, 3 * rays.size(), "tints");
    program.kernel("tintsAtHits")
        .launch(rays.size(), nodes, blocks, tables, in, out, flat.offsets, cl_uint(rays.size()));
    const auto values = out.read();
    std::vector<glm::vec3> tints;
    for (size_t k = 0; k < rays.size(); ++k) tints.emplace_back(values[3 * k], values[3 * k + 1], values[3 * k + 2]);
    return tints;
}

} // namespace quasilux::test

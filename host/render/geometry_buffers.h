// The scene on the device: read by photons and camera paths alike.
#pragma once

#include "device/buffer.h"
#include "prepare/device_scene.h"

namespace quasilux {

struct GeometryBuffers {
    GeometryBuffers(Device& device, const DeviceScene& scene)
        : nodes(device, scene.bvh.nodes, "tree nodes"), blocks(device, scene.bvh.blocks, "primitives"),
          tables(device, scene.tables, "scene tables") {}

    Buffer<shared::BvhNode> nodes;
    Buffer<shared::PrimitiveBlock> blocks;
    Buffer<uint32_t> tables;
};

} // namespace quasilux

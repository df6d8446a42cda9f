// The scene on the device: read by photons and camera paths alike.
#pragma once

#include "prepare/device_scene.h"
#include "render/planned_buffer.h"

namespace quasilux {

struct GeometryBuffers {
    GeometryBuffers(Device& device, const DeviceScene& scene)
        : nodes(device, scene.bvh.nodes, nodesLabel), blocks(device, scene.bvh.blocks, blocksLabel),
          tables(device, scene.tables, tablesLabel) {}

    static constexpr const char *nodesLabel = "tree nodes", *blocksLabel = "primitives", *tablesLabel = "scene tables";
    static BufferSizes plan(const DeviceScene& scene) {
        return sizesOf(PlannedBuffer<shared::BvhNode>{nodesLabel, scene.bvh.nodes.size()},
                       PlannedBuffer<shared::PrimitiveBlock>{blocksLabel, scene.bvh.blocks.size()},
                       PlannedBuffer<uint32_t>{tablesLabel, scene.tables.size()});
    }

    Buffer<shared::BvhNode> nodes;
    Buffer<shared::PrimitiveBlock> blocks;
    Buffer<uint32_t> tables;
};

} // namespace quasilux

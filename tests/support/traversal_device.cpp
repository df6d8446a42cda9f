#include "support/traversal_device.h"

#include "device/kernel_sources.h"

#include <fstream>
#include <sstream>
#include <stdexcept>

namespace quasilux {

Program mutantProgram(const std::string& file, const std::string& options, KernelSources replaced) {
    if (replaced.empty()) return testProgram(file, options);
    std::ifstream stream(std::string(QUASILUX_SOURCE_DIR) + "/tests/kernels/" + file);
    std::ostringstream text;
    text << stream.rdbuf();
    replaced[file] = text.str();
    return Program(testDevice(), file, options, replaced);
}

KernelSources mutant(const std::string& file, const std::string& from, const std::string& to) {
    std::string text = kernelSources().at(file);
    const size_t place = text.find(from);
    if (place == std::string::npos) throw std::runtime_error(file + " does not hold '" + from + "'");
    return {{file, text.replace(place, from.size(), to)}};
}

TraversalDevice::TraversalDevice(const std::vector<BvhPrimitive>& primitives, const std::string& options,
                                 const KernelSources& replaced)
    : bvh_(buildBvh(primitives)), nodes_(testDevice(), bvh_.nodes, "nodes"),
      blocks_(testDevice(), bvh_.blocks, "blocks"),
      program_(testDevice(), "micro/traversal.cl", bvhOptions(bvh_) + " " + options, replaced) {}

std::vector<TestHit> TraversalDevice::closestOfPackets(const Rays& rays) {
    const auto packets = run<DeviceHitPacket>("closestHits16", packetsOf<packetSize>(rays));
    std::vector<TestHit> hits;
    for (size_t i = 0; i < rays.size(); ++i) hits.push_back(packets[i / packetSize].hit(i % packetSize));
    return hits;
}

std::vector<unsigned> TraversalDevice::occludedOfPackets(const Rays& rays) {
    return run<unsigned>("occlusion16", packetsOf<packetSize>(rays), packetSize);
}

} // namespace quasilux

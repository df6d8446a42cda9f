// Packets of eight coherent rays, kernels/bvh_packet.clh, against our single rays and rtcIntersect8 or rtcOccluded8.
#include "bench/micro/traversal_parts.h"

#include <fmt/format.h>

namespace quasilux {

namespace {

/// One kernel on one form of the rays.
template <typename Rays, typename Answer>
class Sender {
public:
    Sender(Device& device, DeviceTree& tree, const char* kernel, const std::vector<Rays>& rays, size_t answers)
        : device_(device), tree_(tree), kernel_(kernel), rays_(device, rays, "rays"),
          answers_(device, answers, "answers") {}

    void launch() {
        tree_.fast.kernel(kernel_).launch(rays_.size(), tree_.nodes, tree_.blocks, rays_, answers_,
                                          cl_uint(rays_.size()));
        device_.finish();
    }
    std::vector<Answer> answers() { return answers_.read(); }

private:
    Device& device_;
    DeviceTree& tree_;
    const char* kernel_;
    Buffer<Rays> rays_;
    Buffer<Answer> answers_;
};

/// Times the three in turns.
template <typename Single, typename Packet>
MicroRow contest(Device& device, unsigned threads, const RaySet& set, unsigned rounds, Packet& packet, Single& single,
                 const std::function<void(size_t, size_t)>& embree) {
    const char* theirs = set.occlusion ? "rtcOccluded8" : "rtcIntersect8";
    const unsigned hostThreads = std::max(1u, threads);
    std::vector<Contender> contenders{{"packet", [&] { packet.launch(); }},
                                      {"quasilux", [&] { single.launch(); }},
                                      {theirs, [&] { onThreads(hostThreads, set.rays.size(), embree); }}};
    timeInTurns(contenders, rounds, device.info());
    MicroRow row{"traversal", "", threads, "Mrays/s and thread", {}, {}};
    const double million = 1e-6 * double(set.rays.size());
    for (const Contender& contender : contenders) row.values.emplace_back(contender.name, million / contender.seconds);
    row.ratios.emplace_back("packet / quasilux", contenders[1].seconds / contenders[0].seconds);
    row.ratios.emplace_back(fmt::format("packet / {}", theirs + 3), contenders[2].seconds / contenders[0].seconds);
    return row;
}

void count(MicroRow& row, bool differing) {
    ++row.compared;
    row.differing += differing ? 1 : 0;
}

MicroRow closestRow(Device& device, unsigned threads, DeviceTree& tree, const EmbreeScene& embree, const RaySet& set,
                    unsigned rounds) {
    const std::vector<RayPacket> packets = packetsOf(set.rays);
    std::vector<HitPacket> theirs(packets.size());
    Sender<RayPacket, DeviceHitPacket> packet(device, tree, "closestHits8", packets, packets.size());
    Sender<MicroRay, MicroHit> single(device, tree, "closestHits", set.rays, set.rays.size());
    MicroRow row = contest(device, threads, set, rounds, packet, single, [&](size_t begin, size_t end) {
        embree.closest(&packets[begin / packetSize], &theirs[begin / packetSize], (end - begin) / packetSize,
                       set.coherent);
    });
    const std::vector<DeviceHitPacket> ours = packet.answers();
    const std::vector<MicroHit> expected = single.answers();
    for (size_t i = 0; i < expected.size(); ++i)
        count(row, differ(ours[i / packetSize].hit(i % packetSize), expected[i]));
    return row;
}

MicroRow occlusionRow(Device& device, unsigned threads, DeviceTree& tree, const EmbreeScene& embree, const RaySet& set,
                      unsigned rounds) {
    const std::vector<RayPacket> packets = packetsOf(set.rays);
    std::vector<unsigned> theirs(set.rays.size());
    Sender<RayPacket, unsigned> packet(device, tree, "occlusion8", packets, set.rays.size());
    Sender<MicroRay, unsigned> single(device, tree, "occlusion", set.rays, set.rays.size());
    MicroRow row = contest(device, threads, set, rounds, packet, single, [&](size_t begin, size_t end) {
        embree.occluded(&packets[begin / packetSize], &theirs[begin], (end - begin) / packetSize, set.coherent);
    });
    const std::vector<unsigned> ours = packet.answers(), expected = single.answers();
    for (size_t i = 0; i < expected.size(); ++i) count(row, differ(ours[i], expected[i]));
    return row;
}

} // namespace

MicroRow packetRow(Device& device, unsigned threads, DeviceTree& tree, const EmbreeScene& embree, const RaySet& set,
                   unsigned rounds, const std::string& scene) {
    MicroRow row = (set.occlusion ? occlusionRow : closestRow)(device, threads, tree, embree, set, rounds);
    row.name = fmt::format("{}, {}, packets", scene, set.name);
    return row;
}

} // namespace quasilux

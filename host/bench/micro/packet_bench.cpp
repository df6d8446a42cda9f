// Packets of sixteen coherent rays, kernels/micro/bvh_packet.clh, against our single rays and Embree's packets of 8 and
// 16.
#include "bench/micro/traversal_parts.h"

#include <fmt/format.h>
#include <memory>

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

/// Embree's packets of 8 and of 16 rays, `run` on ranges of rays.
struct EmbreePackets {
    const char* name;
    std::function<void(size_t, size_t)> run;
};

/// Times all in turns.
template <typename Single, typename Packet>
MicroRow contest(Device& device, unsigned threads, const RaySet& set, unsigned rounds, Packet& packet, Single& single,
                 const EmbreePackets (&embree)[2]) {
    const unsigned hostThreads = std::max(1u, threads);
    std::vector<TimedWay> ways{{"packet", [&] { packet.launch(); }}, {"quasilux", [&] { single.launch(); }}};
    for (const EmbreePackets& theirs : embree)
        ways.push_back({theirs.name, [&] { onThreads(hostThreads, set.rays.size(), theirs.run); }});
    timeInTurns(ways, rounds, device.info());
    MicroRow row{"traversal", "", threads, "Mrays/s and thread", {}, {}};
    const double million = 1e-6 * double(set.rays.size());
    for (const TimedWay& way : ways) row.values.emplace_back(way.name, million / way.seconds);
    const auto ratio = [&](size_t theirs, const char* name) {
        row.ratios.emplace_back(fmt::format("packet / {}", name), ways[theirs].seconds / ways[0].seconds);
    };
    ratio(1, "quasilux");
    for (size_t k = 0; k < std::size(embree); ++k) ratio(2 + k, embree[k].name + 3);
    return row;
}

void count(MicroRow& row, bool differing) {
    ++row.compared;
    row.differing += differing ? 1 : 0;
}

template <unsigned size>
std::function<void(size_t, size_t)> closestOf(const EmbreeScene& embree, const RaySet& set) {
    const auto packets = std::make_shared<std::vector<RayPacket<size>>>(packetsOf<size>(set.rays));
    const auto hits = std::make_shared<std::vector<HitPacket<size>>>(packets->size());
    return [&embree, packets, hits, coherent = set.coherent](size_t begin, size_t end) {
        embree.closest(&(*packets)[begin / size], &(*hits)[begin / size], (end - begin) / size, coherent);
    };
}

template <unsigned size>
std::function<void(size_t, size_t)> occlusionOf(const EmbreeScene& embree, const RaySet& set) {
    const auto packets = std::make_shared<std::vector<RayPacket<size>>>(packetsOf<size>(set.rays));
    const auto blocked = std::make_shared<std::vector<unsigned>>(set.rays.size());
    return [&embree, packets, blocked, coherent = set.coherent](size_t begin, size_t end) {
        embree.occluded(&(*packets)[begin / size], &(*blocked)[begin], (end - begin) / size, coherent);
    };
}

MicroRow closestRow(Device& device, unsigned threads, DeviceTree& tree, const EmbreeScene& embree, const RaySet& set,
                    unsigned rounds) {
    const std::vector<RayPacket<packetSize>> packets = packetsOf<packetSize>(set.rays);
    Sender<RayPacket<packetSize>, DeviceHitPacket> packet(device, tree, "closestHits16", packets, packets.size());
    Sender<MicroRay, MicroHit> single(device, tree, "closestHits", set.rays, set.rays.size());
    MicroRow row =
        contest(device, threads, set, rounds, packet, single,
                {{"rtcIntersect8", closestOf<8>(embree, set)}, {"rtcIntersect16", closestOf<16>(embree, set)}});
    const std::vector<DeviceHitPacket> ours = packet.answers();
    const std::vector<MicroHit> expected = single.answers();
    for (size_t i = 0; i < expected.size(); ++i)
        count(row, differ(ours[i / packetSize].hit(i % packetSize), expected[i]));
    return row;
}

MicroRow occlusionRow(Device& device, unsigned threads, DeviceTree& tree, const EmbreeScene& embree, const RaySet& set,
                      unsigned rounds) {
    const std::vector<RayPacket<packetSize>> packets = packetsOf<packetSize>(set.rays);
    Sender<RayPacket<packetSize>, unsigned> packet(device, tree, "occlusion16", packets, set.rays.size());
    Sender<MicroRay, unsigned> single(device, tree, "occlusion", set.rays, set.rays.size());
    MicroRow row =
        contest(device, threads, set, rounds, packet, single,
                {{"rtcOccluded8", occlusionOf<8>(embree, set)}, {"rtcOccluded16", occlusionOf<16>(embree, set)}});
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

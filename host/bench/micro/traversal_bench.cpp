// Closest hits and occlusion of kernels/bvh.clh against Embree's on the same rays.
#include "bench/micro/traversal_parts.h"

#include <fmt/format.h>

namespace quasilux {

namespace {

/// `Hit` is MicroHit or, of occlusion, unsigned; `Hits` what Embree writes for eight rays.
template <typename Hit, typename Hits>
class Contest {
public:
    Contest(Device& device, unsigned threads, DeviceTree& tree, const EmbreeScene& embree, const RaySet& set)
        : device_(device), tree_(tree), kernel_(set.occlusion ? "occlusion" : "closestHits"),
          rays_(device, set.rays, "rays"), answers_(device, set.rays.size(), "answers") {
        const unsigned hostThreads = std::max(1u, threads);
        theirs_.resize(set.rays.size());
        const auto packets = std::make_shared<std::vector<RayPacket<8>>>(packetsOf<8>(set.rays));
        const auto theirPackets = std::make_shared<std::vector<Hits>>(set.rays.size());
        ways_ = {{"quasilux", [this] { launch(tree_.fast); }},
                 {"portable", [this] { launch(tree_.portable); }},
                 {set.occlusion ? "rtcOccluded1" : "rtcIntersect1",
                  [&, hostThreads] {
                      onThreads(hostThreads, set.rays.size(),
                                [&](size_t begin, size_t end) { one(embree, set, begin, end); });
                  }},
                 {set.occlusion ? "rtcOccluded8" : "rtcIntersect8", [&, hostThreads, packets, theirPackets] {
                      onThreads(hostThreads, set.rays.size(), [&](size_t begin, size_t end) {
                          eight(embree, set, *packets, *theirPackets, begin, end);
                      });
                  }}};
    }

    MicroRow measure(unsigned rounds, unsigned threads, const RaySet& set, const std::string& scene) {
        timeInTurns(ways_, rounds, device_.info());
        MicroRow row{"traversal", fmt::format("{}, {}", scene, set.name), threads, "Mrays/s and thread", {}, {}};
        const double million = 1e-6 * double(set.rays.size());
        for (const TimedWay& way : ways_) row.values.emplace_back(way.name, million / way.seconds);
        const auto ratio = [&](size_t ours, size_t theirs) {
            row.ratios.emplace_back(fmt::format("{} / {}", ways_[ours].name, ways_[theirs].name.substr(3)),
                                    ways_[theirs].seconds / ways_[ours].seconds);
        };
        ratio(0, 2);
        ratio(1, 2);
        ratio(0, 3);
        const std::vector<Hit> ours = answers_.read();
        row.compared = ours.size();
        for (size_t i = 0; i < ours.size(); ++i) row.differing += differ(ours[i], theirs_[i]) ? 1 : 0;
        return row;
    }

private:
    void launch(Program& program) {
        program.kernel(kernel_).launch(rays_.size(), tree_.nodes, tree_.blocks, rays_, answers_, cl_uint(rays_.size()));
        device_.finish();
    }
    void one(const EmbreeScene& embree, const RaySet& set, size_t begin, size_t end) {
        if constexpr (std::is_same_v<Hit, MicroHit>)
            embree.closest(&set.rays[begin], &theirs_[begin], end - begin);
        else
            embree.occluded(&set.rays[begin], &theirs_[begin], end - begin);
    }
    static void eight(const EmbreeScene& embree, const RaySet& set, const std::vector<RayPacket<8>>& packets,
                      std::vector<Hits>& hits, size_t begin, size_t end) {
        const size_t first = begin / 8, count = (end - begin) / 8;
        if constexpr (std::is_same_v<Hit, MicroHit>)
            embree.closest(&packets[first], &hits[first], count, set.coherent);
        else
            embree.occluded(&packets[first], &hits[begin], count, set.coherent);
    }

    Device& device_;
    DeviceTree& tree_;
    std::string kernel_;
    Buffer<MicroRay> rays_;
    Buffer<Hit> answers_;
    std::vector<Hit> theirs_;
    std::vector<TimedWay> ways_;
};

void benchScene(const MicroRun& run, const MicroScene& scene) {
    run.progress("traversal: " + scene.name);
    const EmbreeScene embree(scene.triangles);
    const RaySets sets = makeRaySets(scene, embree, run.settings.rays);
    const Bvh bvh = buildBvh(scene.triangles);
    const RaySet raySets[] = {{"primary", sets.primary, true, false},
                              {"diffuse, random order", sets.random, false, false},
                              {"diffuse, ordered", sets.ordered, false, false},
                              {"shadow", sets.shadow, true, true}};
    for (const unsigned threads : run.threads) {
        Device device(run.settings.device, 64, 0, threads);
        DeviceTree tree(device, bvh);
        for (const RaySet& set : raySets) {
            if (run.interrupted) return;
            run.report.rows.push_back(set.occlusion
                                          ? Contest<unsigned, unsigned>(device, threads, tree, embree, set)
                                                .measure(run.settings.rounds, threads, set, scene.name)
                                          : Contest<MicroHit, HitPacket<8>>(device, threads, tree, embree, set)
                                                .measure(run.settings.rounds, threads, set, scene.name));
            if (set.coherent && !run.interrupted)
                run.report.rows.push_back(
                    packetRow(device, threads, tree, embree, set, run.settings.rounds, scene.name));
        }
    }
}

} // namespace

void benchTraversal(const MicroRun& run) {
    benchScene(run, cornellScene());
    if (!run.interrupted) benchScene(run, sphereScene(run.settings.sphereRings));
    if (!run.interrupted) benchScene(run, forestScene(run.settings.forestTriangles));
}

} // namespace quasilux

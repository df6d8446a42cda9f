// Our tree (Embree's builder, then flattened) against Embree's own scene over the same triangles.
#include "bench/micro/contest.h"
#include "bench/micro/embree_scene.h"
#include "bench/micro/micro_parts.h"
#include "bench/micro/scenes.h"
#include "util/stopwatch.h"

#include <algorithm>
#include <fmt/format.h>
#include <limits>

namespace quasilux {

void benchTree(const MicroRun& run) {
    run.progress("tree");
    const MicroScene scene = forestScene(run.settings.forestTriangles);
    double ours = std::numeric_limits<double>::infinity(), theirs = ours;
    double oursOnClock = ours, theirsOnClock = ours;
    const unsigned rounds = std::min(run.settings.rounds, 3u);
    for (unsigned round = 0; round < rounds && !run.interrupted; ++round) {
        const Stopwatch watch;
        const Bvh bvh = buildBvh(scene.triangles);
        ours = std::min(ours, watch.processorSeconds());
        oursOnClock = std::min(oursOnClock, watch.seconds());
        const EmbreeScene embree(scene.triangles);
        theirs = std::min(theirs, embree.commitProcessorSeconds());
        theirsOnClock = std::min(theirsOnClock, embree.commitSeconds());
    }
    if (run.interrupted) return;
    const double million = 1e-6 * double(scene.triangles.size());
    const auto add = [&](const char* clock, double mine, double other) {
        run.report.rows.push_back({"tree",
                                   fmt::format("{} triangles, {}", scene.triangles.size(), clock),
                                   0,
                                   "Mtriangles/s",
                                   {{"quasilux", million / mine}, {"rtcCommitScene", million / other}},
                                   {{"quasilux / Embree", other / mine}}});
    };
    add("processor time", ours, theirs);
    add("clock time", oursOnClock, theirsOnClock);
}

} // namespace quasilux

// The sums of kernels/density.clh against a plain C++ loop over the same sorted photons.
#include "bench/micro/contest.h"
#include "bench/micro/gather_loop.h"
#include "bench/micro/micro_parts.h"
#include "bench/micro/photon_index.h"

#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace quasilux {

std::string microPhotonOptions() {
    return fmt::format("-DHAS_LOBE_LAMBERT -DBVH_STACK_SIZE=32 -DESTIMATE_BIAS=1 -DPHOTON_CLASSES={}u", microClasses);
}

namespace {

/// Sums of a few to a few hundred products in another order.
bool differ(const shared::Rgb& ours, const shared::Rgb& theirs, float size) {
    const float tolerance = 1e-4f * size;
    return !(std::abs(ours.r - theirs.r) <= tolerance && std::abs(ours.g - theirs.g) <= tolerance &&
             std::abs(ours.b - theirs.b) <= tolerance);
}

MicroRow gatherRow(const MicroRun& run, Device& device, unsigned threads, const MicroPhotons& photons, float perDisc,
                   bool bias) {
    const float radius = std::sqrt(perDisc / (float(photons.density) * std::numbers::pi_v<float>));
    MicroIndex index(device, photons, radius);
    index.sort();
    index.table().map().biasWeight = bias ? 1.f : 0.f;
    const shared::MapParams& map = index.table().map();
    Program program(device, "micro/gather.cl", microPhotonOptions());
    Kernel kernel = program.kernel("gather");
    Buffer<shared::GatherQuery> queries(device, photons.queries, "queries");
    Buffer<shared::GatherSum> sums(device, photons.queries.size(), "sums");

    const auto sorted = index.sorted().read(), cellStart = index.table().cellStart().read();
    const NativeMap native{sorted.data(), cellStart.data(), map};
    const auto count = unsigned(photons.queries.size());
    std::vector<shared::GatherSum> theirs(count);
    std::vector<TimedWay> ways{{"quasilux",
                                [&] {
                                    kernel.launch(count, index.table().cellStart(), index.sorted(), queries, sums, map,
                                                  count, unsigned(LIGHT_DIFFUSE));
                                    device.finish();
                                }},
                               {"C++ loop", [&] {
                                    onThreads(std::max(1u, threads), count, [&](size_t begin, size_t end) {
                                        gatherLoop(native, &photons.queries[begin], &theirs[begin], end - begin, bias);
                                    });
                                }}};
    timeInTurns(ways, run.settings.rounds, device.info());
    const double million = 1e-6 * double(photonsTested(native, photons.queries.data(), count));
    MicroRow row{"gather", fmt::format("{:g} photons a disc{}", perDisc, bias ? ", bias estimated" : ""),
                 threads,  "Mtests/s and thread",
                 {},       {}};
    for (const TimedWay& way : ways) row.values.emplace_back(way.name, million / way.seconds);
    row.ratios.emplace_back("quasilux / C++", ways[1].seconds / ways[0].seconds);
    const std::vector<shared::GatherSum> ours = sums.read();
    row.compared = count;
    for (size_t i = 0; i < count; ++i) {
        const float size = theirs[i].irradiance.r + theirs[i].irradiance.g + theirs[i].irradiance.b;
        const bool differs = differ(ours[i].irradiance, theirs[i].irradiance, size) ||
                             (bias && differ(ours[i].bias, theirs[i].bias, 4 * size));
        row.differing += differs ? 1 : 0;
    }
    return row;
}

} // namespace

void benchGather(const MicroRun& run) {
    run.progress("gather");
    const MicroPhotons photons = makePhotons(run.settings.photons, run.settings.queries);
    for (const unsigned threads : run.threads) {
        Device device(run.settings.device, 64, 0, threads);
        for (const float perDisc : {10.f, 50.f, 250.f})
            for (const bool bias : {false, true})
                if (!run.interrupted)
                    run.report.rows.push_back(gatherRow(run, device, threads, photons, perDisc, bias));
    }
}

} // namespace quasilux

// The render's index of photons (kernels/photon_map.cl) against a plain counting sort in C++.
#include "bench/micro/contest.h"
#include "bench/micro/micro_parts.h"
#include "bench/micro/native_grid.h"
#include "bench/micro/photon_index.h"

#include <bit>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace quasilux {

namespace {

class NativeSort {
public:
    NativeSort(const MicroPhotons& photons, const shared::MapParams& map)
        : photons_(photons.photons), map_(map), cellStart_(map.cellMask + 2),
          sorted_(microPhotonFields * map.photonStride) {}

    void run() {
        std::fill(cellStart_.begin(), cellStart_.end(), 0);
        for (const TracedPhoton& photon : photons_) ++cellStart_[cellOf(photon) + 1];
        for (size_t cell = 1; cell < cellStart_.size(); ++cell) cellStart_[cell] += cellStart_[cell - 1];
        next_ = cellStart_;
        for (const TracedPhoton& photon : photons_) place(photon, next_[cellOf(photon)]++);
    }
    const std::vector<uint32_t>& sorted() const { return sorted_; }
    const std::vector<uint32_t>& cellStart() const { return cellStart_; }

private:
    unsigned cellOf(const TracedPhoton& photon) const {
        return nativeCell(nativeCoordinate(photon.position, map_.radius[LIGHT_DIFFUSE]), photon.patchSide,
                          map_.cellMask);
    }
    void place(const TracedPhoton& photon, size_t at) {
        const uint32_t words[microPhotonFields] = {std::bit_cast<uint32_t>(photon.position.x),
                                                   std::bit_cast<uint32_t>(photon.position.y),
                                                   std::bit_cast<uint32_t>(photon.position.z),
                                                   photon.flux,
                                                   photon.patchSide,
                                                   photon.direction};
        for (size_t field = 0; field < microPhotonFields; ++field)
            sorted_[field * map_.photonStride + at] = words[field];
    }

    const std::vector<TracedPhoton>& photons_;
    shared::MapParams map_;
    std::vector<uint32_t> cellStart_, next_, sorted_;
};

} // namespace

void benchMap(const MicroRun& run) {
    run.progress("map");
    const MicroPhotons photons = makePhotons(run.settings.photons, 64);
    constexpr float perDisc = 50;
    const float radius = std::sqrt(perDisc / (float(photons.density) * std::numbers::pi_v<float>));
    for (const unsigned threads : run.threads) {
        if (run.interrupted) return;
        Device device(run.settings.device, 64, 0, threads);
        MicroIndex index(device, photons, radius);
        NativeSort native(photons, index.table().map());
        std::vector<TimedWay> ways{{"quasilux", [&] { index.sort(); }, 0, [&] { index.putBack(); }},
                                   {"C++ sort", [&] { native.run(); }}};
        timeInTurns(ways, run.settings.rounds, device.info());
        MicroRow row{"map", fmt::format("{} photons", photons.photons.size()), threads, "Mrecords/s and thread", {},
                     {}};
        const double million = 1e-6 * double(photons.photons.size());
        for (const TimedWay& way : ways) row.values.emplace_back(way.name, million / way.seconds);
        row.ratios.emplace_back("quasilux / C++", ways[1].seconds / ways[0].seconds);
        const auto ours = index.sorted().read(), starts = index.table().cellStart().read();
        const size_t stride = index.table().map().photonStride;
        row.compared = microPhotonFields * photons.photons.size() + starts.size();
        for (size_t field = 0; field < microPhotonFields; ++field)
            for (size_t i = field * stride; i < field * stride + photons.photons.size(); ++i)
                row.differing += ours[i] != native.sorted()[i] ? 1 : 0;
        for (size_t i = 0; i < starts.size(); ++i) row.differing += starts[i] != native.cellStart()[i] ? 1 : 0;
        run.report.rows.push_back(row);
    }
}

} // namespace quasilux

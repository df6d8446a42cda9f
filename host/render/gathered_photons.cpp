#include "render/gathered_photons.h"

#include "render/camera_stage.h"
#include "util/bit_words.h"

#include <numeric>

namespace quasilux {

double GatheredCount::share() const {
    const auto all = std::accumulate(stored.begin(), stored.end(), uint64_t{0});
    const auto used = std::accumulate(gathered.begin(), gathered.end(), uint64_t{0});
    return all > 0 ? static_cast<double>(used) / static_cast<double>(all) : 0;
}

GatheredCount countGathered(Device& device, const std::string& options, const GeometryBuffers& geometry,
                            const PhotonStage& photons, const shared::CameraParams& params, const PixelTables& tables) {
    const Program program(device, "gathered_photons.cl", options + " -DMARKS_GATHERED");
    GatheredCount count;
    count.stored = photons.table().countBySlot();
    const uint64_t all = std::accumulate(count.stored.begin(), count.stored.end(), uint64_t{0});
    Buffer<uint32_t> marks(device, all / bitsOfWord + 1, "marks of gathered photons");
    marks.fill(0);
    const size_t border = SAMPLE_BORDER(&params.camera); // of samples that pixels share, if they do
    const size_t paths = (params.camera.width + 2 * border) * (params.camera.height + 2 * border);
    Kernel kernel = program.kernel("markGathered");
    const auto launch = [&](const auto&... more) {
        kernel.launch(paths, geometry.nodes, geometry.blocks, geometry.tables, photons.table().cellStart(),
                      photons.sorted(), marks, params, tables.paths.counts(), more...);
    };
    if (tables.radiusScales)
        launch(*tables.radiusScales);
    else
        launch();
    const auto bits = marks.read();
    uint64_t photon = 0; // slots follow each other in the map
    for (size_t slot = 0; slot < PHOTON_SLOTS; ++slot)
        for (const uint64_t end = photon + count.stored[slot]; photon < end; ++photon)
            count.gathered[slot] += bitAt(bits, photon) ? 1 : 0;
    return count;
}

} // namespace quasilux

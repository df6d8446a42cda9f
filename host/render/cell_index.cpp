#include "render/cell_index.h"

#include "util/error.h"

#include <algorithm>
#include <bit>
#include <fmt/format.h>

namespace quasilux {

namespace {

constexpr unsigned scanBlocksMax = 64;
constexpr size_t vectorWidth = 8; // records are read eight at a time: the last group may reach beyond the last record

// A few cells per disc's worth of records: collisions only cost tests.
unsigned cellsPerSlot(unsigned records) { return std::max(4096u, std::bit_ceil(records / 4)); }

} // namespace

CellIndex::CellIndex(Device& device, const std::string& file, const std::string& options, unsigned slots, size_t fields,
                     std::string noun)
    : device_(device), program_(device, file, options), countRecords_(program_.kernel("countRecords")),
      sumBlocks_(program_.kernel("sumBlocks")), scanCells_(program_.kernel("scanCells")),
      scatterRecords_(program_.kernel("scatterRecords")), slots_(slots), fields_(fields), noun_(std::move(noun)) {}

void CellIndex::makeTable(unsigned expected, unsigned regions) {
    map_.regions = regions;
    map_.cellMask = cellsPerSlot(expected) - 1;
    // On a CPU a few long chunks; on a GPU enough of them to occupy it.
    map_.chunks = std::min(regions, device_.info().isCpu ? 2 * device_.info().computeUnits : 256u);
    const size_t cells = size_t(std::popcount(slots_)) * (map_.cellMask + 1);
    map_.scanBlocks = static_cast<unsigned>(std::clamp<size_t>(cells / 256, 1, scanBlocksMax));
    counts_ = Buffer<uint32_t>(device_, cells * map_.chunks, noun_ + " cell counts");
    blockSums_ = Buffer<uint32_t>(device_, map_.scanBlocks, noun_ + " scan blocks");
    cellStart_ = Buffer<uint32_t>(device_, cells + 1, noun_ + " cells");
    reserve(expected);
}

void CellIndex::reserve(uint64_t records) {
    if (records + vectorWidth <= map_.photonStride) return;
    const uint64_t stride = (map_.photonStride == 0 ? records : records + records / 4) + vectorWidth;
    if (stride > UINT32_MAX)
        throw DeviceError(
            fmt::format("{} {}s in one pass, at most {} can be indexed: use fewer --photons, or a smaller "
                        "image with --map camera",
                        records, noun_, UINT32_MAX));
    map_.photonStride = static_cast<unsigned>(stride);
    sorted_ = Buffer<uint32_t>();
    sorted_ = Buffer<uint32_t>(device_, fields_ * stride, noun_ + "s sorted");
    sorted_.fill(0); // lanes beyond the last record are read, with weight 0: they must be finite
}

std::array<uint64_t, PHOTON_SLOTS> CellIndex::countBySlot() const {
    std::array<uint64_t, PHOTON_SLOTS> counted{};
    size_t first = 0; // cell where the slot begins; its records stand between the starts of two slots
    for (unsigned slot = 0; slot < PHOTON_SLOTS; ++slot) {
        if (!(slots_ >> slot & 1)) continue;
        const size_t end = first + map_.cellMask + 1;
        counted[slot] = cellStart_.read(end, 1).front() - cellStart_.read(first, 1).front();
        first = end;
    }
    return counted;
}

} // namespace quasilux

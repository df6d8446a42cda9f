// Where the records of each slot and cell stand in a pass's index, and the sort that puts them there
// (kernels/record_sort.cl), whether the records are photons or camera points.
#pragma once

#include "device/program.h"
#include "pass_types.h"
#include "render/planned_buffer.h"

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace quasilux {

/// Records are read so many at a time: the last group may reach beyond the last record (PHOTONS_READ of
/// photon_grid.clh).
constexpr size_t recordsRead = 8;

/// How records are sorted: chunks, each of which counts a run of them, and whether by the whole cell at once, as for
/// the few chunks of a CPU, or by its digits.
struct SortParts {
    unsigned chunks = 1;
    bool wholeCells = true;
};

/// The digits by which `cells` cells are sorted, lowest first; `keySide` as in SortDigit.
std::vector<shared::SortDigit> sortDigits(size_t cells, const SortParts& parts, unsigned keySide);

class CellTable {
public:
    /// `pass` holds record_sort.cl; `slots` are the bits 1 << slot that occur; `noun` names the records in labels of
    /// buffers and in messages; `keySide` as in SortDigit.
    CellTable(Device& device, const Program& pass, unsigned slots, unsigned keySide, std::string noun);

    /// Makes room for about `expected` records, which come from this many regions.
    void make(uint64_t expected, unsigned regions);
    /// The same with so many cells of a slot, a power of two.
    void make(unsigned cellsOfSlot, unsigned regions, const SortParts& parts);
    /// The buffers that it then takes, by label.
    static BufferSizes plan(unsigned slots, uint64_t expected, unsigned regions, const std::string& noun,
                            const DeviceInfo& device);

    /// Words of a buffer, from one of them on.
    struct Words {
        const Buffer<uint32_t>& buffer;
        uint64_t at;
    };
    /// The kernels of the first digit, which know where records come from: they set their cells and count, and place.
    struct FirstDigit {
        std::function<void(const shared::SortDigit&, const Buffer<uint32_t>& counts)> count;
        std::function<void(const shared::SortDigit&, const Buffer<uint32_t>& counts, const Words& to)> place;
    };
    /// `order` becomes the numbers of all `records`, by cell; `keys` begins with the cell of record 0. Where there are
    /// several digits, `spare` holds as many words meanwhile. Of photons (uint32_t) and camera points.
    template <typename Record>
    void sort(unsigned records, const FirstDigit& first, const Buffer<Record>& keys, const Words& order,
              const Words& spare);

    /// Records by slot, as last sorted.
    std::array<uint64_t, PHOTON_SLOTS> countBySlot() const;

    /// All kernels see it, so its radii must be set.
    shared::MapParams& map() { return map_; }
    const shared::MapParams& map() const { return map_; }
    const Buffer<uint32_t>& cellStart() const { return cellStart_; }
    const std::string& noun() const { return noun_; }

private:
    size_t cells() const;
    void scan(const shared::SortDigit& digit);

    Device& device_;
    Kernel sumBlocks_, sumGroups_, scanCounts_, countOrdered_, placeOrdered_, copyCellStarts_, findCellStarts_;
    unsigned slots_, keySide_;
    std::string noun_;
    shared::MapParams map_{};
    std::vector<shared::SortDigit> digits_;
    Buffer<uint32_t> counts_, sums_, cellStart_;
};

} // namespace quasilux

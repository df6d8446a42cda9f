#include "render/cell_table.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace quasilux {

namespace {

// A few cells per disc's worth of records: collisions of rows only cost tests, and memory.
unsigned cellsPerSlot(uint64_t records) {
    return static_cast<unsigned>(std::clamp<uint64_t>(std::bit_ceil(records / 4), 16384, 1u << 28));
}

// On a CPU a chunk for each core; on a GPU as many as fill it once.
SortParts partsFor(const DeviceInfo& device, unsigned regions) {
    constexpr unsigned itemsPerUnit = 64;
    const unsigned most = device.isCpu ? device.computeUnits : itemsPerUnit * device.computeUnits;
    return {std::max(1u, std::min(regions, most)), device.isCpu};
}

// Of the thousands of chunks of a GPU each has counts of its own: of so few bins that these do not outnumber the
// records.
constexpr unsigned digitBits = 11;

uint64_t divideUp(uint64_t count, uint64_t by) { return (count + by - 1) / by; }

uint64_t blocksOf(const shared::SortDigit& digit) {
    return divideUp(uint64_t(digit.bins) * digit.chunks, digit.blockCounts);
}
uint64_t groupsOf(const shared::SortDigit& digit) { return divideUp(blocksOf(digit), digit.groupBlocks); }

size_t countsOf(const std::vector<shared::SortDigit>& digits) {
    size_t most = 1;
    for (const auto& digit : digits) most = std::max(most, size_t(digit.bins) * digit.chunks);
    return most;
}
size_t sumsOf(const std::vector<shared::SortDigit>& digits) {
    size_t most = 1;
    for (const auto& digit : digits) most = std::max<size_t>(most, blocksOf(digit) + groupsOf(digit));
    return most;
}

size_t cellsOf(unsigned slots, unsigned cellsOfSlot) { return size_t(std::popcount(slots)) * cellsOfSlot; }

struct TableBuffers {
    TableBuffers(size_t cells, const std::vector<shared::SortDigit>& digits, const std::string& noun)
        : counts{noun + " cell counts", countsOf(digits)}, sums{noun + " sums of counts", sumsOf(digits)},
          cellStart{noun + " cells", cells + 1} {}
    PlannedBuffer<uint32_t> counts, sums, cellStart;
};

} // namespace

std::vector<shared::SortDigit> sortDigits(size_t cells, const SortParts& parts, unsigned keySide) {
    const unsigned bits = std::bit_width(cells - 1);
    const unsigned count = parts.wholeCells ? 1 : std::max(1u, (bits + digitBits - 1) / digitBits);
    const unsigned bitsEach = (bits + count - 1) / count;
    std::vector<shared::SortDigit> digits(count);
    for (unsigned k = 0; k < count; ++k) {
        shared::SortDigit& digit = digits[k];
        digit.shift = k * bitsEach;
        digit.mask = count == 1 ? UINT32_MAX : (1u << bitsEach) - 1;
        digit.bins = static_cast<unsigned>(std::min<size_t>(digit.mask, (cells - 1) >> digit.shift) + 1);
        digit.chunks = parts.chunks;
        // Each core of a CPU counts in memory of its own; work-items of a GPU, side by side, in words side by side.
        digit.binSide = parts.wholeCells ? 1 : digit.chunks;
        digit.chunkSide = parts.wholeCells ? digit.bins : 1;
        // Three levels of sums, each of as many as the next.
        const auto each = static_cast<unsigned>(std::ceil(std::cbrt(double(digit.bins) * digit.chunks)));
        digit.blockCounts = digit.groupBlocks = each;
        digit.keySide = keySide;
    }
    return digits;
}

CellTable::CellTable(Device& device, const Program& pass, unsigned slots, unsigned keySide, std::string noun)
    : device_(device), sumBlocks_(pass.kernel("sumBlocks")), sumGroups_(pass.kernel("sumGroups")),
      scanCounts_(pass.kernel("scanCounts")), countOrdered_(pass.kernel("countOrdered")),
      placeOrdered_(pass.kernel("placeOrdered")), copyCellStarts_(pass.kernel("copyCellStarts")),
      findCellStarts_(pass.kernel("findCellStarts")), slots_(slots), keySide_(keySide), noun_(std::move(noun)) {}

size_t CellTable::cells() const { return cellsOf(slots_, map_.cellMask + 1); }

void CellTable::make(uint64_t expected, unsigned regions) {
    make(cellsPerSlot(expected), regions, partsFor(device_.info(), regions));
}

void CellTable::make(unsigned cellsOfSlot, unsigned regions, const SortParts& parts) {
    map_.regions = regions;
    map_.cellMask = cellsOfSlot - 1;
    digits_ = sortDigits(std::max<size_t>(1, cells()), parts, keySide_);
    const TableBuffers buffers(cells(), digits_, noun_);
    counts_ = buffers.counts.make(device_);
    sums_ = buffers.sums.make(device_);
    cellStart_ = buffers.cellStart.make(device_);
}

BufferSizes CellTable::plan(unsigned slots, uint64_t expected, unsigned regions, const std::string& noun,
                            const DeviceInfo& device) {
    const size_t cells = cellsOf(slots, cellsPerSlot(expected));
    const TableBuffers buffers(cells, sortDigits(std::max<size_t>(1, cells), partsFor(device, regions), 1), noun);
    return sizesOf(buffers.counts, buffers.sums, buffers.cellStart);
}

void CellTable::scan(const shared::SortDigit& digit) {
    sumBlocks_.launch(blocksOf(digit), counts_, sums_, digit);
    sumGroups_.launch(groupsOf(digit), sums_, digit);
    scanCounts_.launch(blocksOf(digit), counts_, sums_, digit);
}

template <typename Record>
void CellTable::sort(unsigned records, const FirstDigit& first, const Buffer<Record>& keys, const Words& order,
                     const Words& spare) {
    const size_t last = digits_.size() - 1;
    for (size_t k = 0; k <= last; ++k) {
        // To and fro between both places, so that the last order is in its own.
        const Words &to = (last - k) % 2 == 0 ? order : spare, &from = (last - k) % 2 == 0 ? spare : order;
        const shared::SortDigit& digit = digits_[k];
        if (k == 0)
            first.count(digit, counts_);
        else
            countOrdered_.launchLong(digit.chunks, keys, from.buffer, from.at, counts_, records, digit);
        scan(digit);
        if (last == 0)
            copyCellStarts_.launch(cells() + 1, counts_, cellStart_, records, static_cast<unsigned>(cells()), digit);
        if (k == 0)
            first.place(digit, counts_, to);
        else
            placeOrdered_.launchLong(digit.chunks, keys, from.buffer, from.at, counts_, to.buffer, to.at, records,
                                     digit);
    }
    if (last > 0)
        findCellStarts_.launch(cells() + 1, keys, order.buffer, order.at, cellStart_, records,
                               static_cast<unsigned>(cells()), digits_[last]);
}

template void CellTable::sort(unsigned records, const FirstDigit& first, const Buffer<uint32_t>& keys,
                              const Words& order, const Words& spare);
template void CellTable::sort(unsigned records, const FirstDigit& first, const Buffer<shared::CameraPoint>& keys,
                              const Words& order, const Words& spare);

std::array<uint64_t, PHOTON_SLOTS> CellTable::countBySlot() const {
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

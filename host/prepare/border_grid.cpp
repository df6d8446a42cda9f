// Uniform grid over the border segments: count, prefix sum, scatter.
#include "prepare/borders.h"

#include "scene/box.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace quasilux {
namespace {

constexpr double maximumCells = 2e6;

glm::dvec3 point(const shared::Packed3& p) { return {p.x, p.y, p.z}; }

Box boundsOf(const std::vector<shared::BorderSegment>& segments) {
    Box box;
    for (const shared::BorderSegment& segment : segments) {
        box.add(point(segment.a));
        box.add(point(segment.b));
    }
    return box;
}

/// What a point's cell may be off by if computed in floats.
double coordinateRounding(const Box& box) {
    const glm::dvec3 largest = glm::max(glm::abs(box.lower), glm::abs(box.upper));
    return 1e-6 * std::max({largest.x, largest.y, largest.z});
}

/// Half-width of a cell's neighbourhood.
double safeReach(double reach, double rounding) { return 1.001 * reach + rounding; }

/// Cell size from `reach` up that keeps the number of cells within bounds.
void chooseCells(const glm::dvec3& extent, double reach, SurfaceBorders::Grid& grid) {
    const double longest = std::max({extent.x, extent.y, extent.z});
    double cellSize = std::max({reach, longest * 1e-6, double(std::numeric_limits<float>::min())});
    const auto cellsOf = [&] { return glm::max(glm::ceil(extent / double(float(cellSize))), glm::dvec3(1.0)); };
    glm::dvec3 cells = cellsOf();
    while (cells.x * cells.y * cells.z > maximumCells) {
        cellSize *= 1.05;
        cells = cellsOf();
    }
    grid.cellSize = float(cellSize);
    grid.cells = glm::uvec3(cells);
}

double distanceToSegment(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 along = b - a;
    const double square = glm::dot(along, along);
    const double t = square > 0 ? std::clamp(glm::dot(p - a, along) / square, 0.0, 1.0) : 0;
    return glm::distance(p, a + t * along);
}

/// Whether the segment meets the box of half-width `half` about `center`.
bool meetsBox(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& center, double half) {
    double enter = 0, leave = 1;
    for (int axis = 0; axis < 3; ++axis) {
        const double from = a[axis] - center[axis], along = b[axis] - a[axis];
        if (along == 0) {
            if (std::abs(from) > half) return false;
            continue;
        }
        const double t0 = (-half - from) / along, t1 = (half - from) / along;
        enter = std::max(enter, std::min(t0, t1));
        leave = std::min(leave, std::max(t0, t1));
    }
    return enter <= leave;
}

struct CellRange {
    glm::uvec3 from, to; ///< inclusive
};

CellRange cellsAround(const glm::dvec3& a, const glm::dvec3& b, double reach, const SurfaceBorders::Grid& grid) {
    const glm::dvec3 lower(grid.lower), last = glm::dvec3(grid.cells) - 1.0;
    const double size = grid.cellSize;
    return {glm::uvec3(glm::clamp(glm::floor((glm::min(a, b) - reach - lower) / size), glm::dvec3(0.0), last)),
            glm::uvec3(glm::clamp(glm::floor((glm::max(a, b) + reach - lower) / size), glm::dvec3(0.0), last))};
}

glm::dvec3 cellCenter(const SurfaceBorders::Grid& grid, unsigned x, unsigned y, unsigned z) {
    return glm::dvec3(grid.lower) + (glm::dvec3(x, y, z) + 0.5) * double(grid.cellSize);
}

double halfDiagonal(const SurfaceBorders::Grid& grid) { return 0.5 * std::sqrt(3.0) * grid.cellSize; }

/// Calls visit(cell index) for the cells whose box may lie within `reach` of the segment, or their own of `reachOfCell` where that is
/// not empty: both the cell's box widened by it and the ball about it widened by it must meet the segment. Goes slab by slab along the segment's
/// longest axis, so that a long oblique segment does not visit the whole box about it.
template <typename Visit>
void forEachCellNear(const shared::BorderSegment& segment, double reach, const std::vector<float>& reachOfCell,
                     const SurfaceBorders::Grid& grid, const Visit& visit) {
    const glm::dvec3 a = point(segment.a), b = point(segment.b), lower(grid.lower), extent = glm::abs(b - a);
    const int axis = longestAxis(extent);
    const double size = grid.cellSize, half = 0.5 * size + reach;
    const CellRange all = cellsAround(a, b, reach, grid);
    for (unsigned slab = all.from[axis]; slab <= all.to[axis]; ++slab) {
        const double middle = lower[axis] + (slab + 0.5) * size;
        const auto shareAt = [&](double coordinate) {
            return extent[axis] > 0 ? std::clamp((coordinate - a[axis]) / (b[axis] - a[axis]), 0.0, 1.0) : 0.0;
        };
        CellRange range =
            cellsAround(glm::mix(a, b, shareAt(middle - half)), glm::mix(a, b, shareAt(middle + half)), reach, grid);
        range.from[axis] = range.to[axis] = slab;
        for (unsigned z = range.from.z; z <= range.to.z; ++z)
            for (unsigned y = range.from.y; y <= range.to.y; ++y)
                for (unsigned x = range.from.x; x <= range.to.x; ++x) {
                    const size_t cell = (size_t(z) * grid.cells.y + y) * grid.cells.x + x;
                    const double own = reachOfCell.empty() ? reach : reachOfCell[cell];
                    const glm::dvec3 center = cellCenter(grid, x, y, z);
                    if (meetsBox(a, b, center, 0.5 * size + own) &&
                        distanceToSegment(center, a, b) <= halfDiagonal(grid) + own)
                        visit(cell);
                }
    }
}

/// By cell; empty where it is the same everywhere.
std::vector<float> reachByCell(const BorderReach& reach, double rounding, const SurfaceBorders::Grid& grid) {
    std::vector<float> reaches;
    if (!reach.about) return reaches;
    for (unsigned z = 0; z < grid.cells.z; ++z)
        for (unsigned y = 0; y < grid.cells.y; ++y)
            for (unsigned x = 0; x < grid.cells.x; ++x) {
                const double about = reach.about(cellCenter(grid, x, y, z), halfDiagonal(grid) + rounding);
                reaches.push_back(static_cast<float>(safeReach(about, rounding)));
            }
    return reaches;
}

} // namespace

SurfaceBorders::Grid indexBorders(const SurfaceBorders& borders, const BorderReach& reach) {
    SurfaceBorders::Grid grid;
    if (borders.segments.empty()) {
        grid.cellStart.assign(2, 0);
        return grid;
    }
    const Box box = boundsOf(borders.segments);
    const double rounding = coordinateRounding(box), safe = safeReach(reach.largest, rounding);
    grid.lower = glm::vec3(box.lower - safe);
    chooseCells(box.upper + safe - glm::dvec3(grid.lower), std::sqrt(reach.smallest * reach.largest), grid);
    const std::vector<float> reaches = reachByCell(reach, rounding, grid);

    grid.cellStart.assign(size_t(grid.cells.x) * grid.cells.y * grid.cells.z + 1, 0);
    for (const shared::BorderSegment& segment : borders.segments)
        forEachCellNear(segment, safe, reaches, grid, [&](size_t cell) { ++grid.cellStart[cell + 1]; });
    for (size_t cell = 1; cell < grid.cellStart.size(); ++cell) grid.cellStart[cell] += grid.cellStart[cell - 1];
    grid.items.resize(grid.cellStart.back());
    std::vector<unsigned> next(grid.cellStart.begin(), grid.cellStart.end() - 1);
    for (unsigned i = 0; i < borders.segments.size(); ++i)
        forEachCellNear(borders.segments[i], safe, reaches, grid, [&](size_t cell) { grid.items[next[cell]++] = i; });
    return grid;
}

} // namespace quasilux

#include "learn/importance.h"

#include "prepare/pack.h"
#include "util/bit_words.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>
#include <unordered_map>

namespace quasilux {

namespace {

constexpr double verticesOfCell = 128; // of those that the camera sees, about
// A fine cell with fewer of those that light is scattered at leaves them to the coarse one.
constexpr unsigned fewestScattering = 8;

// One place in so many is taken for one where importance paths gathered.
constexpr size_t bitsOfCell = 16;

constexpr double leastAim = 0.05; // probability below which photons are not aimed
// What a photon that is scattered brings over the mean: below, own directions of the lobes seldom lead anywhere useful.
constexpr double mostWasted = 0.1;

double length(const shared::Packed3& v) { return glm::length(unpack(v)); }

struct Scattered {
    double weight = 0;                         // of light that is scattered from here
    std::array<double, mostAimSets> through{}; // of it by the set of openings that it should come through

    void add(const Scattered& other) {
        weight += other.weight;
        for (size_t set = 0; set < mostAimSets; ++set) through[set] += other.through[set];
    }
};

struct Cell {
    double gathered = 0, all = 0;
    bool isCoarse = false;
    unsigned scattering = 0; // vertices
    Scattered scattered;
};

Scattered scatteredFrom(const shared::ImportancePath& path, size_t v, const std::vector<AimSet>& aims) {
    Scattered scattered;
    const auto ray = scatteredRay(path, v);
    if (!ray) return scattered;
    double left = scattered.weight = ray->weight;
    for (size_t k = 0; k < aims.size() && left > 0; ++k) {
        scattered.through[k] = left * aims[k].claim(*ray);
        left -= scattered.through[k];
    }
    return scattered;
}

uint32_t aimWord(const Cell& cell, const std::vector<AimSet>& aims) {
    uint32_t word = 0;
    double most = 0;
    for (size_t set = 0; set < aims.size(); ++set) {
        const double weight = cell.scattered.through[set];
        const double probability = aims[set].surest * weight / cell.scattered.weight;
        if (weight <= most || probability < leastAim) continue;
        most = weight;
        word = static_cast<uint32_t>(firstOf(aims, set) + 1) << 16 | static_cast<uint32_t>(65535 * probability);
    }
    return word;
}

} // namespace

shared::ImportanceGrid importanceGrid(const DeviceScene& scene, unsigned paths) {
    const auto& camera = scene.camera;
    shared::ImportanceGrid grid{};
    grid.cells = QL_NONE;
    grid.eye = camera.origin;
    const double share = verticesOfCell / paths;
    const double ofScene = std::sqrt(share * scene.surfaceArea);
    const double image = camera.fisheye != FISHEYE_NONE
                             ? 2 * std::numbers::pi * (1 - std::cos(camera.halfAngle))
                             : double(camera.width) * camera.height * length(camera.stepX) * length(camera.stepY);
    const bool isCamera = scene.offsets.meter.kind == METER_NONE;
    const bool isPerspective = isCamera && !camera.orthographic;
    // Its image at distance 1, or its image as it is.
    grid.sizePerDistance = isPerspective ? static_cast<float>(std::sqrt(share * image)) : 0;
    grid.smallestSize = static_cast<float>(isPerspective ? 1e-6 * ofScene
                                           : isCamera    ? std::sqrt(share * image)
                                                         : ofScene);
    if (!(grid.smallestSize > 0)) grid.smallestSize = 1e-6f;
    return grid;
}

std::vector<uint32_t> seenCells(std::vector<uint32_t> keys) {
    std::sort(keys.begin(), keys.end());
    keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
    if (!keys.empty() && keys.front() == 0) keys.erase(keys.begin());
    std::vector<uint32_t> words(std::bit_ceil(bitsOfCell * keys.size() + 1) / bitsOfWord + 1);
    words.resize(std::bit_ceil(words.size()));
    for (const uint32_t key : keys) setBit(words, key & (bitsOfWord * words.size() - 1));
    return words;
}

std::vector<bool> wastedScattering(const std::vector<shared::ImportancePath>& paths,
                                   const std::vector<double>& pathWeights, const std::vector<uint32_t>& keys,
                                   const std::vector<float>& sizes) {
    std::unordered_map<uint32_t, double> worth; // of flux that arrives in a coarse cell and is scattered there
    const auto eachScattering = [&](auto&& visit) {
        for (size_t k = 0; k < paths.size(); ++k)
            for (size_t v = 1; v < IMPORTANCE_VERTICES; ++v) {
                const double weight = pathWeights[k] * paths[k].vertices[v].weight;
                if (weight > 0 && std::isfinite(weight)) visit(k * IMPORTANCE_VERTICES + v, weight);
            }
    };
    eachScattering(
        [&](size_t at, double weight) { worth[keys[2 * at + 1]] += weight / (double(sizes[at]) * sizes[at]); });
    double all = 0, sum = 0;
    eachScattering([&](size_t at, double weight) {
        all += weight;
        sum += weight * worth[keys[2 * at + 1]];
    });
    std::vector<bool> isWasted(paths.size() * IMPORTANCE_VERTICES);
    eachScattering([&](size_t at, double) { isWasted[at] = worth[keys[2 * at + 1]] * all < mostWasted * sum; });
    return isWasted;
}

std::vector<uint32_t> importanceCells(const std::vector<shared::ImportancePath>& paths,
                                      const std::vector<double>& pathWeights, const std::vector<uint32_t>& keys,
                                      const std::vector<float>& sizes, const std::vector<AimSet>& aims,
                                      shared::ImportanceGrid& grid) {
    std::unordered_map<uint32_t, Cell> cells;
    for (size_t k = 0; k < paths.size(); ++k)
        for (size_t v = 0; v < IMPORTANCE_VERTICES; ++v) {
            const auto& vertex = paths[k].vertices[v];
            const size_t at = k * IMPORTANCE_VERTICES + v;
            if (!(vertex.weight > 0) || !std::isfinite(vertex.weight)) continue;
            const double value = pathWeights[k] * vertex.weight / (double(sizes[at]) * sizes[at]);
            Cell& fine = cells[keys[2 * at]];
            fine.all += value;
            if (v == 0) {
                fine.gathered += value;
                continue;
            }
            Cell& coarse = cells[keys[2 * at + 1]];
            coarse.isCoarse = true;
            coarse.all += value / (double(IMPORTANCE_COARSE) * IMPORTANCE_COARSE);
            ++fine.scattering;
            ++coarse.scattering;
            if (aims.empty()) continue;
            const Scattered scattered = scatteredFrom(paths[k], v, aims);
            fine.scattered.add(scattered);
            coarse.scattered.add(scattered);
        }
    // Sorted, so that the table is the same on every machine.
    std::vector<uint32_t> known;
    known.reserve(cells.size());
    for (const auto& [key, cell] : cells) known.push_back(key);
    std::sort(known.begin(), known.end());
    const size_t count = std::bit_ceil(2 * cells.size() + 1);
    grid.mask = static_cast<unsigned>(count - 1);
    std::vector<uint32_t> table(IMPORTANCE_WORDS * count);
    for (const uint32_t key : known) {
        const Cell& cell = cells.at(key);
        size_t at = key & grid.mask;
        while (table[IMPORTANCE_WORDS * at] != 0) at = (at + 1) & grid.mask;
        table[IMPORTANCE_WORDS * at] = key;
        table[IMPORTANCE_WORDS * at + 1] = std::bit_cast<uint32_t>(static_cast<float>(cell.gathered));
        table[IMPORTANCE_WORDS * at + 2] = std::bit_cast<uint32_t>(static_cast<float>(cell.all));
        const bool isKnown = cell.isCoarse || cell.scattering >= fewestScattering;
        table[IMPORTANCE_WORDS * at + 3] = isKnown ? aimWord(cell, aims) : IMPORTANCE_UNKNOWN;
    }
    return table;
}

} // namespace quasilux

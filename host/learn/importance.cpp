#include "learn/importance.h"

#include "prepare/pack.h"
#include "util/bit_words.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/glm.hpp>
#include <map>
#include <numbers>
#include <optional>

namespace quasilux {

namespace {

constexpr double verticesOfCell = 128; // of those that the camera sees, about
// A fine cell with fewer of those that light is scattered at leaves them to the coarse one.
constexpr unsigned fewestScattering = 8;

// One place in so many is taken for one where pilots gathered.
constexpr size_t bitsOfCell = 16;

constexpr size_t mostAims = 8;
constexpr double surestAim = 0.9; // probability of aiming where all that matters comes through one opening
// Of all scattered rays; and of an opening that no light from outside is known to come through.
constexpr double leastAimGain = 0.03, leastFoundGain = 0.5;
constexpr double leastAim = 0.05; // below, photons are not aimed
constexpr double widestAim = 0.1; // share of all directions that an opening takes from a place which aims at it

double length(const shared::Packed3& v) { return glm::length(unpack(v)); }

struct Cell {
    double gathered = 0, all = 0;
    bool isCoarse = false;
    unsigned scattering = 0;          // vertices
    double scattered = 0;             // weight of light that is scattered from here
    std::map<size_t, double> through; // of it by the opening that it should come through
};

// The way of a photon from vertex `v` of a pilot path to the one before.
std::optional<UsefulRay> scatteredRay(const shared::PilotPath& path, size_t v, double weight) {
    const auto& from = path.vertices[v];
    if (!(from.weight > 0) || !std::isfinite(from.weight)) return std::nullopt;
    UsefulRay ray;
    ray.position = unpack(from.position);
    const glm::dvec3 offset = unpack(path.vertices[v - 1].position) - ray.position;
    const double distance = glm::length(offset);
    if (!(distance > 0)) return std::nullopt;
    ray.direction = offset / distance;
    ray.weight = weight * from.weight;
    ray.isScattered = true;
    return ray;
}

// Share of all directions.
double extent(const Opening& opening, const glm::dvec3& from) {
    const glm::dvec3 offset = opening.centre - from;
    return 4 * opening.halfU * opening.halfV / (4 * std::numbers::pi * std::max(glm::dot(offset, offset), 1e-12));
}

// Worth aiming at from there.
bool isAimed(const Opening& opening, const UsefulRay& ray) {
    return extent(opening, ray.position) < widestAim && opening.holds(ray);
}

// By which the rays' log likelihood grows where every second one of those that come through is aimed.
double gainOfAim(const Opening& opening, const std::vector<UsefulRay>& rays) {
    double gain = 0;
    for (const auto& ray : rays)
        if (isAimed(opening, ray)) gain += ray.weight * std::log(0.5 + 0.5 / extent(opening, ray.position));
    return gain;
}

void noteAim(const shared::PilotPath& path, size_t v, const std::vector<Opening>& aims, Cell& cell) {
    const auto ray = scatteredRay(path, v, 1);
    if (!ray) return;
    cell.scattered += ray->weight;
    for (size_t k = 0; k < aims.size(); ++k) {
        if (!isAimed(aims[k], *ray)) continue;
        cell.through[k] += ray->weight;
        return;
    }
}

uint32_t aimWord(const Cell& cell) {
    uint32_t word = 0;
    double most = 0;
    for (const auto& [aim, weight] : cell.through) {
        const double probability = surestAim * weight / cell.scattered;
        if (weight <= most || probability < leastAim) continue;
        most = weight;
        word = static_cast<uint32_t>(aim + 1) << 16 | static_cast<uint32_t>(65535 * probability);
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
    const double image = double(camera.width) * camera.height * length(camera.stepX) * length(camera.stepY);
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

std::vector<Opening> findAims(const std::vector<shared::PilotPath>& paths, const std::vector<double>& pathWeights,
                              const std::vector<Opening>& fromOutside, double radius) {
    std::vector<UsefulRay> rays;
    double all = 0;
    for (size_t k = 0; k < paths.size(); ++k)
        for (size_t v = 1; v < PILOT_VERTICES; ++v)
            if (const auto ray = scatteredRay(paths[k], v, pathWeights[k])) {
                rays.push_back(*ray);
                all += ray->weight;
            }
    std::vector<Opening> candidates = fromOutside;
    for (const Opening& found : findOpenings(rays, radius, candidates, mostAims)) candidates.push_back(found);
    std::vector<Opening> aims;
    for (size_t k = 0; k < candidates.size() && aims.size() < mostAims; ++k) {
        if (gainOfAim(candidates[k], rays) < all * (k < fromOutside.size() ? leastAimGain : leastFoundGain)) continue;
        aims.push_back(candidates[k]);
        std::erase_if(rays, [&](const UsefulRay& ray) { return isAimed(candidates[k], ray); });
    }
    return aims;
}

std::vector<uint32_t> importanceCells(const std::vector<shared::PilotPath>& paths,
                                      const std::vector<double>& pathWeights, const std::vector<uint32_t>& keys,
                                      const std::vector<float>& sizes, const std::vector<Opening>& aims,
                                      shared::ImportanceGrid& grid) {
    std::map<uint32_t, Cell> cells; // sorted, so that the table is the same on every machine
    for (size_t k = 0; k < paths.size(); ++k)
        for (size_t v = 0; v < PILOT_VERTICES; ++v) {
            const auto& vertex = paths[k].vertices[v];
            const size_t at = k * PILOT_VERTICES + v;
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
            for (Cell* cell : {&fine, &coarse}) {
                ++cell->scattering;
                if (!aims.empty()) noteAim(paths[k], v, aims, *cell);
            }
        }
    const size_t count = std::bit_ceil(2 * cells.size() + 1);
    grid.mask = static_cast<unsigned>(count - 1);
    std::vector<uint32_t> table(IMPORTANCE_WORDS * count);
    for (const auto& [key, cell] : cells) {
        size_t at = key & grid.mask;
        while (table[IMPORTANCE_WORDS * at] != 0) at = (at + 1) & grid.mask;
        table[IMPORTANCE_WORDS * at] = key;
        table[IMPORTANCE_WORDS * at + 1] = std::bit_cast<uint32_t>(static_cast<float>(cell.gathered));
        table[IMPORTANCE_WORDS * at + 2] = std::bit_cast<uint32_t>(static_cast<float>(cell.all));
        const bool isKnown = cell.isCoarse || cell.scattering >= fewestScattering;
        table[IMPORTANCE_WORDS * at + 3] = isKnown ? aimWord(cell) : IMPORTANCE_UNKNOWN;
    }
    return table;
}

} // namespace quasilux

#include "learn/direct_choice.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace quasilux {

namespace {

constexpr double findsOfBlock = 256;  // paths that a block of pixels is to have
constexpr double byPowerAlone = 0.05; // least probability that an emitter is chosen by power
// Relative variance of a sample above which photons are the better estimate: they leave far less, but blur.
constexpr double mostVariance = 1;

unsigned blockSize(const shared::Camera& camera, size_t paths) {
    const double pixels = double(camera.width) * camera.height;
    return static_cast<unsigned>(std::max(1.0, std::round(std::sqrt(pixels * findsOfBlock / double(paths)))));
}

// Finds by block, then emitter.
struct Seen {
    double sum = 0, squares = 0;
};
using Block = std::map<unsigned, Seen>;

struct Blocks {
    unsigned size = 1, columns = 1, rows = 1;
    std::vector<Block> seen;
    std::vector<double> paths;
};

Blocks sortedByBlock(const std::vector<DirectFind>& finds, const shared::Camera& camera) {
    Blocks blocks;
    blocks.size = blockSize(camera, finds.size());
    blocks.columns = (camera.width + blocks.size - 1) / blocks.size;
    blocks.rows = (camera.height + blocks.size - 1) / blocks.size;
    blocks.seen.resize(size_t(blocks.columns) * blocks.rows);
    blocks.paths.resize(blocks.seen.size());
    for (const auto& find : finds) {
        const size_t at =
            find.pixel / camera.width / blocks.size * blocks.columns + find.pixel % camera.width / blocks.size;
        blocks.paths[at] += 1;
        if (find.emitter == QL_NONE || !(find.value > 0)) continue;
        Seen& seen = blocks.seen[at][find.emitter];
        seen.sum += find.value;
        seen.squares += find.value * find.value;
    }
    return blocks;
}

// Variance of one sample of each emitter, chosen by power.
std::vector<double> variances(const Blocks& blocks, size_t emitters) {
    std::vector<double> sum(emitters);
    double paths = 0;
    for (size_t b = 0; b < blocks.seen.size(); ++b) {
        const double n = std::max(blocks.paths[b], 1.0);
        paths += blocks.paths[b];
        for (const auto& [emitter, seen] : blocks.seen[b]) sum[emitter] += seen.squares - seen.sum * seen.sum / n;
    }
    for (double& s : sum) s /= std::max(paths, 1.0);
    return sum;
}

// What a block and its neighbours saw.
Block about(const Blocks& blocks, size_t b) {
    const int x = static_cast<int>(b % blocks.columns), y = static_cast<int>(b / blocks.columns);
    Block all;
    for (int v = std::max(y - 1, 0); v <= std::min(y + 1, static_cast<int>(blocks.rows) - 1); ++v)
        for (int u = std::max(x - 1, 0); u <= std::min(x + 1, static_cast<int>(blocks.columns) - 1); ++u) {
            const size_t at = static_cast<size_t>(v) * blocks.columns + static_cast<size_t>(u);
            for (const auto& [emitter, seen] : blocks.seen[at]) {
                all[emitter].sum += seen.sum;
                all[emitter].squares += seen.squares;
            }
        }
    return all;
}

// In proportion to the root of what samples of each emitter have as second moment, which leaves the least variance.
std::vector<shared::LightChoice> listOf(const Block& seen, const EmitterTables& emitters,
                                        const std::vector<bool>& byPhotons) {
    std::vector<std::pair<double, unsigned>> strengths;
    for (const auto& [emitter, values] : seen)
        if (!byPhotons[emitter])
            strengths.emplace_back(std::sqrt(values.squares * emitters.emitters[emitter].selectionProbability),
                                   emitter);
    std::sort(strengths.rbegin(), strengths.rend());
    double all = 0, listed = 0;
    for (const auto& [strength, emitter] : strengths) all += strength;
    if (strengths.size() > LIGHT_CHOICES - 1) strengths.resize(LIGHT_CHOICES - 1);
    for (const auto& [strength, emitter] : strengths) listed += strength;
    const double byPower = all > 0 ? std::max(byPowerAlone, 1 - listed / all) : 1;
    std::vector<shared::LightChoice> list;
    list.reserve(LIGHT_CHOICES);
    list.push_back({static_cast<unsigned>(strengths.size()), static_cast<float>(byPower)});
    for (const auto& [strength, emitter] : strengths)
        list.push_back({emitter, static_cast<float>((1 - byPower) * strength / listed)});
    list.resize(LIGHT_CHOICES, {QL_NONE, 0});
    return list;
}

} // namespace

DirectChoice chooseDirect(const std::vector<DirectFind>& finds, const EmitterTables& emitters,
                          const shared::Camera& camera, bool mayUsePhotons) {
    DirectChoice choice;
    const Blocks blocks = sortedByBlock(finds, camera);
    choice.byPhotons.resize(emitters.emitters.size());
    const auto variance = variances(blocks, emitters.emitters.size());
    unsigned sampled = 0;
    for (size_t e = 0; e < emitters.emitters.size(); ++e) {
        choice.byPhotons[e] =
            mayUsePhotons && emitters.emitters[e].type == EMITTER_CONSTANT && variance[e] > mostVariance;
        sampled += !choice.byPhotons[e];
    }
    choice.lightBlockSize = blocks.size;
    if (sampled < 2) return choice;
    for (size_t b = 0; b < blocks.seen.size(); ++b) {
        const auto list = listOf(about(blocks, b), emitters, choice.byPhotons);
        choice.lights.insert(choice.lights.end(), list.begin(), list.end());
    }
    return choice;
}

} // namespace quasilux

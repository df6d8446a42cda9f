#include "learn/direct_choice.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace quasilux {

namespace {

constexpr double findsOfBlock = 256;    // paths that a block of pixels is to have
constexpr double fewestFinds = 8;       // to know how strong the halves of a group of emitters are
constexpr double leastUnlearned = 0.05; // least probability that an emitter is chosen as if nothing were known
// Relative variance of a sample above which photons are the better estimate: they leave far less, but blur.
constexpr double mostVariance = 1;

unsigned blockSize(const shared::Camera& camera, size_t paths) {
    const double pixels = double(camera.width) * camera.height;
    return static_cast<unsigned>(std::max(1.0, std::round(std::sqrt(pixels * findsOfBlock / double(paths)))));
}

// What a block found of an emitter.
struct Seen {
    unsigned emitter = 0;
    double sum = 0, squares = 0; // of what photons might bring
    // Squares as if no other emitter could have been chosen: of all, and of what photons cannot bring.
    double alone = 0, ofRest = 0;
    double finds = 0;
};
using Block = std::vector<Seen>; // by emitter

struct Blocks {
    unsigned size = 1, columns = 1, rows = 1;
    std::vector<Block> seen;
    std::vector<double> paths;
};

// One for each emitter, in their order.
Block merged(Block all) {
    std::sort(all.begin(), all.end(), [](const Seen& a, const Seen& b) { return a.emitter < b.emitter; });
    Block sums;
    for (const Seen& seen : all) {
        if (sums.empty() || sums.back().emitter != seen.emitter) sums.push_back({seen.emitter});
        sums.back().sum += seen.sum;
        sums.back().squares += seen.squares;
        sums.back().alone += seen.alone;
        sums.back().ofRest += seen.ofRest;
        sums.back().finds += seen.finds;
    }
    return sums;
}

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
        const double gathered = find.value * find.gatheredShare, rest = find.value - gathered;
        blocks.seen[at].push_back({find.emitter, gathered, gathered * gathered,
                                   find.value * find.value * find.probability, rest * rest * find.probability, 1});
    }
    for (Block& block : blocks.seen) block = merged(std::move(block));
    return blocks;
}

// Variance of one sample of each emitter, chosen as if nothing were known.
std::vector<double> variances(const Blocks& blocks, size_t emitters) {
    std::vector<double> sum(emitters);
    double paths = 0;
    for (size_t b = 0; b < blocks.seen.size(); ++b) {
        const double n = std::max(blocks.paths[b], 1.0);
        paths += blocks.paths[b];
        for (const Seen& seen : blocks.seen[b]) sum[seen.emitter] += seen.squares - seen.sum * seen.sum / n;
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
            const Block& near = blocks.seen[static_cast<size_t>(v) * blocks.columns + static_cast<size_t>(u)];
            all.insert(all.end(), near.begin(), near.end());
        }
    return merged(std::move(all));
}

// Emitters between which the light tree chooses, or a single one. A block's list begins with the whole tree and all
// others; the strongest group is replaced by its children as long as there is room and importance paths can distinguish
// these.
struct Group {
    unsigned first = 0, count = 1, node = 0;
    double strength = 0, finds = 0;

    bool canSplit() const { return count > 1 && finds >= fewestFinds; }
};

// Running sums over what a block saw, to ask groups of. The root of what samples have as second moment leaves the least
// variance.
class Strengths {
public:
    Strengths(const Block& seen, const std::vector<bool>& byPhotons) {
        for (const Seen& one : seen) {
            const double squares = byPhotons[one.emitter] ? one.ofRest : one.alone;
            if (!(squares > 0)) continue;
            emitters_.push_back(one.emitter);
            sums_.push_back(sums_.back() + std::sqrt(squares));
            finds_.push_back(finds_.back() + one.finds);
        }
    }

    Group group(unsigned first, unsigned count, unsigned node) const {
        const size_t from = indexOf(first), to = indexOf(first + count);
        return {first, count, node, sums_[to] - sums_[from], finds_[to] - finds_[from]};
    }

private:
    size_t indexOf(unsigned emitter) const {
        return static_cast<size_t>(std::lower_bound(emitters_.begin(), emitters_.end(), emitter) - emitters_.begin());
    }

    std::vector<unsigned> emitters_;
    std::vector<double> sums_{0}, finds_{0};
};

std::vector<Group> groupsOf(const Strengths& seen, const EmitterTables& emitters) {
    const unsigned inTree = emitters.countInTree();
    const auto lessUseful = [](const Group& a, const Group& b) {
        return std::tuple(a.canSplit(), a.strength, a.first) < std::tuple(b.canSplit(), b.strength, b.first);
    };
    std::vector<Group> groups;
    const auto add = [&](const Group& group) {
        if (group.finds > 0) groups.push_back(group);
    };
    if (inTree > 0) add(seen.group(0, inTree, 0));
    for (unsigned e = inTree; e < emitters.emitters.size(); ++e) add(seen.group(e, 1, 0));
    while (!groups.empty() && groups.size() < LIGHT_CHOICES - 1) {
        const auto most = std::max_element(groups.begin(), groups.end(), lessUseful);
        if (!most->canSplit()) break;
        const Group parent = *most;
        groups.erase(most);
        const unsigned half = parent.count / 2;
        add(seen.group(parent.first, half, parent.node + 1));
        add(seen.group(parent.first + half, parent.count - half, parent.node + 2 * half));
    }
    return groups;
}

std::vector<shared::LightChoice> listOf(const Block& seen, const EmitterTables& emitters,
                                        const std::vector<bool>& byPhotons) {
    auto groups = groupsOf(Strengths(seen, byPhotons), emitters);
    std::sort(groups.begin(), groups.end(), [](const Group& a, const Group& b) {
        return std::tuple(-a.strength, a.first) < std::tuple(-b.strength, b.first);
    });
    double all = 0, listed = 0;
    for (const Group& group : groups) all += group.strength;
    // Distant emitters are in no tree, so there may be more groups than room.
    groups.resize(all > 0 ? std::min<size_t>(groups.size(), LIGHT_CHOICES - 1) : 0);
    for (const Group& group : groups) listed += group.strength;
    const double unlearned = all > 0 ? std::max(leastUnlearned, 1 - listed / all) : 1;
    std::vector<shared::LightChoice> list;
    list.reserve(LIGHT_CHOICES);
    list.push_back({static_cast<unsigned>(groups.size()), 0, 0, static_cast<float>(unlearned)});
    for (const Group& group : groups)
        list.push_back(
            {group.first, group.count, group.node, static_cast<float>((1 - unlearned) * group.strength / listed)});
    list.resize(LIGHT_CHOICES, {QL_NONE, 0, 0, 0});
    return list;
}

std::vector<shared::LightChoice> listsOf(const Blocks& blocks, const EmitterTables& emitters,
                                         const std::vector<bool>& byPhotons) {
    std::vector<shared::LightChoice> lists;
    for (size_t b = 0; b < blocks.seen.size(); ++b) {
        const auto list = listOf(about(blocks, b), emitters, byPhotons);
        lists.insert(lists.end(), list.begin(), list.end());
    }
    return lists;
}

} // namespace

DirectChoice chooseDirect(const std::vector<DirectFind>& finds, const std::vector<DirectFind>& later,
                          const EmitterTables& emitters, const shared::Camera& camera, bool mayUsePhotons) {
    DirectChoice choice;
    const Blocks blocks = sortedByBlock(finds, camera);
    choice.byPhotons.resize(emitters.emitters.size());
    const auto variance = variances(blocks, emitters.emitters.size());
    unsigned sampled = 0;
    for (size_t e = 0; e < emitters.emitters.size(); ++e) {
        choice.byPhotons[e] = mayUsePhotons && isSurroundings(emitters.emitters[e]) && variance[e] > mostVariance;
        sampled += !choice.byPhotons[e];
    }
    choice.lightBlockSize = blocks.size;
    if (sampled < 2) return choice;
    choice.lights = listsOf(blocks, emitters, choice.byPhotons);
    // Whoever follows everything has no diffuse light from photons.
    choice.laterLights = listsOf(sortedByBlock(later, camera), emitters, std::vector<bool>(emitters.emitters.size()));
    return choice;
}

} // namespace quasilux

#include "learn/learning.h"

#include "learn/direct_choice.h"
#include "learn/distance_octaves.h"
#include "learn/emission_gain.h"
#include "learn/importance.h"

#include <algorithm>
#include <cmath>

namespace quasilux {

namespace {

constexpr uint64_t shareOfMemory = 4; // one part in so many
constexpr unsigned pathsPerPixel = 16, fewestPaths = 2048, mostPaths = 262144;
constexpr unsigned shareOfTrial = 4; // of these, one in so many
constexpr unsigned photonRounds = 3;
// Where more of the photons lie about what is gathered, all are stored: the noise of those few that stand for others
// would not pay.
constexpr double mostSeenShare = 0.5;
// Below, photons are not guided: plain ones are spread more evenly than chance would (kernels/lattice.clh).
constexpr double leastGuidingGain = 10;
constexpr unsigned block = 16; // pixels of a row and column whose mean brightness weighs their errors

// Fewer where the device has little memory: their buffer is to be no part worth mentioning.
unsigned importancePathCount(const shared::Camera& camera, const DeviceInfo& device) {
    const uint64_t wanted = uint64_t(pathsPerPixel) * camera.width * camera.height;
    const uint64_t room =
        std::min(device.maximumAllocation, device.globalMemory / 4) / shareOfMemory / sizeof(shared::ImportancePath);
    return static_cast<unsigned>(std::clamp<uint64_t>(std::min(wanted, room), fewestPaths, mostPaths));
}

// 1 / brightness of each path's pixel, as relMSE has it, over the number of paths.
std::vector<double> pathWeights(const std::vector<shared::ImportancePath>& paths, const shared::Camera& camera) {
    const size_t columns = (camera.width + block - 1) / block, rows = (camera.height + block - 1) / block;
    std::vector<double> sums(columns * rows), counts(columns * rows);
    const auto blockOf = [&](unsigned pixel) {
        return pixel / camera.width / block * columns + pixel % camera.width / block;
    };
    double all = 0;
    for (const auto& path : paths) {
        if (!std::isfinite(path.radiance)) continue;
        sums[blockOf(path.pixel)] += path.radiance;
        counts[blockOf(path.pixel)] += 1;
        all += path.radiance;
    }
    const double mean = all / static_cast<double>(paths.size());
    std::vector<double> weights;
    for (const auto& path : paths) {
        const size_t b = blockOf(path.pixel);
        const double radiance = sums[b] / std::max(counts[b], 1.0);
        const double scale = std::sqrt(radiance * radiance + 0.01 * mean * mean);
        weights.push_back(scale > 0 ? 1 / (scale * static_cast<double>(paths.size())) : 0);
    }
    return weights;
}

// Of the direct light that a path finds, relative to the brightness of its pixel. Its mean is the same however emitters
// are sampled, so the least one leaves the least noise.
double secondMoment(const std::vector<shared::ImportancePath>& paths, const shared::Camera& camera) {
    const auto weights = pathWeights(paths, camera);
    double squares = 0;
    for (size_t k = 0; k < paths.size(); ++k) {
        const double value = weights[k] * paths[k].direct.weight;
        if (std::isfinite(value)) squares += value * value;
    }
    return squares * static_cast<double>(paths.size());
}

// Is anything hidden, so that few of the photons matter that are not guided? Or else there is nothing to split or to
// end either.
bool isHidden(const LearnedTables& learned) {
    return learned.guide.leaves.size() > learned.directByPhotons.size() || !learned.aims.empty();
}

// The mean over those that bring anything.
double usualWorthOf(const std::vector<shared::PhotonRecord>& photons) {
    double sum = 0, useful = 0;
    for (const auto& photon : photons) {
        if (!(photon.emission.weight > 0)) continue;
        sum += photon.emission.weight;
        ++useful;
    }
    return useful > 0 ? sum / useful * static_cast<double>(photons.size()) : 0;
}

// (sum w)^2 / sum w^2 over the number of photons (Kish 1965).
double effectiveShare(const std::vector<shared::PhotonRecord>& photons) {
    double sum = 0, squares = 0;
    for (const auto& photon : photons) {
        sum += photon.emission.weight;
        squares += double(photon.emission.weight) * photon.emission.weight;
    }
    return squares > 0 ? sum * sum / squares / static_cast<double>(photons.size()) : 0;
}

} // namespace

Learning::Learning(Device& device, const Program& program, DeviceScene& scene, SceneBuffers buffers,
                   const shared::CameraParams& params)
    : device_(device), program_(program), scene_(scene), buffers_(buffers), params_(params),
      guide_(scene.emitters, [this](const auto& records, const auto& sources) { return invert(records, sources); }) {}

std::vector<shared::EmissionPoint> Learning::invert(const std::vector<shared::EmissionRecord>& records,
                                                    const std::vector<shared::GuideSource>& sources) {
    const Buffer<shared::EmissionRecord> from(device_, records, "importance records");
    const Buffer<shared::GuideSource> table(device_, sources, "importance sources");
    const Buffer<shared::EmissionPoint> points(device_, records.size(), "importance points");
    program_.kernel("invertEmission")
        .launch(records.size(), buffers_.tables, from, table, static_cast<unsigned>(sources.size()), points,
                scene_.offsets, static_cast<unsigned>(records.size()));
    return points.read();
}

void Learning::makeImportance(const Buffer<shared::ImportancePath>& buffer,
                              const std::vector<shared::ImportancePath>& paths, const std::vector<double>& weights) {
    const auto count = static_cast<unsigned>(paths.size());
    const double radius = std::sqrt(scene_.surfaceArea); // of the order of the scene
    const Buffer<uint32_t> keys(device_, 2 * size_t(IMPORTANCE_VERTICES) * count, "importance cell keys");
    const Buffer<float> sizes(device_, size_t(IMPORTANCE_VERTICES) * count, "importance cell sizes");
    const Buffer<uint32_t> seenKeys(device_, count, "importance gather keys");
    auto& grid = learned_.tables.importance;
    grid = importanceGrid(scene_, count);
    grid.nearest = nearestGathered(paths, weights, grid.eye);
    const auto gathered = gatheredByOctave(paths, weights, grid);
    for (size_t o = 0; o < DISTANCE_OCTAVES; ++o) learned_.octaves[o].gathered = gathered[o];
    program_.kernel("findImportanceCells").launch(count, buffer, keys, sizes, seenKeys, grid, count);
    const auto cellKeys = keys.read();
    const auto cellSizes = sizes.read();
    const auto aims = findAims(paths, weights, wastedScattering(paths, weights, cellKeys, cellSizes),
                               guide_.openingsFromOutside(), radius);
    learned_.tables.aims = aimTable(aims);
    seenCells_ = seenCells(seenKeys.read());
    learned_.tables.importanceCells = importanceCells(paths, weights, cellKeys, cellSizes, aims, grid);
}

void Learning::upload() {
    setLearned(scene_, learned_.tables);
    buffers_.tables = {};
    buffers_.tables = Buffer<uint32_t>(device_, scene_.tables, "scene tables");
}

std::vector<shared::ImportancePath> Learning::tracePaths(const Buffer<shared::ImportancePath>& buffer, unsigned count,
                                                         unsigned directEnvironment) {
    shared::CameraParams params = params_;
    params.scene.learned.directEnvironment = directEnvironment;
    program_.kernel("traceImportancePaths")
        .launch(count, buffers_.nodes, buffers_.blocks, buffers_.tables, buffer, params, count);
    auto paths = buffer.read();
    paths.resize(count);
    return paths;
}

// Where directions of the lobes find the sky themselves, samples of it are better spent on what exceeds its mean; behind
// a window they are not. A few paths that sample so show which it is.
std::vector<shared::ImportancePath>
Learning::tracePathsByBetterEnvironment(const Buffer<shared::ImportancePath>& buffer, unsigned count) {
    if (!scene_.features.emitterTypes.contains(EMITTER_ENVMAP)) return tracePaths(buffer, count, 0);
    const auto trial = tracePaths(buffer, count / shareOfTrial, 1);
    auto paths = tracePaths(buffer, count, 0);
    if (secondMoment(trial, params_.camera) >= secondMoment(paths, params_.camera)) return paths;
    learned_.tables.directEnvironment = 1;
    return tracePaths(buffer, count, 1);
}

void Learning::followImportance(bool directMayUsePhotons) {
    const unsigned count = importancePathCount(params_.camera, device_.info());
    const Buffer<shared::ImportancePath> buffer(device_, count, "importance paths");
    const auto paths = tracePathsByBetterEnvironment(buffer, count);
    const auto weights = pathWeights(paths, params_.camera);
    std::vector<shared::EmissionRecord> records;
    std::vector<DirectFind> finds, later;
    for (size_t k = 0; k < paths.size(); ++k) {
        records.push_back(paths[k].indirect);
        records.back().weight *= static_cast<float>(weights[k]);
        if (std::isfinite(records.back().weight)) learned_.lightOfPhotons += records.back().weight;
        gathered_ += weights[k] * paths[k].vertices[0].weight;
        const auto &direct = paths[k].direct, &indirect = paths[k].indirect;
        const double scale = weights[k] * double(count);
        finds.push_back({direct.emitter, paths[k].pixel, scale * direct.weight,
                         direct.inverseDensity > 0 ? 1 / double(direct.inverseDensity) : 1, paths[k].gatheredShare});
        later.push_back(
            {indirect.emitter, paths[k].pixel, scale * indirect.weight, double(paths[k].laterProbability), 1});
    }
    guide_.add(records);
    learned_.tables.guide = guide_.guide();
    makeImportance(buffer, paths, weights);
    auto choice = chooseDirect(finds, later, scene_.emitters, params_.camera, directMayUsePhotons);
    learned_.tables.directByPhotons = std::move(choice.byPhotons);
    learned_.tables.lights = std::move(choice.lights);
    learned_.tables.laterLights = std::move(choice.laterLights);
    learned_.tables.lightBlockSize = choice.lightBlockSize;
    upload();
}

void Learning::traceRounds(const PhotonRound& round) {
    learned_.tables.seenCells = seenCells_;
    upload();
    EmissionGain gain;
    bool pays = true;
    double seenShare = 1;
    for (unsigned k = 0; k < photonRounds; ++k) {
        const RoundResult result = round(k);
        note(result);
        seenShare = result.seenShare;
        if (!pays) continue;
        gain.add(result.photons, scene_.emitters);
        learnFrom(result.photons);
        pays = k + 2 != photonRounds || gain.ratio() >= leastGuidingGain; // what is left measures the densities then
        if (!pays) forget();
    }
    if (seenShare < mostSeenShare) return;
    learned_.tables.seenCells.clear();
    upload();
}

void Learning::learnFrom(const std::vector<shared::PhotonRecord>& photons) {
    std::vector<shared::EmissionRecord> records;
    records.reserve(photons.size());
    for (const auto& photon : photons) records.push_back(photon.emission);
    guide_.add(records);
    learned_.tables.guide = guide_.guide();
    learned_.usualWorth = windowsHold() && isHidden(learned_.tables) ? usualWorthOf(photons) : 0;
    upload();
}

// Where guided photons do not pay, none of what leads them does.
void Learning::forget() {
    learned_.tables.guide = plainGuide(scene_.emitters);
    learned_.tables.aims.clear();
    learned_.usualWorth = 0;
    upload();
}

// In media importance paths meet more than they can note (IMPORTANCE_VERTICES): what their cells say of importance
// there is too little.
bool Learning::windowsHold() const { return !scene_.features.media; }

void Learning::note(const RoundResult& result) {
    learned_.effectiveShare = effectiveShare(result.photons);
    for (size_t o = 0; o < DISTANCE_OCTAVES; ++o) learned_.octaves[o].arrived = result.densityByOctave[o];
    for (size_t c = 0; c < LIGHT_CLASSES; ++c) learned_.density[c] = gathered_ > 0 ? result.density[c] / gathered_ : 0;
}

} // namespace quasilux

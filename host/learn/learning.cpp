#include "learn/learning.h"

#include "learn/direct_choice.h"
#include "learn/importance.h"

#include <algorithm>
#include <cmath>
#include <chrono>

namespace quasilux {

namespace {

static const unsigned pilotPathCount = getenv("PILOTS") ? atoi(getenv("PILOTS")) : 262144;
constexpr unsigned photonRounds = 3;
constexpr double evenWorth = 0.5; // effective share of useful photons from which on weight windows are of no use
constexpr unsigned block = 16; // pixels of a row and column whose mean brightness weighs their errors

// 1 / brightness of each path's pixel, as relMSE has it, over the number of paths.
std::vector<double> pathWeights(const std::vector<shared::PilotPath>& paths, const shared::Camera& camera) {
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

// The median over what is brought to the image: half of it comes from photons worth more. 0 where photons are worth much the same:
// there is nothing to split or to end then.
double usualWorthOf(const std::vector<shared::EmissionRecord>& records) {
    std::vector<double> worths;
    double all = 0, squares = 0, below = 0;
    for (const auto& record : records) {
        if (!(record.weight > 0)) continue;
        worths.push_back(record.weight);
        all += record.weight;
        squares += double(record.weight) * record.weight;
    }
    if (worths.empty() || all * all / squares > evenWorth * static_cast<double>(worths.size())) return 0;
    std::sort(worths.begin(), worths.end());
    for (const double worth : worths) {
        below += worth;
        if (below >= all / 2) return worth * static_cast<double>(records.size());
    }
    return 0;
}

} // namespace

Learning::Learning(Device& device, const std::string& options, DeviceScene& scene, SceneBuffers buffers,
                   const shared::CameraParams& params)
    : device_(device), program_(device, "pilot_paths.cl", options), scene_(scene), buffers_(buffers), params_(params),
      guide_(scene.emitters, [this](const auto& records, const auto& sources) { return invert(records, sources); }) {}

std::vector<shared::EmissionPoint> Learning::invert(const std::vector<shared::EmissionRecord>& records,
                                                    const std::vector<shared::GuideSource>& sources) {
    const Buffer<shared::EmissionRecord> from(device_, records, "pilot records");
    const Buffer<shared::GuideSource> table(device_, sources, "pilot sources");
    const Buffer<shared::EmissionPoint> points(device_, records.size(), "pilot points");
    program_.kernel("invertEmission")
        .launch(records.size(), buffers_.tables, from, table, static_cast<unsigned>(sources.size()), points, scene_.offsets, static_cast<unsigned>(records.size()));
    return points.read();
}

void Learning::makeImportance(const Buffer<shared::PilotPath>& buffer, const std::vector<shared::PilotPath>& paths,
                              const std::vector<double>& weights) {
    const auto count = static_cast<unsigned>(paths.size());
    const double radius = std::sqrt(scene_.surfaceArea); // of the order of the scene
    const Buffer<uint32_t> keys(device_, size_t(PILOT_VERTICES) * count, "pilot cell keys");
    const Buffer<float> sizes(device_, size_t(PILOT_VERTICES) * count, "pilot cell sizes");
    learned_.importance = importanceGrid(scene_, count);
    program_.kernel("findImportanceCells").launch(count, buffer, keys, sizes, learned_.importance, count);
    const auto aims = findAims(paths, weights, learned_.guide.sources, radius);
    for (const Opening& aim : aims) learned_.aims.push_back(openingSource(QL_NONE, 0, aim));
    if (getenv("DEBUG_GUIDE")) for (auto& a : aims) fprintf(stderr, "  aim centre %.2f %.2f %.2f U %.2f %.2f %.2f V %.2f %.2f %.2f half %.2f %.2f\n", a.centre.x, a.centre.y, a.centre.z, a.axisU.x, a.axisU.y, a.axisU.z, a.axisV.x,a.axisV.y,a.axisV.z,a.halfU,a.halfV);
    learned_.importanceCells = importanceCells(paths, weights, keys.read(), sizes.read(), aims, learned_.importance);
    if (getenv("DEBUG_GUIDE")) fprintf(stderr, "importance: %u cells\n", learned_.importance.mask + 1);
}

void Learning::setBorderReach(double reach) {
    quasilux::setBorderReach(scene_, reach);
    upload();
}

void Learning::upload() {
    setLearned(scene_, learned_);
    buffers_.tables = {};
    buffers_.tables = Buffer<uint32_t>(device_, scene_.tables, "scene tables");
}

void Learning::update() {
    learned_.guide = guide_.guide();
    if (getenv("DEBUG_GUIDE")) {
        fprintf(stderr, "guide: %zu sources %zu leaves typical %g\n", learned_.guide.sources.size(), learned_.guide.leaves.size(), learned_.guide.typicalFlux);
        for (auto& s : learned_.guide.sources)
            if (s.halfU > 0) fprintf(stderr, "  e%u centre %.2f %.2f %.2f U %.2f %.2f %.2f V %.2f %.2f %.2f half %.2f %.2f\n", s.emitter, s.centre.x, s.centre.y, s.centre.z, s.axisU.x, s.axisU.y, s.axisU.z, s.axisV.x,s.axisV.y,s.axisV.z,s.halfU,s.halfV);
    }
    upload();
}

void Learning::followPilots(bool directMayUsePhotons) {
    const Buffer<shared::PilotPath> buffer(device_, pilotPathCount, "pilot paths");
    program_.kernel("tracePilotPaths")
        .launch(pilotPathCount, buffers_.nodes, buffers_.blocks, buffers_.tables, buffer, params_, pilotPathCount);
    const auto t0 = std::chrono::steady_clock::now();
    const auto paths = buffer.read();
    if (getenv("DEBUG_GUIDE")) fprintf(stderr, "pilot paths %.3f s\n", std::chrono::duration<double>(std::chrono::steady_clock::now() - t0).count());
    const auto weights = pathWeights(paths, params_.camera);
    std::vector<shared::EmissionRecord> records;
    for (size_t k = 0; k < paths.size(); ++k) {
        records.push_back(paths[k].indirect);
        records.back().weight *= static_cast<float>(weights[k]);
    }
    for (size_t k = 0; k < paths.size(); ++k) gathered_ += weights[k] * paths[k].vertices[0].weight;
    if (getenv("DEBUG_GUIDE")) { size_t n = 0, d = 0; for (auto& p : paths) { n += p.indirect.weight > 0; d += p.direct.weight > 0; } fprintf(stderr, "pilots: %zu indirect %zu direct\n", n, d); }
    guide_.add(records);
    learned_.guide = guide_.guide();
    makeImportance(buffer, paths, weights);
    std::vector<DirectFind> finds;
    for (size_t k = 0; k < paths.size(); ++k) {
        const auto& direct = paths[k].direct;
        finds.push_back({direct.emitter, paths[k].pixel, weights[k] * static_cast<double>(paths.size()) * direct.weight});
    }
    auto choice = chooseDirect(finds, scene_.emitters, params_.camera, directMayUsePhotons);
    learned_.directByPhotons = choice.byPhotons;
    learned_.lights = std::move(choice.lights);
    learned_.lightBlockSize = choice.lightBlockSize;
    directVariance_ = choice.variance;
    if (getenv("DEBUG_GUIDE")) fprintf(stderr, "direct variance %g, block %u, %zu choices, by photons %d\n", directVariance_, choice.lightBlockSize, learned_.lights.size(), int(scene_.features.directByPhotons));
    upload();
}

void Learning::traceRounds(const PhotonRound& round) {
    for (unsigned k = 0; k < photonRounds; ++k) {
        const auto t0 = std::chrono::steady_clock::now();
        const RoundResult result = round(k);
        const auto t1 = std::chrono::steady_clock::now();
        if (getenv("DEBUG_GUIDE")) {
            double n = 0, s = 0, q = 0, m = 0;
            for (auto& r : result.records) { n += r.weight > 0; s += r.weight; q += double(r.weight)*r.weight; m = std::max(m, double(r.weight)); }
            fprintf(stderr, "round %u: useful %.4f effective %.4f max/mean %.1f sum %g density %g %g %g %g\n", k, n/result.records.size(), s*s/q/result.records.size(), m*n/s, s, result.density[0]/gathered_, result.density[1]/gathered_, result.density[2]/gathered_, result.density[3]/gathered_);
        }
        guide_.add(result.records);
        usualWorth_ = usualWorthOf(result.records);
        for (size_t c = 0; c < LIGHT_CLASSES; ++c) density_[c] = gathered_ > 0 ? result.density[c] / gathered_ : 0;
        update();
        if (getenv("DEBUG_GUIDE")) fprintf(stderr, "round %.3f s update %.3f s\n", std::chrono::duration<double>(t1 - t0).count(), std::chrono::duration<double>(std::chrono::steady_clock::now() - t1).count());
    }
}

} // namespace quasilux

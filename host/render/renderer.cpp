#include "render/renderer.h"

#include "learn/learning.h"
#include "render/camera_map_stage.h"
#include "render/camera_stage.h"
#include "render/meter_stage.h"
#include "render/method.h"
#include "render/pass_params.h"
#include "render/pilot.h"
#include "render/radius.h"
#include "render/radius_field.h"
#include "render/scene_report.h"
#include "util/process_memory.h"

#include <chrono>
#include <cmath>
#include <fmt/format.h>
#include <optional>

namespace quasilux {

namespace {

// Photons of a class that is rare are gathered from so many times as far as all together would be: where such light is weak, a
// wider disc costs more than its noise.
constexpr double rareClassRadius = 2;
constexpr unsigned samplesOfManyEmitters = 4;
// Of a round while learning.
constexpr unsigned fewestPhotonsOfRound = 8192, mostPhotonsOfRound = 131072;
constexpr unsigned firstRoundPass = pilotPass - 16; // no render gets there

using Clock = std::chrono::steady_clock;
double since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// Points of the camera map hold no plain normal.
void refuseRelief(const Scene& scene) {
    for (const Bsdf& bsdf : scene.bsdfs)
        if (bsdf.frontRelief || bsdf.backRelief)
            throw InputError(bsdf.where, "normal and bump maps need --map photons, and the map is 'camera'.");
}

void checkCaustics(const Scene& scene, const Features& features, const RenderSettings& settings) {
    if (settings.caustics != CausticLight::paths) return;
    const std::string why = whyNotCausticsByPaths(scene, features, settings);
    if (!why.empty()) throw InputError("--caustics paths: " + why + '.');
}

} // namespace

struct Renderer::Stages {
    Stages(Device& device_, const Scene& scene, const RenderSettings& settings_, DeviceScene flat_,
           std::shared_ptr<const LearnedScene> known)
        : device(device_), noting(std::in_place, device, buffers), settings(settings_), flat(std::move(flat_)),
          program(device, settings.map == MapOrder::camera ? "camera_map_pass.cl" : "photon_map_pass.cl",
                  kernelOptions(flat, settings)),
          geometry(device, flat), learned(std::move(known)), learning(learned ? nullptr : followPilots()),
          film(device, flat.camera.width, flat.camera.height, filmLayout(flat.features, settings),
               largestFilmBuffer(flat.features, settings, device.info())),
          report(describeScene(scene, flat, settings)) {
        const auto start = Clock::now();
        auto timingsBefore = device.timings();
        if (!learned) learned = learnFromPhotons(scene);
        limitBorders();
        describeLearned(since(start));
        for (unsigned c = 0; c < LIGHT_CLASSES; ++c)
            if (photonClasses(flat.features, settings) >> c & 1) report.initialRadius[slotName(c)] = firstRadiusOf(c);
        auto photon = photonParams(scene, flat, settings);
        photon.usualWorth = static_cast<float>(learned->usualWorth / photon.paths);
        auto path = cameraParams(flat, settings, photon.maxDepth);
        path.directSamples = directSamples();
        const unsigned classes = compiledClasses(flat.features, settings);
        if (settings.map == MapOrder::camera)
            prepareCameraMap(path, photon, classes);
        else
            preparePhotonMap(path, photon, classes);
        noting.reset();
        device.resetTimings(std::move(timingsBefore)); // only those of passes count
        flat.bvh = {};                                 // on the device now
        flat.tables = {};
        flat.borders = {};
    }

    // Where photons are to begin, where they matter, how direct light is to be taken: from pilots with random numbers of their own.
    std::unique_ptr<Learning> followPilots() {
        if (!learns(flat.features, settings)) return nullptr;
        auto pilots = std::make_unique<Learning>(device, program, flat,
                                                 SceneBuffers{geometry.nodes, geometry.blocks, geometry.tables},
                                                 cameraParams(flat, settings, QL_NONE));
        pilots->followPilots(mayTakeDirectFromPhotons(flat.features, settings));
        return pilots;
    }

    std::shared_ptr<const LearnedScene> learnFromPhotons(const Scene& scene) {
        if (!learning) return std::make_shared<LearnedScene>();
        if (settings.map == MapOrder::photons && flat.offsets.meter.kind == METER_NONE)
            learning->traceRounds([&](unsigned round) { return photonRound(scene, round); });
        auto all = std::make_shared<LearnedScene>(learning->learned());
        learning.reset();
        return all;
    }

    // Borders are looked up no further than density estimates reach.
    void limitBorders() {
        if (learned->density == decltype(learned->density){}) return;
        double largest = 0, usual = largestRadiusByArea();
        for (unsigned c = 0; c < LIGHT_CLASSES; ++c)
            if (photonClasses(flat.features, settings) >> c & 1) {
                largest = std::max(largest, firstRadiusOf(c));
                usual = std::min(usual, firstRadiusOf(c));
            }
        field = radiusField(*learned, usual, largestRadiusByArea() / usual);
        if (adaptsRadius(flat.features, settings)) largest *= largestAdaptiveRadius;
        setBorderReach(flat, borderReach(field, largest));
        setLearned(flat, learned->tables);
        geometry.tables = {};
        geometry.tables = Buffer<uint32_t>(device, flat.tables, "scene tables");
    }

    void describeLearned(double seconds) {
        const LearnedTables& tables = learned->tables;
        auto& row = report.learned;
        row.isGuided = tables.guide.isGuided;
        row.leaves = tables.guide.leaves.size();
        for (const auto& source : tables.guide.sources) row.openings += source.halfU > 0;
        row.aims = tables.aims.size();
        for (const bool byPhotons : tables.directByPhotons) row.emittersByPhotons += byPhotons;
        row.directSamples = directSamples();
        row.hasWeightWindows = learned->usualWorth > 0;
        row.lightOfPhotons = learned->lightOfPhotons;
        if (learned->effectiveShare >= 0) row.effectivePhotons = learned->effectiveShare * report.photonsPerPass;
        for (unsigned k = 0; field.octaves > 0 && k <= field.octaves; ++k)
            row.radiusFactors.emplace_back(field.nearest * std::exp2(k), field.factor[k]);
        row.seconds = seconds;
    }

    uint64_t pathsPerPixel() const {
        const bool isMeter = flat.offsets.meter.kind != METER_NONE;
        return mayHaveCameraPaths(isMeter, settings) ? settings.cameraPaths : flat.offsets.meter.samples;
    }

    // Samples of emitters where a path gathers: several where each must choose one of many, as they share the choices out.
    unsigned directSamples() const { return learned->tables.lights.empty() ? 1 : samplesOfManyEmitters; }

    RoundResult photonRound(const Scene& scene, unsigned round) {
        shared::PhotonParams params = photonParams(scene, flat, settings);
        params.paths = std::clamp(2 * report.photonsPerPass, fewestPhotonsOfRound, mostPhotonsOfRound);
        params.pathsPerRegion = PhotonStage::pathsPerRegion;
        params.regions = PhotonStage::regionCount(params.paths);
        params.pass = firstRoundPass + round;
        params.learns = 1;
        std::fill(std::begin(params.keepProbability), std::end(params.keepProbability), 1.f);
        const Buffer<shared::PhotonRecord> records(device, params.paths, "learned photons");
        const Buffer<uint32_t> blocks(device, 1, "photon blocks");
        const Buffer<shared::RegionCount> regions(device, params.regions, "photon regions");
        program.kernel("tracePhotons")
            .launchLong(params.regions, geometry.nodes, geometry.blocks, geometry.tables, records, blocks, regions,
                        params);
        RoundResult result{records.read(), {}, {}};
        double arrivals = 0, seen = 0;
        for (const auto& region : regions.read()) {
            arrivals += region.arrivals;
            seen += region.seenArrivals;
            for (unsigned c = 0; c < LIGHT_CLASSES; ++c) result.density[c] += double(region.density[c]) / params.paths;
            for (unsigned o = 0; o < DISTANCE_OCTAVES; ++o)
                result.densityByOctave[o] += double(region.densityByOctave[o]) / params.paths;
        }
        if (arrivals > 0) result.seenShare = seen / arrivals;
        return result;
    }

    void preparePhotonMap(const shared::CameraParams& path, const shared::PhotonParams& photon, unsigned classes) {
        if (path.scene.meter.kind == METER_NONE)
            prepareCamera(path, classes);
        else
            meter.emplace(device, program, geometry, film, path, classes, meanRadiance(flat));
        const PilotResult expected = pilot(program, photon, classes, true);
        const BufferSizes sizes = planPass(flat, settings, expected.photons, device.info());
        checkFits(sizes, device.info(), flat, settings);
        forecast(sizes, sumOf(sizes) - sumOf(planScene(flat, settings, device.info())));
        photons.emplace(device, program, geometry, photon, classes, storesDepth(), expected.photons);
        photons->thinVolume(expected.keepProbability);
        photons->useField(field);
        if (meterCountsPhotons(flat.features, settings)) photons->countAt(meter->counted());
    }

    void prepareCamera(const shared::CameraParams& path, unsigned classes) {
        if (adaptsRadius(flat.features, settings)) adaptive.emplace(device, program, flat.camera, classes);
        if (const unsigned floats = SharedSamples::floatsPerSample(flat, settings))
            samples.emplace(device, program, flat.camera, floats);
        camera.emplace(program, geometry, film, path, adaptive ? &*adaptive : nullptr, samples ? &*samples : nullptr);
    }

    void prepareCameraMap(const shared::CameraParams& path, const shared::PhotonParams& photon, unsigned classes) {
        PilotResult expected;
        if (!flat.media.empty()) {
            const Program photonMap(device, "photon_map_pass.cl", kernelOptions(flat, settings));
            expected = pilot(photonMap, photon, classes, false);
        }
        cameraMap.emplace(device, program, geometry, film, path, photon, classes, meanRadiance(flat));
        cameraMap->thinVolume(expected.keepProbability);
        cameraMap->makeRoom(pilotPass, radii(0), volumeScale(0));
        // All else has been written to; of points as traced not even that much, as regions have room to spare.
        forecast(buffers, buffers.at("camera point cell counts") + buffers.at("camera point cells"));
    }

    // Traces a few photons apart from all passes and counts what they leave. The runtime compiles kernels when they are
    // first launched: this is the time, `compilesCamera` also for those of camera paths.
    PilotResult pilot(const Program& photonMap, shared::PhotonParams params, unsigned classes, bool compilesCamera) {
        params.paths = std::min(pilotPaths, params.paths);
        PhotonStage stage(device, photonMap, geometry, params, classes, storesDepth());
        std::optional<MeterSums> uncounted;
        if (meterCountsPhotons(flat.features, settings))
            stage.countAt(uncounted.emplace(device, classes, film.pixels(), meanRadiance(flat)));
        stage.useField(field);
        const PhotonPassCount counted = stage.run(pilotPass, radii(0), volumeScale(0));
        stage.compile();
        if (compilesCamera && camera) camera->compile(stage);
        if (compilesCamera && meter) meter->compile(stage);
        device.finish();
        return expectPass(counted, report.photonsPerPass);
    }

    // `untouched` bytes of the buffers are still to become resident: those of a CPU device are memory of this process.
    void forecast(const BufferSizes& sizes, uint64_t untouched) {
        report.forecast.deviceBytes = sumOf(sizes);
        const uint64_t toCome = developBytes(flat, settings) + (device.info().isCpu ? untouched : 0);
        report.forecast.hostPeakBytes = std::max(peakResidentBytes(), residentBytes() + toCome);
    }

    bool storesDepth() const { return compiledFeatures(flat, settings).depthLimit; }

    float volumeScale(unsigned pass) const { return static_cast<float>(settings.radiusScale * volumeShrink(pass)); }

    double largestRadiusByArea() const { return firstRadiusByArea(flat.surfaceArea, settings, report.photonsPerPass); }

    // As photons lie about what the camera sees, where that is known.
    double firstRadiusOf(unsigned lightClass) const {
        const double byArea = largestRadiusByArea() * classRadiusFactor(lightClass);
        double all = 0;
        for (const double ofClass : learned->density) all += ofClass;
        if (!(all > 0)) return byArea;
        const auto radiusOf = [&](double perPhoton) {
            return perPhoton > 0 ? radiusOfPhotons(perPhoton * report.photonsPerPass) : byArea;
        };
        const double byDensity = std::min(radiusOf(learned->density[lightClass]), rareClassRadius * radiusOf(all));
        return std::min(byArea, settings.radiusScale * byDensity);
    }

    std::array<float, LIGHT_CLASSES> radii(unsigned pass) const {
        std::array<float, LIGHT_CLASSES> radius{};
        for (unsigned c = 0; c < LIGHT_CLASSES; ++c)
            radius[c] = static_cast<float>(firstRadiusOf(c) * radiusShrink(pass));
        return radius;
    }

    void noteMapSize(uint64_t records, uint64_t bytes) {
        counters.storedPoints = std::max(counters.storedPoints, records);
        counters.storedBytes = std::max(counters.storedBytes, bytes);
    }

    void noteTraced(const TraceCount& ofPass) {
        counters.cutPaths += ofPass.cutPaths;
        counters.nonFinite += ofPass.nonFinite;
        counters.overflows += ofPass.overflows;
        counters.clipped += ofPass.clipped;
        counters.fluxCut += ofPass.fluxCut;
        if (meterCountsCaustics(flat.features, settings))
            counters.meterCaustics = counters.meterCaustics.value_or(0) + ofPass.meterCaustics;
        if (!settings.energyBalance) return;
        if (!counters.energy) counters.energy.emplace();
        *counters.energy += ofPass.energy;
    }

    // Radii of this pass are chosen with the photons of earlier ones; where these were not rendered here, they are traced for that
    // alone.
    void catchUpRadii(unsigned pass) {
        while (adaptive && takesPhotons() && adaptive->pilotPasses() < AdaptiveRadius::pilotPassesBefore(pass)) {
            const unsigned earlier = adaptive->pilotPasses();
            photons->run(earlier, radii(earlier), volumeScale(earlier));
            chooseRadius(earlier);
        }
    }

    bool takesPhotons() const { return photonClasses(flat.features, settings) != 0; }

    // Kernels that other methods share know photons even where this one takes none: then their map is left empty, once for all.
    PhotonPassCount tracePhotons(unsigned pass) {
        if (mapIsEmpty) return {};
        mapIsEmpty = !takesPhotons();
        const auto count = photons->run(pass, radii(pass), volumeScale(pass));
        counters.photonsEmitted += photons->photonsPerPass();
        return count;
    }

    void runPhotonMap(unsigned pass) {
        catchUpRadii(pass);
        const auto count = tracePhotons(pass);
        noteTraced(count);
        if (meter)
            meter->run(pass, *photons);
        else
            runCamera(pass);
        uint64_t stored = 0;
        for (unsigned slot = 0; slot < PHOTON_SLOTS; ++slot) {
            if (count.stored[slot] > 0) counters.photonsStored[slotName(slot)] += count.stored[slot];
            stored += count.stored[slot];
        }
        noteMapSize(stored, stored * PhotonArrays::photonBytes(storesDepth()));
    }

    void runCamera(unsigned pass) {
        camera->run(pass, *photons);
        if (!takesPhotons() || !camera->radiusIsDue(pass)) return;
        device.finish();
        chooseRadius(pass);
    }

    void chooseRadius(unsigned pass) {
        const auto start = Clock::now();
        counters.radiusPaths += camera->chooseRadius(pass, *photons);
        device.finish();
        counters.radiusSeconds += since(start);
    }

    // Of the pass after the last one.
    std::optional<GatheredCount> countGathered() {
        if (!camera) return std::nullopt;
        const unsigned pass = nextPass;
        auto timingsOfPasses = device.timings();
        catchUpRadii(pass);
        photons->run(pass, radii(pass), volumeScale(pass));
        const auto count =
            quasilux::countGathered(device, kernelOptions(flat, settings), geometry, *photons,
                                    camera->params(pass, *photons), adaptive ? &adaptive->scales(pass) : nullptr);
        device.resetTimings(std::move(timingsOfPasses));
        return count;
    }

    void runCameraMap(unsigned pass) {
        const auto count = cameraMap->run(pass, radii(pass), volumeScale(pass));
        noteTraced(count);
        uint64_t stored = 0;
        for (unsigned slot = 0; slot < PHOTON_SLOTS; ++slot) {
            if (count.points[slot] > 0) counters.cameraPointsStored[slotName(slot)] += count.points[slot];
            stored += count.points[slot];
        }
        noteMapSize(stored, stored * CameraMapStage::pointBytes() + count.borders * CameraMapStage::borderBytes());
        counters.photonsEmitted += cameraMap->photonsPerPass();
        counters.throughputCut += count.throughputCut;
    }

    Device& device;
    BufferSizes buffers;                   // its own, by label
    std::optional<AllocationNotes> noting; // while it is constructed
    RenderSettings settings;
    DeviceScene flat;
    Program program;
    GeometryBuffers geometry;
    std::shared_ptr<const LearnedScene> learned;
    std::unique_ptr<Learning> learning; // while it goes on
    shared::RadiusField field{};
    Film film;
    std::optional<PhotonStage> photons;     // this and one of the next two, or
    bool mapIsEmpty = false;                // and stays so
    std::optional<AdaptiveRadius> adaptive; // where the camera stage has it
    std::optional<SharedSamples> samples;   // of a filter wider than a pixel
    std::optional<CameraStage> camera;
    std::optional<MeterStage> meter;
    std::optional<CameraMapStage> cameraMap; // this
    SceneReport report;
    RenderCounters counters;
    shared::CameraCounters dropped{}; // by the film, so far
    unsigned nextPass = 0;
};

Renderer::Renderer(Device& device, const Scene& scene, const RenderSettings& settings,
                   std::shared_ptr<const LearnedScene> known, const SceneChecksums& expected) {
    const auto start = Clock::now();
    DeviceScene flat = flattenFor(scene, settings);
    if (settings.map == MapOrder::camera) refuseRelief(scene);
    flat.features.directByPhotons = mayTakeDirectFromPhotons(flat.features, settings);
    checkCaustics(scene, flat.features, settings);
    auto checksums = checksumsOf(flat, scene.maxDepth);
    if (!expected.empty()) requireSame(expected, checksums);
    if (known && !known->tables.guide.leaves.empty()) setLearned(flat, known->tables);
    const double prepareSeconds = since(start);
    checkFits(planScene(flat, settings, device.info()), device.info(), flat, settings);
    stages_ = std::make_unique<Stages>(device, scene, settings, std::move(flat), std::move(known));
    stages_->report.checksums = std::move(checksums);
    stages_->counters.prepareSeconds = prepareSeconds;
    stages_->counters.compileSeconds = since(start) - prepareSeconds;
}

Renderer::~Renderer() = default;

void Renderer::renderPass(unsigned pass) {
    auto& s = *stages_;
    const auto start = Clock::now();
    const AllocationNotes noting(s.device, s.buffers);
    if (s.cameraMap)
        s.runCameraMap(pass);
    else
        s.runPhotonMap(pass);
    s.device.timings(); // waits; and events, one for each launch, must not pile up

    auto& counters = s.counters;
    const auto dropped = s.film.counters();
    counters.nonFinite += dropped.nonFinite - s.dropped.nonFinite;
    counters.cutPaths += dropped.cutPaths - s.dropped.cutPaths;
    counters.throughputCut += double(dropped.cutThroughput - s.dropped.cutThroughput) / CUT_THROUGHPUT_STEPS;
    s.dropped = dropped;
    counters.cameraPaths += s.film.pixels() * s.pathsPerPixel();
    counters.fluxEmitted += s.flat.emittedFlux;
    const double seconds = since(start);
    if (counters.passes++ == 0) counters.firstPassSeconds = seconds;
    counters.renderSeconds += seconds;
    s.nextPass = pass + 1;
    s.film.endPass();
}

Renderer::FilmShape Renderer::filmShape() const {
    const auto& camera = stages_->flat.camera;
    return {camera.width, camera.height, stages_->film.layout()};
}

unsigned Renderer::nextPass() const { return stages_->nextPass; }

void Renderer::saveState(StateSink& sink) const {
    stages_->film.save(sink, "film");
    saveRadii(sink);
}

void Renderer::restoreState(const StateSource& source, const RenderCounters& counters, unsigned nextPass) {
    auto& s = *stages_;
    s.film.restore(source, "film");
    s.dropped = s.film.counters();
    if (s.adaptive) s.adaptive->restore(source);
    const double prepareSeconds = s.counters.prepareSeconds, compileSeconds = s.counters.compileSeconds;
    s.counters = counters;
    s.counters.prepareSeconds += prepareSeconds;
    s.counters.compileSeconds += compileSeconds;
    s.nextPass = nextPass;
}

bool Renderer::radiiAreChosen() const {
    const auto& s = *stages_;
    return !s.adaptive || !s.takesPhotons() || s.adaptive->pilotHasEnded();
}

void Renderer::saveRadii(StateSink& sink) const {
    if (stages_->adaptive) stages_->adaptive->save(sink);
}

void Renderer::restoreRadii(const StateSource& source) {
    if (stages_->adaptive) stages_->adaptive->restore(source);
}

void Renderer::clearPasses() {
    stages_->film.clear();
    stages_->dropped = {};
    stages_->counters = {};
}

bool Renderer::isFilmWhole() const { return stages_->film.isWhole(); }

const Film& Renderer::film() const { return stages_->film; }

FilmImage Renderer::develop() const { return stages_->film.develop(static_cast<unsigned>(stages_->counters.passes)); }

void Renderer::developOver(FilmImage& image) const {
    stages_->film.developOver(image, static_cast<unsigned>(stages_->counters.passes));
}

std::shared_ptr<const LearnedScene> Renderer::learned() const { return stages_->learned; }

const SceneReport& Renderer::report() const {
    stages_->report.bufferBytes = stages_->buffers;
    return stages_->report;
}

std::optional<GatheredCount> Renderer::countGathered() { return stages_->countGathered(); }

const RenderCounters& Renderer::counters() const { return stages_->counters; }

} // namespace quasilux

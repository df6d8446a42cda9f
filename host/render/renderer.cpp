#include "render/renderer.h"

#include "render/adaptive_radius.h"
#include "render/learned_scene.h"
#include "render/method.h"
#include "render/noise_probe.h"
#include "render/pass.h"
#include "render/pass_params.h"
#include "render/pass_program.h"
#include "render/radius_field.h"
#include "util/stopwatch.h"

namespace quasilux {

namespace {

/// Points of the camera map hold one normal and no direction about it, and of textures what multiplies a lobe only.
void refuseForCameraMap(const Scene& scene) {
    const auto whatNeedsPhotons = [](const Bsdf& bsdf) {
        if (bsdf.isAnisotropic()) return "anisotropic roughness needs";
        if (bsdf.frontRelief || bsdf.backRelief) return "normal and bump maps need";
        return bsdf.hasIndexTexture() ? "textures of eta and k need" : nullptr;
    };
    for (const Bsdf& bsdf : scene.bsdfs)
        if (const char* const what = whatNeedsPhotons(bsdf))
            throw InputError(bsdf.where, std::string(what) + " --map photons, and the map is 'camera'.");
}

void checkCaustics(const Scene& scene, const Features& features, const RenderSettings& settings) {
    if (settings.caustics != CausticLight::paths) return;
    const std::string why = whyNotCausticsByPaths(scene, features, settings);
    if (!why.empty()) throw InputError("--caustics paths: " + why + '.');
}

shared::RadiusField fieldOf(const DeviceScene& flat, const RenderSettings& settings, const RadiusSchedule& radii,
                            const LearnedScene& learned) {
    double usual = radii.firstByArea();
    for (unsigned c = 0; c < LIGHT_CLASSES; ++c)
        if (photonClasses(flat.features, settings) >> c & 1) usual = std::min(usual, radii.first(c));
    return radiusField(learned, usual, radii.firstByArea() / usual);
}

} // namespace

// What a render holds from its beginning to its end, in the order in which it is made.
struct Renderer::Stages {
    Stages(Device& device_, const Scene& scene, const RenderSettings& settings_, DeviceScene flat_, KnownScene known)
        : device(device_), settings(settings_), flat(std::move(flat_)), shapes(std::move(known.geometry)) {
        const AllocationNotes noting(device, buffers);
        program.emplace(passProgram(device, settings.map, flat, settings));
        geometry.emplace(device, flat);
        auto timingsBefore = device.timings();
        learned = known.learned ? std::move(known.learned) : learn(scene);
        film.emplace(device, flat.camera.width, flat.camera.height, filmLayout(flat.features, settings),
                     largestFilmBuffer(flat.features, settings, device.info()));
        report = describeScene(scene, flat, settings);
        chooseRadii();
        report.learned = describeLearned(*learned, field, report.photonsPerPass);
        preparePasses(scene);
        device.resetTimings(std::move(timingsBefore)); // only those of passes count
        // On the device now; the depth of the tree stays, as kernels to come are compiled for it.
        flat.bvh.nodes = {};
        flat.bvh.blocks = {};
        flat.tables = {};
    }

    std::shared_ptr<const LearnedScene> learn(const Scene& scene) {
        const Stopwatch watch;
        LearnedScene found = learnScene(device, *program, scene, settings, flat, *geometry);
        found.seconds = watch.seconds();
        return std::make_shared<const LearnedScene>(std::move(found));
    }

    void chooseRadii() {
        radii.emplace(flat, settings, *learned);
        for (unsigned c = 0; c < LIGHT_CLASSES; ++c)
            if (photonClasses(flat.features, settings) >> c & 1) report.initialRadius[slotName(c)] = radii->first(c);
        if (learned->density == decltype(learned->density){}) return;
        field = fieldOf(flat, settings, *radii, *learned);
    }

    void preparePasses(const Scene& scene) {
        auto photon = photonParams(scene, flat, settings);
        photon.usualWorth = static_cast<float>(learned->usualWorth / photon.paths);
        auto camera = cameraParams(flat, settings, photon.maxDepth);
        camera.directSamples = report.learned.directSamples =
            directSamplesOf(*learned, photonClasses(flat.features, settings), settings.cameraPaths);
        context.emplace(PassContext{device, *program, *geometry, flat, settings, *radii, field, *film, buffers,
                                    compiledClasses(flat.features, settings), camera, photon});
        passes = makePass(*context);
        report.photonParts = passes->photonParts();
        report.forecast = withLayers(passes->forecast(), scene, flat, settings, device.info());
    }

    Device& device;
    BufferSizes buffers; // its own, by label
    RenderSettings settings;
    DeviceScene flat;
    std::shared_ptr<const SceneGeometry> shapes; // kept for other renderers
    std::optional<Program> program;
    std::optional<GeometryBuffers> geometry;
    std::shared_ptr<const LearnedScene> learned;
    std::optional<Film> film;
    SceneReport report;
    std::optional<RadiusSchedule> radii;
    shared::RadiusField field{};
    std::optional<PassContext> context;
    std::unique_ptr<Pass> passes;
    RenderCounters counters;
    shared::CameraCounters dropped{}; // by the film, so far
    unsigned nextPass = 0;
};

Renderer::Renderer(Device& device, const Scene& scene, const RenderSettings& settings, const KnownScene& known,
                   const SceneChecksums& expected) {
    const Stopwatch watch;
    DeviceScene flat = flattenFor(scene, settings, known.geometry.get());
    if (settings.map == MapOrder::camera) refuseForCameraMap(scene);
    flat.features.directByPhotons = mayTakeDirectFromPhotons(flat.features, settings);
    checkCaustics(scene, flat.features, settings);
    auto checksums = checksumsOf(flat, scene.maxDepth);
    if (!expected.empty()) requireSame(expected, checksums);
    if (known.learned && !known.learned->tables.guide.leaves.empty()) setLearned(flat, known.learned->tables);
    const double prepareSeconds = watch.seconds();
    for (const BufferSizes& sizes : {planScene(flat, settings, device.info()), planAovs(scene, flat, device.info())})
        checkFits(sizes, device.info(), flat, settings);
    stages_ = std::make_unique<Stages>(device, scene, settings, std::move(flat), known);
    stages_->report.checksums = std::move(checksums);
    stages_->counters.prepareSeconds = prepareSeconds;
    stages_->counters.compileSeconds = watch.seconds() - prepareSeconds;
}

Renderer::~Renderer() = default;

void Renderer::renderPass(unsigned pass) {
    auto& s = *stages_;
    const Stopwatch watch;
    const AllocationNotes noting(s.device, s.buffers);
    s.passes->run(pass, s.counters);
    s.device.timings(); // waits; and events, one for each launch, must not pile up

    auto& counters = s.counters;
    const auto dropped = s.film->counters();
    counters.nonFinite += dropped.nonFinite - s.dropped.nonFinite;
    counters.cutPaths += dropped.cutPaths - s.dropped.cutPaths;
    counters.throughputCut += double(dropped.cutThroughput - s.dropped.cutThroughput) / CUT_THROUGHPUT_STEPS;
    s.dropped = dropped;
    counters.cameraPaths += s.passes->cameraPaths();
    counters.fluxEmitted += s.flat.emittedFlux;
    const double seconds = watch.seconds();
    if (counters.passes++ == 0) counters.firstPassSeconds = seconds;
    counters.renderSeconds += seconds;
    s.nextPass = pass + 1;
    s.film->endPass();
}

Renderer::FilmShape Renderer::filmShape() const {
    const auto& camera = stages_->flat.camera;
    return {camera.width, camera.height, stages_->film->layout()};
}

unsigned Renderer::nextPass() const { return stages_->nextPass; }

void Renderer::saveState(StateSink& sink) const {
    stages_->film->save(sink, "film");
    saveRadii(sink);
}

void Renderer::restoreState(const StateSource& source, const RenderCounters& counters, unsigned nextPass) {
    auto& s = *stages_;
    s.film->restore(source, "film");
    s.dropped = s.film->counters();
    restoreRadii(source);
    const double prepareSeconds = s.counters.prepareSeconds, compileSeconds = s.counters.compileSeconds;
    s.counters = counters;
    s.counters.prepareSeconds += prepareSeconds;
    s.counters.compileSeconds += compileSeconds;
    s.nextPass = nextPass;
}

bool Renderer::radiiAreChosen() const { return stages_->passes->radiiAreChosen(); }

void Renderer::saveRadii(StateSink& sink) const { stages_->passes->saveRadii(sink); }

void Renderer::restoreRadii(const StateSource& source) { stages_->passes->restoreRadii(source); }

void Renderer::clearPasses() {
    stages_->film->clear();
    stages_->dropped = {};
    stages_->counters = {};
}

double Renderer::secondsWithoutGathering() {
    const double seconds = stages_->passes->secondsWithoutGathering();
    stages_->film->clear();
    stages_->dropped = {};
    return seconds;
}

SamplingGain Renderer::samplingGain(unsigned paths) { return stages_->passes->samplingGain(paths); }

double Renderer::pathsOfSamplingGain(unsigned paths) const {
    return NoiseProbe::costByPixel(stages_->flat.camera, paths);
}

bool Renderer::isFilmWhole() const { return stages_->film->isWhole(); }

const Film& Renderer::film() const { return *stages_->film; }

FilmImage Renderer::develop() const { return stages_->film->develop(static_cast<unsigned>(stages_->counters.passes)); }

std::vector<AovImage> Renderer::layers(const Scene& scene) const {
    const auto& s = *stages_;
    auto timingsOfPasses = s.device.timings();
    auto layers = renderAovs(s.device, scene, s.flat, *s.geometry, s.settings,
                             aovSamples(static_cast<unsigned>(s.counters.passes)));
    s.device.resetTimings(std::move(timingsOfPasses));
    return layers;
}

void Renderer::developOver(FilmImage& image) const {
    stages_->film->developOver(image, static_cast<unsigned>(stages_->counters.passes));
}

std::shared_ptr<const LearnedScene> Renderer::learned() const { return stages_->learned; }

KnownScene Renderer::known() const { return {stages_->learned, stages_->shapes}; }

const SceneReport& Renderer::report() const {
    stages_->report.bufferBytes = stages_->buffers;
    return stages_->report;
}

std::optional<GatheredCount> Renderer::countGathered() {
    auto& s = *stages_;
    auto timingsOfPasses = s.device.timings();
    auto count = s.passes->countGathered(s.nextPass);
    s.device.resetTimings(std::move(timingsOfPasses));
    return count;
}

const RenderCounters& Renderer::counters() const { return stages_->counters; }

} // namespace quasilux

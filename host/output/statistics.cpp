// What is known of a render, as JSON.
#include "output/statistics.h"

#include "output/atomic_file.h"
#include "output/meter_reading.h"
#include "render/scene_report.h"

namespace quasilux {

using nlohmann::json;

namespace {

template <typename T>
json orNull(const std::optional<T>& value) {
    return value ? json(*value) : json(nullptr);
}

json kernelsJson(const std::map<std::string, KernelTiming>& kernels) {
    json rows = json::object();
    for (const auto& [kernel, timing] : kernels)
        rows[kernel] = {
            {"launches", timing.launches}, {"seconds", timing.seconds}, {"privateBytes", timing.privateBytes}};
    return rows;
}

json energyJson(const std::optional<EnergyBalance>& energy) {
    if (!energy) return nullptr;
    return {{"emitted", energy->emitted},         {"absorbed", energy->absorbed},
            {"escaped", energy->escaped},         {"cut", energy->cut},
            {"beyondDepth", energy->beyondDepth}, {"lostByChance", energy->lost},
            {"gainedByChance", energy->gained},   {"imbalance", energy->imbalance()}};
}

json gatheredJson(const std::optional<GatheredCount>& count) {
    if (!count) return nullptr;
    json stored = json::object(), gathered = json::object();
    for (unsigned slot = 0; slot < PHOTON_SLOTS; ++slot) {
        if (count->stored[slot] == 0) continue;
        stored[slotName(slot)] = count->stored[slot];
        gathered[slotName(slot)] = count->gathered[slot];
    }
    return {{"share", count->share()}, {"stored", stored}, {"gathered", gathered}};
}

json phasesJson(const RenderRecord& record) {
    return {{"load", record.loadSeconds},
            {"prepare", record.counters.prepareSeconds},
            {"compile", record.counters.compileSeconds},
            {"firstPass", record.counters.firstPassSeconds},
            {"render", record.counters.renderSeconds},
            {"write", record.writeSeconds}};
}

} // namespace

json countersJson(const RenderCounters& counters) {
    return {{"passes", counters.passes},
            {"photonsEmitted", counters.photonsEmitted},
            {"photonsStored", counters.photonsStored},
            {"cameraPointsStored", counters.cameraPointsStored},
            {"storedPoints", counters.storedPoints},
            {"storedBytes", counters.storedBytes},
            {"cameraPaths", counters.cameraPaths},
            {"nonFinite", counters.nonFinite},
            {"cutPaths", counters.cutPaths},
            {"overflows", counters.overflows},
            {"photonsClipped", counters.clipped},
            {"meterCaustics", counters.meterCaustics ? json(*counters.meterCaustics) : json()},
            {"fluxEmitted", counters.fluxEmitted},
            {"fluxCut", counters.fluxCut},
            {"energyBalance", energyJson(counters.energy)},
            {"throughputCut", counters.throughputCut}};
}

namespace {

json errorPartJson(const ErrorPart& part, bool hasBias) {
    return {{"noiseMean", part.noiseMean},
            {"noisePercentile95", part.noisePercentile95},
            {"noiseRms", part.noiseRms},
            {"biasRms", hasBias ? json(part.biasRms) : json(nullptr)},
            {"biasNoiseRms", hasBias ? json(part.biasNoiseRms) : json(nullptr)}};
}

} // namespace

json errorJson(const ErrorEstimate& error) {
    json components = json::object();
    for (unsigned c = 0; c < LIGHT_CLASSES; ++c)
        if (error.components[c].noiseRms > 0)
            components[componentName(c)] = errorPartJson(error.components[c], error.hasBias);
    return {{"relativeError", error.sum()},
            {"relativeMse", error.relativeMse()},
            {"total", errorPartJson(error.total, error.hasBias)},
            {"components", components}};
}

json deviceJson(const DeviceInfo& device) {
    return {{"name", device.name},
            {"platform", device.platform},
            {"version", device.version},
            {"driver", device.driver},
            {"computeUnits", device.computeUnits},
            {"globalMemory", device.globalMemory},
            {"maximumAllocation", device.maximumAllocation},
            {"isCpu", device.isCpu}};
}

json searchJson(const SearchReport& search) {
    json rows = json::array();
    for (const PilotRow& row : search.rows)
        rows.push_back({{"bdd", row.settings.bdd},
                        {"variant", name(row.settings.variant)},
                        {"quasiSpecular", row.settings.quasiSpecular},
                        {"caustics", name(row.settings.caustics)},
                        {"photonsPerPass", row.photonsPerPass},
                        {"cameraPaths", row.settings.cameraPaths},
                        {"cameraSampling", name(row.settings.cameraSampling)},
                        {"radiusScale", row.settings.radiusScale},
                        {"passes", row.passes},
                        {"secondsPerPass", row.secondsPerPass},
                        {"openingSeconds", row.openingSeconds},
                        {"predictedError", row.predictedError},
                        {"outcome", row.outcome}});
    return {
        {"line", search.line()},
        {"searched", text(search.freedom)},
        {"candidates", rows},
        {"chosen", search.rows.empty() ? json(nullptr) : json(search.chosen)},
        {"pilotPasses", search.passes},
        {"pilotSeconds", search.seconds},
        {"horizon", search.horizon},
        {"predictedError", search.rows.empty() ? json(nullptr) : json(search.rows.at(search.chosen).predictedError)},
        {"outOfTime", search.outOfTime}};
}

json workersJson(const std::vector<WorkerRecord>& workers) {
    json rows = json::array();
    for (const WorkerRecord& one : workers)
        rows.push_back({{"name", one.name},
                        {"passes", one.passes},
                        {"seconds", one.seconds},
                        {"spread", one.spread()},
                        {"failure", one.failure.empty() ? json(nullptr) : json(one.failure)}});
    return rows;
}

json settingsJson(const RenderSettings& settings) {
    return {{"bdd", settings.bdd},
            {"variant", name(settings.variant)},
            {"direct", name(settings.direct)},
            {"caustics", name(settings.caustics)},
            {"map", name(settings.map)},
            {"emission", name(settings.emission)},
            {"quasiSpecular", settings.quasiSpecular},
            {"quasiSpecularOverridesScene", settings.quasiSpecularOverridesScene},
            {"photonsPerPass", settings.photonsPerPass},
            {"cameraPaths", settings.cameraPaths},
            {"cameraSampling", name(settings.cameraSampling)},
            {"seed", settings.seed},
            {"radius", name(settings.radius)},
            {"radiusScale", settings.radiusScale},
            {"units", settings.photometric ? "photometric" : "radiometric"},
            {"kernels", settings.genericKernels ? "generic" : "scene"}};
}

json sceneReportJson(const SceneReport& report) {
    json emitters = json::array(), lobes = json::array(), media = json::array();
    for (const auto& row : report.emitters)
        emitters.push_back({{"id", row.id}, {"type", row.type}, {"power", row.power}, {"radiance", row.radiance}});
    for (const auto& row : report.lobes)
        lobes.push_back({{"bsdf", row.bsdf}, {"lobe", row.lobe}, {"scattering", row.scattering}, {"why", row.why}});
    for (const auto& row : report.media)
        media.push_back({{"medium", row.medium},
                         {"level", row.level}, // infinity, all of it genuine diffuse, becomes null
                         {"why", row.why},
                         {"kernelRadius", row.kernelRadius},
                         {"kernelHalfHeight", row.kernelHalfHeight}});
    return {
        {"triangles", report.triangles},
        {"spheres", report.spheres},
        {"patches", report.patches},
        {"borderSegments", report.borderSegments},
        {"features", report.features},
        {"emitters", emitters},
        {"lobes", lobes},
        {"media", media},
        {"photonClasses", report.photonClasses},
        {"bufferBytes", report.bufferBytes},
        {"forecast", {{"deviceBytes", report.forecast.deviceBytes}, {"hostPeakBytes", report.forecast.hostPeakBytes}}},
        {"photonsPerPass", report.photonsPerPass},
        {"photonParts", report.photonParts},
        {"initialRadius", report.initialRadius},
        {"learned",
         {{"guided", report.learned.isGuided},
          {"leaves", report.learned.leaves},
          {"openings", report.learned.openings},
          {"aims", report.learned.aims},
          {"emittersByPhotons", report.learned.emittersByPhotons},
          {"directSamples", report.learned.directSamples},
          {"weightWindows", report.learned.hasWeightWindows},
          {"lightOfPhotons", report.learned.lightOfPhotons},
          {"effectivePhotons", orNull(report.learned.effectivePhotons)},
          {"radiusFactors", report.learned.radiusFactors},
          {"seconds", report.learned.seconds}}},
        {"warnings", report.warnings}};
}

json statisticsJson(const RenderRecord& record, const FilmImage& image) {
    json device = deviceJson(record.device);
    device["workGroupSize"] = record.workGroupSize;
    const json meter = record.meter == MeterKind::none ? json(nullptr) : meterJson(record, image);
    // nlohmann writes infinity, an unknown error, as null.
    return {{"version", record.version},
            {"scene", record.scene},
            {"image", {{"width", image.width}, {"height", image.height}}},
            {"meter", meter},
            {"settings", settingsJson(record.settings)},
            {"auto", searchJson(record.search)},
            {"stop",
             {{"seconds", orNull(record.stop.seconds)},
              {"passes", orNull(record.stop.passes)},
              {"relativeError", orNull(record.stop.relativeError)},
              {"interrupted", record.interrupted},
              {"failure", record.failure.empty() ? json(nullptr) : json(record.failure)}}},
            {"device", device},
            {"sceneReport", sceneReportJson(record.report)},
            {"counters", countersJson(record.counters)},
            {"gatheredPhotons", gatheredJson(record.gathered)},
            {"error", errorJson(record.error)},
            {"kernels", kernelsJson(record.kernels)},
            {"workers", workersJson(record.workers)},
            {"phases", phasesJson(record)},
            {"peakBufferBytes", record.peakBufferBytes},
            {"peakHostBytes", record.peakHostBytes}};
}

void writeJson(const std::string& path, const json& value) {
    // Names come from files and drivers: bytes that are not UTF-8 are replaced instead of ending the program.
    writeText(path, value.dump(2, ' ', false, json::error_handler_t::replace) + '\n');
}

} // namespace quasilux

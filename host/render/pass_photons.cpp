#include "render/pass_photons.h"

#include "render/method.h"
#include "render/pass_params.h"
#include "render/photon_forecast.h"
#include "render/scene_report.h"

namespace quasilux {

PassPhotons::PassPhotons(const PassContext& context, const std::function<void(const PhotonStage&)>& compile,
                         MeterSums* counted)
    : context_(context), areTaken_(photonClasses(context.flat.features, context.settings) != 0) {
    const DeviceScene& flat = context.flat;
    const RenderSettings& settings = context.settings;
    const DeviceInfo& device = context.device.info();
    const PhotonForecast expected = forecastPhotons(context, context.program, compile);
    const StoredPhotons stored = [&](unsigned paths) { return expected.stored(paths); };
    const unsigned count = partsThatFit(flat, settings, stored, device);
    for (unsigned number = 0; number < count; ++number) parts_.push_back({number, count});
    const unsigned paths = parts_.front().share(context.photons.paths);
    const BufferSizes sizes = planPass(flat, settings, stored(paths), device, count);
    checkFits(sizes, device, flat, settings, stored);
    forecast_ = forecastOf(context, sizes, sumOf(sizes) - sumOf(planScene(flat, settings, device)));
    stage_.emplace(context.device, context.program, context.geometry, withPaths(context.photons, paths),
                   context.classes, storesDepth(flat, settings), stored(paths));
    stage_->thinVolume(expected.keepProbability);
    stage_->useField(context.field);
    if (counted) stage_->countAt(*counted);
}

PhotonPassCount PassPhotons::run(unsigned pass, PassPart part) {
    return stage_->run(pass, part, context_.radii.radii(pass), context_.radii.volumeScale(pass));
}

// Kernels that other methods share know photons even where this one takes none: then their map is left empty, once for
// all.
void PassPhotons::trace(unsigned pass, PassPart part, RenderCounters& counters) {
    if (mapIsEmpty_) return;
    mapIsEmpty_ = !areTaken_;
    PhotonPassCount count = run(pass, part);
    count.weigh(1.0 / part.count);
    counters.photonsEmitted += stage_->photonsPerPass();
    counters.addTraced(count, meterCountsCaustics(context_.flat.features, context_.settings),
                       context_.settings.energyBalance);
    const uint64_t stored = addBySlot(counters.photonsStored, count.stored);
    counters.noteMapSize(stored, stored * PhotonArrays::photonBytes(storesDepth(context_.flat, context_.settings),
                                                                    context_.device.info()));
}

void PassPhotons::traceUncounted(unsigned pass, PassPart part) { run(pass, part); }

} // namespace quasilux

#include "render/pass_photons.h"

#include "render/method.h"
#include "render/photon_forecast.h"
#include "render/scene_report.h"

namespace quasilux {

PassPhotons::PassPhotons(const PassContext& context, const std::function<void(const PhotonStage&)>& compile,
                         MeterSums* counted)
    : context_(context), areTaken_(photonClasses(context.flat.features, context.settings) != 0) {
    const DeviceScene& flat = context.flat;
    const RenderSettings& settings = context.settings;
    const PhotonForecast expected = forecastPhotons(context, context.program, compile);
    const BufferSizes sizes = planPass(flat, settings, expected.photons, context.device.info());
    checkFits(sizes, context.device.info(), flat, settings, expected.photons);
    forecast_ = forecastOf(context, sizes, sumOf(sizes) - sumOf(planScene(flat, settings, context.device.info())));
    stage_.emplace(context.device, context.program, context.geometry, context.photons, context.classes,
                   storesDepth(flat, settings), expected.photons);
    stage_->thinVolume(expected.keepProbability);
    stage_->useField(context.field);
    if (counted) stage_->countAt(*counted);
}

PhotonPassCount PassPhotons::run(unsigned pass) {
    return stage_->run(pass, context_.radii.radii(pass), context_.radii.volumeScale(pass));
}

// Kernels that other methods share know photons even where this one takes none: then their map is left empty, once for
// all.
void PassPhotons::trace(unsigned pass, RenderCounters& counters) {
    if (mapIsEmpty_) return;
    mapIsEmpty_ = !areTaken_;
    const PhotonPassCount count = run(pass);
    counters.photonsEmitted += stage_->photonsPerPass();
    counters.addTraced(count, meterCountsCaustics(context_.flat.features, context_.settings),
                       context_.settings.energyBalance);
    const uint64_t stored = addBySlot(counters.photonsStored, count.stored);
    counters.noteMapSize(stored, stored * PhotonArrays::photonBytes(storesDepth(context_.flat, context_.settings),
                                                                    context_.device.info()));
}

void PassPhotons::traceUncounted(unsigned pass) { run(pass); }

} // namespace quasilux

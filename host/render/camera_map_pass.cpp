#include "render/camera_map_pass.h"

#include "render/method.h"
#include "render/pass_params.h"
#include "render/pass_program.h"
#include "render/photon_forecast.h"

namespace quasilux {

CameraMapPass::CameraMapPass(const PassContext& context)
    : context_(context), stage_(context.device, context.program, context.geometry, context.film, context.camera,
                                context.photons, context.classes, meanRadiance(context.flat)) {
    if (!context.flat.media.empty()) {
        const Program photonMap = passProgram(context.device, MapOrder::photons, context.flat, context.settings);
        stage_.thinVolume(forecastPhotons(context, photonMap).keepProbability);
    }
    stage_.makeRoom(forecastPass, context.radii.radii(0), context.radii.volumeScale(0));
    // All else has been written to; of points as traced not even that much, as regions have room to spare.
    forecast_ = forecastOf(context, context.buffers,
                           context.buffers.at("camera point cell counts") + context.buffers.at("camera point cells"));
}

void CameraMapPass::run(unsigned pass, RenderCounters& counters) {
    const CameraMapPassCount count = stage_.run(pass, context_.radii.radii(pass), context_.radii.volumeScale(pass));
    counters.addTraced(count, meterCountsCaustics(context_.flat.features, context_.settings),
                       context_.settings.energyBalance);
    const uint64_t stored = addBySlot(counters.cameraPointsStored, count.points);
    counters.noteMapSize(stored, stored * CameraMapStage::pointBytes() + count.borders * CameraMapStage::borderBytes());
    counters.photonsEmitted += stage_.photonsPerPass();
    counters.throughputCut += count.throughputCut;
}

} // namespace quasilux

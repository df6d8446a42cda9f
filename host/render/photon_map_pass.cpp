#include "render/photon_map_pass.h"

#include "render/coarse_camera.h"
#include "render/method.h"
#include "util/stopwatch.h"

namespace quasilux {

PhotonMapPass::PhotonMapPass(const PassContext& context) : context_(context) {
    const shared::Camera& camera = context.flat.camera;
    if (adaptsRadius(context.flat.features, context.settings))
        radii_.emplace(context.device, context.program, camera, context.classes);
    if (const unsigned floats = SharedSamples::floatsPerSample(context.flat, context.settings))
        samples_.emplace(context.device, context.program, camera, floats);
    camera_.emplace(context.device, context.program, context.geometry, context.film, context.camera,
                    context.settings.cameraPaths, radii_ ? &*radii_ : nullptr, samples_ ? &*samples_ : nullptr);
    photons_.emplace(context, [&](const PhotonStage& forecast) { camera_->compile(forecast); });
    forecast_ = photons_->forecast();
    if (context.settings.cameraSampling == CameraSampling::adaptive && context.settings.cameraPaths > 1)
        allocatePaths();
}

NoiseProbe PhotonMapPass::noiseProbe(unsigned paths) {
    return {context_.device, *camera_, *photons_, context_.flat.camera, context_.classes, paths};
}

void PhotonMapPass::allocatePaths() {
    const shared::Camera& camera = context_.flat.camera;
    camera_->setPaths(
        {context_.device, camera, coarseBlock(camera), noiseProbe(context_.settings.cameraPaths).allocate()});
}

SamplingGain PhotonMapPass::samplingGain(unsigned paths) { return noiseProbe(paths).gain(); }

void PhotonMapPass::run(unsigned pass, RenderCounters& counters) {
    catchUpRadii(pass, counters);
    const bool radiusIsDue = photons_->areTaken() && camera_->radiusIsDue(pass);
    for (const PassPart& part : photons_->parts()) {
        photons_->trace(pass, part, counters);
        camera_->run(pass, photons_->stage(), part);
        if (!radiusIsDue) continue;
        context_.device.finish();
        chooseRadii(pass, part, counters);
    }
}

// Radii of this pass are chosen with the photons of earlier ones; where these were not rendered here, they are traced
// for that alone.
void PhotonMapPass::catchUpRadii(unsigned pass, RenderCounters& counters) {
    while (radii_ && photons_->areTaken() && radii_->coarsePasses() < AdaptiveRadius::coarsePassesBefore(pass)) {
        const unsigned earlier = radii_->coarsePasses();
        for (const PassPart& part : photons_->parts()) {
            photons_->traceUncounted(earlier, part);
            chooseRadii(earlier, part, counters);
        }
    }
}

void PhotonMapPass::chooseRadii(unsigned pass, PassPart part, RenderCounters& counters) {
    const Stopwatch watch;
    counters.radiusPaths += camera_->chooseRadius(pass, photons_->stage(), part);
    context_.device.finish();
    counters.radiusSeconds += watch.seconds();
}

double PhotonMapPass::secondsWithoutGathering() {
    if (!photons_->areTaken()) return 0;
    const Stopwatch watch;
    camera_->runWithoutGathering(photons_->stage());
    context_.device.finish();
    return watch.seconds();
}

std::optional<GatheredCount> PhotonMapPass::countGathered(unsigned pass) {
    RenderCounters ofNoPass;
    catchUpRadii(pass, ofNoPass);
    photons_->traceUncounted(pass, photons_->parts().front());
    return quasilux::countGathered(context_.device, kernelOptions(context_.flat, context_.settings), context_.geometry,
                                   photons_->stage(), camera_->params(pass, photons_->stage()), camera_->tables(pass));
}

bool PhotonMapPass::radiiAreChosen() const {
    return !radii_ || !photons_->areTaken() || radii_->coarsePassesHaveEnded();
}

void PhotonMapPass::saveRadii(StateSink& sink) const {
    if (radii_) radii_->save(sink);
}

void PhotonMapPass::restoreRadii(const StateSource& source) {
    if (radii_) radii_->restore(source);
}

} // namespace quasilux

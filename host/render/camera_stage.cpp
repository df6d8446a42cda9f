#include "render/camera_stage.h"

namespace quasilux {

CameraStage::CameraStage(Device& device, const std::string& options, const GeometryBuffers& geometry, Film& film,
                         shared::CameraParams params, AdaptiveRadius* radii)
    : geometry_(geometry), film_(film), radii_(radii), program_(device, "camera_paths.cl", options),
      traceCameraPaths_(program_.kernel("traceCameraPaths")), params_(params) {}

void CameraStage::launch(Film& film, const Buffer<float>* radiusScales, const PhotonStage& photons) {
    const Film::Pass onFilm = film.beginPass(params_.pass);
    params_.batchWeight = onFilm.batchWeight;
    params_.map.biasWeight = onFilm.biasWeight;
    const auto launchWith = [&](const auto&... more) {
        traceCameraPaths_.launch(film.pixels(), geometry_.nodes, geometry_.blocks, geometry_.tables,
                                 photons.index().cellStart(), photons.index().sorted(), film.sums(),
                                 film.counterBuffer(), params_, more...);
    };
    if (radiusScales)
        launchWith(*radiusScales);
    else
        launchWith();
}

void CameraStage::run(unsigned pass, const PhotonStage& photons) {
    params_.pass = pass;
    params_.map = photons.index().map();
    params_.radiusBlock = radii_ ? radii_->block() : 1;
    launch(film_, radii_ ? &radii_->scales() : nullptr, photons);
    if (radii_ && radii_->pilotIsDue()) runPilot(photons);
}

// With the same photons: passes to come, whose radii this decides, have others.
void CameraStage::runPilot(const PhotonStage& photons) {
    const shared::Camera camera = params_.camera;
    params_.camera = radii_->pilotCamera();
    params_.radiusBlock = 1;
    launch(radii_->pilotFilm(), &radii_->pilotScales(), photons);
    params_.camera = camera;
    radii_->endPilotPass(params_.pass);
}

} // namespace quasilux

#include "render/camera_stage.h"

namespace quasilux {

CameraStage::CameraStage(const Program& pass, const GeometryBuffers& geometry, Film& film, shared::CameraParams params)
    : geometry_(geometry), film_(film), traceCameraPaths_(pass.kernel("traceCameraPaths")), params_(params) {}

void CameraStage::compile(const PhotonStage& photons) {
    shared::CameraParams nothing = params_;
    nothing.camera.width = nothing.camera.height = 0;
    traceCameraPaths_.launch(film_.pixels(), geometry_.nodes, geometry_.blocks, geometry_.tables,
                             photons.index().cellStart(), photons.index().sorted(), film_.sums(), film_.counterBuffer(),
                             nothing);
}

void CameraStage::run(unsigned pass, const PhotonStage& photons) {
    params_.pass = pass;
    params_.map = photons.index().map();
    const Film::Pass onFilm = film_.beginPass(pass);
    params_.batchWeight = onFilm.batchWeight;
    params_.map.biasWeight = onFilm.biasWeight;
    traceCameraPaths_.launch(film_.pixels(), geometry_.nodes, geometry_.blocks, geometry_.tables,
                             photons.index().cellStart(), photons.index().sorted(), film_.sums(), film_.counterBuffer(),
                             params_);
}

} // namespace quasilux

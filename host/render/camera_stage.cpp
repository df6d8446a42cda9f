#include "render/camera_stage.h"

#include <algorithm>

namespace quasilux {

namespace {

// Where somebody waits for rows of the film, so that pictures come twice a second (docs/notes/live-view.md).
constexpr double longestAwaitedSeconds = 0.2;

} // namespace

CameraStage::CameraStage(const Program& pass, const GeometryBuffers& geometry, Film& film, shared::CameraParams params,
                         AdaptiveRadius* radii, SharedSamples* shared)
    : geometry_(geometry), film_(film), radii_(radii), shared_(shared), traceCameraPaths_(pass.kernel(cameraKernel)),
      params_(params) {}

void CameraStage::compile(const PhotonStage& photons) {
    const Buffer<float>* scales = radii_ ? &radii_->scales(0) : nullptr;
    if (shared_)
        shared_->compile(film_, params_, geometry_, tracer(film_, scales, photons));
    else
        tracePart(film_, film_.parts().front(), params_, 0, scales, photons);
    traceCameraPaths_.forgetPace();
    if (radii_) radii_->compile();
}

// Traces the paths of the first `pixels` of a part of the film; of none, so that the runtime compiles the kernel.
void CameraStage::tracePart(Film& film, Film::Part& part, shared::CameraParams params, size_t pixels,
                            const Buffer<float>* radiusScales, const PhotonStage& photons) {
    params.firstPixel = static_cast<unsigned>(part.firstPixel);
    params.pixels = static_cast<unsigned>(pixels);
    launch(part.pixels, part.sums, film, params, radiusScales, photons);
}

SharedSamples::Trace CameraStage::tracer(Film& film, const Buffer<float>* radiusScales, const PhotonStage& photons) {
    return [this, &film, radiusScales, &photons](Buffer<float>& samples, const shared::CameraParams& params) {
        launch(std::max(params.pixels, 1u), samples, film, params, radiusScales, photons);
    };
}

void CameraStage::launch(size_t workItems, Buffer<float>& result, Film& film, const shared::CameraParams& params,
                         const Buffer<float>* radiusScales, const PhotonStage& photons) {
    const auto run = [&](const auto&... more) {
        traceCameraPaths_.launch(workItems, geometry_.nodes, geometry_.blocks, geometry_.tables,
                                 photons.table().cellStart(), photons.sorted(), result, film.counterBuffer(), params,
                                 more...);
    };
    if (radiusScales)
        run(*radiusScales);
    else
        run();
}

void CameraStage::runOn(Film& film, shared::CameraParams params, const Buffer<float>* radiusScales,
                        const PhotonStage& photons) {
    const Film::Pass onFilm = film.beginPass(params.pass);
    params.batchWeight = onFilm.batchWeight;
    params.map.biasWeight = onFilm.biasWeight;
    params.filmLayout = film.layout().bits();
    if (shared_)
        shared_->addPass(film, params, geometry_, tracer(film, radiusScales, photons));
    else
        for (Film::Part& part : film.parts()) {
            traceCameraPaths_.watchParts([&](size_t pixels) { film.noteAhead(part.firstPixel + pixels); },
                                         film.isAwaited() ? longestAwaitedSeconds : longestLaunchSeconds);
            tracePart(film, part, params, part.pixels, radiusScales, photons);
            film.noteAhead(part.firstPixel + part.pixels);
        }
    traceCameraPaths_.watchParts({});
}

const shared::CameraParams& CameraStage::params(unsigned pass, const PhotonStage& photons) {
    params_.pass = pass;
    params_.map = photons.table().map();
    params_.radiusBlock = radii_ ? radii_->block() : 1;
    return params_;
}

void CameraStage::run(unsigned pass, const PhotonStage& photons) {
    runOn(film_, params(pass, photons), radii_ ? &radii_->scales(pass) : nullptr, photons);
}

void CameraStage::runWithoutGathering(const PhotonStage& photons) {
    shared::CameraParams ofOnePath = params(0, photons);
    ofOnePath.cameraPaths = 1;
    ofOnePath.gatheringPaths = 0;
    runOn(film_, ofOnePath, radii_ ? &radii_->scales(0) : nullptr, photons);
}

bool CameraStage::radiusIsDue(unsigned pass) const { return radii_ && radii_->pilotIsDue(pass); }

// With the same photons: passes to come, whose radii this decides, have others.
size_t CameraStage::chooseRadius(unsigned pass, const PhotonStage& photons) {
    shared::CameraParams ofPilot = params(pass, photons);
    ofPilot.camera = radii_->pilotCamera();
    ofPilot.radiusBlock = ofPilot.cameraPaths = 1;
    const size_t paths = radii_->pilotFilm().pixels();
    runOn(radii_->pilotFilm(), ofPilot, &radii_->pilotScales(), photons);
    radii_->endPilotPass();
    return paths;
}

} // namespace quasilux

#include "render/camera_stage.h"

#include "render/coarse_camera.h"

#include <algorithm>

namespace quasilux {

namespace {

// Where somebody waits for rows of the film, so that pictures come twice a second (docs/notes/live-view.md).
constexpr double longestAwaitedSeconds = 0.2;
// Added to the seed: what coarse passes decide must know nothing of the image's camera paths.
constexpr unsigned coarseSeed = 0x7F4A7C15u;
const std::string ofOnePath = "coarse ";

} // namespace

CameraStage::CameraStage(Device& device, const Program& pass, const GeometryBuffers& geometry, Film& film,
                         shared::CameraParams params, unsigned paths, AdaptiveRadius* radii, SharedSamples* shared)
    : geometry_(geometry), film_(film), radii_(radii), shared_(shared), paths_(device, params.camera, paths),
      onePath_(device, params.camera, 1, ofOnePath), traceCameraPaths_(pass.kernel(cameraKernel)), params_(params) {}

BufferSizes CameraStage::plan(const shared::Camera& camera, bool isAdaptive) {
    BufferSizes sizes = PathCounts::plan(camera, isAdaptive);
    sizes.merge(PathCounts::plan(camera, false, ofOnePath));
    return sizes;
}

void CameraStage::compile(const PhotonStage& photons) {
    const PixelTables ofFirst = tables(0);
    params_.pathBlock = paths_.block();
    if (shared_)
        shared_->compile(film_, params_, geometry_, tracer(film_, ofFirst, photons));
    else
        tracePart(film_, film_.parts().front(), params_, 0, ofFirst, photons);
    traceCameraPaths_.forgetPace();
    if (radii_) radii_->compile();
}

// Traces the paths of the first `pixels` of a part of the film; of none, so that the runtime compiles the kernel.
void CameraStage::tracePart(Film& film, Film::Part& part, shared::CameraParams params, size_t pixels,
                            const PixelTables& tables, const PhotonStage& photons) {
    params.firstPixel = static_cast<unsigned>(part.firstPixel);
    params.pixels = static_cast<unsigned>(pixels);
    launch(part.pixels, part.sums, film, params, tables, photons);
}

SharedSamples::Trace CameraStage::tracer(Film& film, const PixelTables& tables, const PhotonStage& photons) {
    return [this, &film, tables, &photons](Buffer<float>& samples, const shared::CameraParams& params) {
        launch(std::max(params.pixels, 1u), samples, film, params, tables, photons);
    };
}

void CameraStage::launch(size_t workItems, Buffer<float>& result, Film& film, const shared::CameraParams& params,
                         const PixelTables& tables, const PhotonStage& photons) {
    const auto run = [&](const auto&... more) {
        traceCameraPaths_.launch(workItems, geometry_.nodes, geometry_.blocks, geometry_.tables,
                                 photons.table().cellStart(), photons.sorted(), result, film.counterBuffer(), params,
                                 tables.paths.counts(), more...);
    };
    if (tables.radiusScales)
        run(*tables.radiusScales);
    else
        run();
}

void CameraStage::runOn(Film& film, const Film::Pass& onFilm, shared::CameraParams params, const PixelTables& tables,
                        const PhotonStage& photons) {
    params.pathBlock = tables.paths.block();
    params.batchWeight = onFilm.batchWeight;
    params.map.biasWeight = onFilm.biasWeight;
    params.filmLayout = onFilm.layout;
    if (shared_)
        shared_->addPass(film, params, geometry_, tracer(film, tables, photons));
    else
        for (Film::Part& part : film.parts()) {
            traceCameraPaths_.watchParts([&](size_t pixels) { film.noteAhead(part.firstPixel + pixels); },
                                         film.isAwaited() ? longestAwaitedSeconds : longestLaunchSeconds);
            tracePart(film, part, params, part.pixels, tables, photons);
            film.noteAhead(part.firstPixel + part.pixels);
        }
    traceCameraPaths_.watchParts({});
}

shared::CameraParams CameraStage::params(unsigned pass, const PhotonStage& photons, PassPart part) const {
    shared::CameraParams params = ofPass(params_, pass, part);
    params.map = photons.table().map();
    params.radiusBlock = radii_ ? radii_->block() : 1;
    params.pathBlock = paths_.block();
    return params;
}

PixelTables CameraStage::tables(unsigned pass) const { return {paths_, radiusScales(pass)}; }

void CameraStage::run(unsigned pass, const PhotonStage& photons, PassPart part) {
    runOn(film_, film_.beginPass(pass, part), params(pass, photons, part), tables(pass), photons);
}

void CameraStage::runWithoutGathering(const PhotonStage& photons) {
    shared::CameraParams ofPath = params(0, photons);
    ofPath.gathers = 0;
    runOn(film_, film_.beginPass(0), ofPath, {onePath_, radiusScales(0)}, photons);
}

void CameraStage::runCoarse(Film& film, const shared::Camera& camera, unsigned pass, Brings brings,
                            const PathCounts& paths, const PhotonStage& photons) {
    shared::CameraParams ofCoarse = params(pass, photons);
    ofCoarse.seedLow += coarseSeed;
    ofCoarse.camera = camera;
    ofCoarse.coarseness = coarseBlock(params_.camera);
    ofCoarse.spread = 1.f / static_cast<float>(ofCoarse.coarseness);
    ofCoarse.radiusBlock = 1;
    if (brings != Brings::allLight) ofCoarse.gathers = 0;
    ofCoarse.countsEvents = brings == Brings::rays;
    runOn(film, film.beginBatch(), ofCoarse, {paths, radiusScales(0)}, photons);
}

bool CameraStage::radiusIsDue(unsigned pass) const { return radii_ && radii_->coarsePassIsDue(pass); }

// With the same photons: passes to come, whose radii this decides, have others.
size_t CameraStage::chooseRadius(unsigned pass, const PhotonStage& photons, PassPart part) {
    shared::CameraParams ofCoarse = params(pass, photons, part);
    ofCoarse.camera = radii_->camera();
    ofCoarse.coarseness = radii_->block();
    ofCoarse.radiusBlock = 1;
    Film& film = radii_->coarseFilm();
    const size_t paths = film.pixels();
    runOn(film, film.beginPass(pass, part), ofCoarse, {onePath_, &radii_->coarseScales()}, photons);
    if (part.isLast()) radii_->endCoarsePass();
    return paths;
}

} // namespace quasilux

#include "render/meter_stage.h"

namespace quasilux {

namespace {

constexpr size_t meterSampleFloats = size_t{3} * FILM_COMPONENTS; // SAMPLE_FLOATS of kernels/camera_paths.cl

// What the paths of all pixels take before it is summed.
PlannedBuffer<float> samplesOf(size_t pixels, unsigned samples) {
    return {"meter samples", meterSampleFloats * pixels * samples};
}

} // namespace

MeterStage::MeterStage(Device& device, const Program& pass, const GeometryBuffers& geometry, Film& film,
                       shared::CameraParams params, unsigned classes, double meanRadiance)
    : geometry_(geometry), film_(film), traceMeterPaths_(pass.kernel("traceMeterPaths")),
      addMeterSamples_(pass.kernel("addMeterSamples")), params_(params),
      counted_(device, classes, film.pixels(), meanRadiance, params.scene.meter.samples),
      samples_(samplesOf(film.pixels(), params.scene.meter.samples).make(device)) {}

BufferSizes MeterStage::plan(size_t pixels, unsigned samples, unsigned classes) {
    return sizesOf(MeterSums::planned(classes, pixels), samplesOf(pixels, samples));
}

void MeterStage::compile(const PhotonStage& photons) {
    shared::CameraParams nothing = params_;
    nothing.camera.width = nothing.camera.height = 0;
    traceMeterPaths_.launch(film_.pixels() * params_.scene.meter.samples, geometry_.nodes, geometry_.blocks,
                            geometry_.tables, photons.table().cellStart(), photons.sorted(), samples_,
                            film_.counterBuffer(), nothing);
    traceMeterPaths_.forgetPace();
    addMeterSamples_.launch(film_.pixels(), samples_, counted_.sums, film_.sums(), film_.counterBuffer(), 0u, 0u, 0.f,
                            counted_.quantaPerRadiance, 0.f, film_.layout().bits());
}

void MeterStage::run(unsigned pass, const PhotonStage& photons, PassPart part) {
    const shared::Meter& meter = params_.scene.meter;
    const Film::Pass onFilm = film_.beginBatch(part);
    shared::CameraParams params = ofPass(params_, pass, part);
    params.map = photons.table().map();
    traceMeterPaths_.launch(film_.pixels() * meter.samples, geometry_.nodes, geometry_.blocks, geometry_.tables,
                            photons.table().cellStart(), photons.sorted(), samples_, film_.counterBuffer(), params);
    addMeterSamples_.launch(film_.pixels(), samples_, counted_.sums, film_.sums(), film_.counterBuffer(),
                            static_cast<unsigned>(film_.pixels()), meter.samples,
                            sampleScale(meter) / static_cast<float>(part.count), counted_.quantaPerRadiance,
                            onFilm.batchWeight, onFilm.layout);
}

} // namespace quasilux

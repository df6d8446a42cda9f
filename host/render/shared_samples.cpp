#include "render/shared_samples.h"

#include <algorithm>

namespace quasilux {

namespace {

// A larger film is traced in bands of rows.
constexpr uint64_t mostBytes = 64u << 20, shareOfAllocation = 8;

struct Grid {
    explicit Grid(const shared::Camera& camera)
        : taps(FILTER_TAPS(&camera)), border(SAMPLE_BORDER(&camera)),
          columns(size_t{camera.width} + 2 * size_t{border}), rows(size_t{camera.height} + 2 * size_t{border}) {}

    unsigned taps, border;
    size_t columns, rows;

    // That are kept at a time: of some pixels' rows, and what their filters reach beside these.
    size_t rowsKept(uint64_t samples) const {
        return std::min(rows, std::max<size_t>(samples / columns, 2 * size_t{taps} + 1));
    }
};

PlannedBuffer<float> samplesOf(const shared::Camera& camera, unsigned floatsPerSample, const DeviceInfo& device) {
    const Grid grid(camera);
    const uint64_t bytes = std::min(mostBytes, device.maximumAllocation / shareOfAllocation);
    return {"samples", grid.columns * grid.rowsKept(bytes / sizeof(float) / floatsPerSample) * floatsPerSample};
}

} // namespace

SharedSamples::SharedSamples(Device& device, const Program& pass, const shared::Camera& camera,
                             unsigned floatsPerSample)
    : floatsPerSample_(floatsPerSample), samples_(samplesOf(camera, floatsPerSample, device.info()).make(device)),
      filterSamples_(pass.kernel("filterSamples")) {}

unsigned SharedSamples::floatsPerSample(const DeviceScene& scene, const RenderSettings& settings) {
    if (!sharesSamples(scene.features, settings)) return 0;
    return 3 * (FILM_COMPONENTS + (estimatesBias(scene.features, settings) ? LIGHT_CLASSES : 0));
}

BufferSizes SharedSamples::plan(const shared::Camera& camera, unsigned floatsPerSample, const DeviceInfo& device) {
    return sizesOf(samplesOf(camera, floatsPerSample, device));
}

void SharedSamples::addPass(Film& film, const shared::CameraParams& params, const GeometryBuffers& geometry,
                            const Trace& trace) {
    const Grid grid(params.camera);
    const size_t height = params.camera.height;
    const size_t kept = grid.rowsKept(samples_.size() / floatsPerSample_);
    const size_t band = kept == grid.rows ? height : kept - 2 * size_t{grid.taps};
    shared::CameraParams part = params;
    part.sampleRows = static_cast<unsigned>(kept);
    size_t traced = 0; // rows of the grid
    for (size_t first = 0; first < height; first += band) {
        const size_t end = std::min(first + band, height);
        const size_t needed = std::min(end + grid.border + grid.taps, grid.rows);
        part.firstPixel = static_cast<unsigned>(traced * grid.columns);
        part.pixels = static_cast<unsigned>((needed - traced) * grid.columns);
        if (part.pixels > 0) trace(samples_, part);
        traced = needed;
        filterRows(film, part, geometry, first, end - first);
        film.noteAhead(end * params.camera.width);
    }
}

void SharedSamples::compile(Film& film, shared::CameraParams params, const GeometryBuffers& geometry,
                            const Trace& trace) {
    params.sampleRows = 1;
    params.firstPixel = params.pixels = 0;
    Film::Part& part = film.parts().front();
    trace(samples_, params);
    filterSamples_.launch(part.pixels, geometry.tables, samples_, part.sums, params, 0u);
    filterSamples_.forgetPace();
}

void SharedSamples::filterRows(Film& film, shared::CameraParams params, const GeometryBuffers& geometry,
                               size_t firstRow, size_t rows) {
    const size_t first = firstRow * params.camera.width, end = first + rows * params.camera.width;
    for (Film::Part& part : film.parts()) {
        const size_t from = std::max(first, part.firstPixel), to = std::min(end, part.firstPixel + part.pixels);
        if (from >= to) continue;
        params.firstPixel = static_cast<unsigned>(part.firstPixel);
        params.pixels = static_cast<unsigned>(to - part.firstPixel);
        filterSamples_.launch(to - from, geometry.tables, samples_, part.sums, params,
                              static_cast<unsigned>(from - part.firstPixel));
    }
}

} // namespace quasilux

// Samples of a pass that pixels share where a reconstruction filter is wider than a pixel (kernels/shared_samples.clh).
#pragma once

#include "device/program.h"
#include "render/film.h"
#include "render/geometry_buffers.h"
#include "render/method.h"

#include <functional>

namespace quasilux {

class SharedSamples {
public:
    /// `floatsPerSample`: 3 for each of the FILM_SAMPLES values that the kernels were compiled with.
    SharedSamples(Device& device, const Program& pass, const shared::Camera& camera, unsigned floatsPerSample);

    /// Does a scene have them, and of how many floats? 0: every pixel has samples of its own.
    static unsigned floatsPerSample(const DeviceScene& scene, const RenderSettings& settings);
    /// Its buffer, by label.
    static BufferSizes plan(const shared::Camera& camera, unsigned floatsPerSample, const DeviceInfo& device);

    /// Traces the samples `firstPixel` and `pixels` of the grid into the buffer.
    using Trace = std::function<void(Buffer<float>& samples, const shared::CameraParams&)>;
    /// Adds a pass to `film`, the image of `params.camera`, which has no more rows or columns than that of the
    /// constructor, band by band.
    void addPass(Film& film, const shared::CameraParams& params, const GeometryBuffers& geometry, const Trace& trace);
    /// Has the runtime compile the kernels, by launches that do nothing.
    void compile(Film& film, shared::CameraParams params, const GeometryBuffers& geometry, const Trace& trace);

private:
    void filterRows(Film& film, shared::CameraParams params, const GeometryBuffers& geometry, size_t firstRow,
                    size_t rows);

    unsigned floatsPerSample_;
    Buffer<float> samples_;
    Kernel filterSamples_;
};

} // namespace quasilux

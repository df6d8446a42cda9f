// --map camera: photons are splatted to a map of camera points (camera_map_stage.h).
#pragma once

#include "render/camera_map_stage.h"
#include "render/pass.h"

namespace quasilux {

class CameraMapPass : public Pass {
public:
    explicit CameraMapPass(const PassContext& context);

    void run(unsigned pass, RenderCounters& counters) override;
    uint64_t cameraPaths() const override { return context_.film.pixels() * context_.flat.offsets.meter.samples; }

private:
    const PassContext& context_;
    CameraMapStage stage_;
};

} // namespace quasilux

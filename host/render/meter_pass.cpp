#include "render/meter_pass.h"

#include "render/method.h"
#include "render/pass_params.h"

namespace quasilux {

MeterPass::MeterPass(const PassContext& context)
    : context_(context), meter_(context.device, context.program, context.geometry, context.film, context.camera,
                                context.classes, meanRadiance(context.flat)),
      photons_(
          context, [&](const PhotonStage& forecast) { meter_.compile(forecast); },
          meterCountsPhotons(context.flat.features, context.settings) ? &meter_.counted() : nullptr) {
    forecast_ = photons_.forecast();
}

void MeterPass::run(unsigned pass, RenderCounters& counters) {
    for (const PassPart& part : photons_.parts()) {
        photons_.trace(pass, part, counters);
        meter_.run(pass, photons_.stage(), part);
    }
}

uint64_t MeterPass::cameraPaths() const {
    return context_.film.pixels() * context_.flat.offsets.meter.samples * photonParts();
}

} // namespace quasilux

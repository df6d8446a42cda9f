#include "auto/pilot.h"

#include <algorithm>

namespace quasilux {

void RendererPilot::renderPass() { renderer_->renderPass(passes()); }

PilotMeasure RendererPilot::measure() const { return measurePilot(image(), hasMedia_, secondsPerPass()); }

// The first pass pays for what the runtime compiles only then.
double RendererPilot::secondsPerPass() const {
    const RenderCounters& counters = renderer_->counters();
    if (counters.passes < 2) return counters.firstPassSeconds;
    return (counters.renderSeconds - counters.firstPassSeconds) / static_cast<double>(counters.passes - 1);
}

double RendererPilot::openingSeconds() const {
    const RenderCounters& counters = renderer_->counters();
    const double late = std::max(0.0, counters.firstPassSeconds - secondsPerPass());
    return counters.prepareSeconds + counters.compileSeconds + late;
}

} // namespace quasilux

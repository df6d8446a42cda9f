// <phase type="tabphase">: values at equal steps of the cosine between the directions of propagation, from -1 to 1.
#include "scene/phases/phase_plugin.h"
#include "scene/xml/numbers.h"

#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace quasilux {

namespace {

constexpr size_t valuesMax = 1 << 16;

std::vector<double> readValues(Properties& properties) {
    std::vector<double> values =
        parseNumbers(properties.string("values", ""), properties.where("values"), "parameter 'values'");
    for (const double value : values)
        if (value < 0)
            throw InputError(properties.where("values"),
                             fmt::format("parameter 'values' of {} has the entry {}; none may be negative.",
                                         properties.describe(), value));
    if (values.size() < 2 || values.size() > valuesMax)
        throw InputError(properties.where("values"),
                         fmt::format("parameter 'values' of {} has {} entries; expected 2 to {}: the phase function at "
                                     "equal steps of the cosine from -1 (back) to 1 (straight on).",
                                     properties.describe(), values.size(), valuesMax));
    return values;
}

} // namespace

void readTabulated(Properties& properties, MediumDescription& medium) {
    PhasePartDescription part;
    part.phase = PHASE_TABULATED;
    part.values = readValues(properties);
    // Exact for what is linear between: integrals over the cosine of p and of cosine times p.
    const double step = 2.0 / static_cast<double>(part.values.size() - 1);
    double sum = 0, moment = 0;
    for (size_t i = 0; i + 1 < part.values.size(); ++i) {
        const double a = part.values[i], b = part.values[i + 1], cosine = -1 + step * static_cast<double>(i);
        sum += 0.5 * step * (a + b);
        moment += step * (0.5 * cosine * (a + b) + step * (a / 6 + b / 3));
    }
    if (!(sum > 0) || !std::isfinite(sum))
        throw InputError(properties.where("values"),
                         fmt::format("parameter 'values' of {} adds up to {}; a phase function scatters somewhere.",
                                     properties.describe(), sum));
    for (double& value : part.values) value /= 2 * std::numbers::pi * sum;
    part.g = medium.g = moment / sum;
    medium.phase = PHASE_MIXED;
    medium.phaseParts = {part};
}

} // namespace quasilux

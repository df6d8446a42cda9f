// <sensor type="batch">: sensors that share one film, beside each other on it. Each of them is rendered as an image of
// its own.
#include "scene/sensors/sensors.h"

#include <fmt/format.h>

namespace quasilux {

namespace {

constexpr std::string_view batchName = "batch";

bool isBatch(const Element& element) { return element.get("type") == batchName; }

} // namespace

std::vector<PlacedSensor> placeSensors(const Element& element, LoadContext& context) {
    if (!isBatch(element)) return {{&element, std::nullopt, std::nullopt}};
    Properties properties(element, context);
    const std::vector<const Element*> nested = properties.objects("sensor");
    if (nested.empty())
        throw InputError(element.where, "sensor 'batch' has no sensors; put <sensor type=\"perspective\"> into it.");
    const Element* film = properties.object("film");
    if (const Element* sampler = properties.object("sampler")) readSampler(*sampler, context);
    properties.accept({"shutter_open", "shutter_close"}); // nothing moves
    refuseResponse(properties);
    properties.finish();
    std::vector<PlacedSensor> placed;
    for (const Element* sensor : nested) {
        if (isBatch(*sensor))
            throw InputError(sensor->where, "a sensor 'batch' within another; put its sensors into the outer one.");
        placed.push_back({sensor, std::nullopt, SharedFilm{film, &element, static_cast<unsigned>(nested.size())}});
    }
    return placed;
}

void takeShareOfFilm(const SharedFilm& shared, LoadContext& context, Sensor& sensor) {
    if (shared.film) readFilm(*shared.film, context, sensor);
    const SourceLocation& where = shared.film ? shared.film->where : shared.batch->where;
    if (sensor.width != sensor.filmWidth || sensor.height != sensor.filmHeight)
        throw InputError(where, "the film of a sensor 'batch' takes no crop window; remove it.");
    if (sensor.filmWidth % shared.sensors != 0)
        throw InputError(where,
                         fmt::format("the film's width is {}, which is no multiple of the {} sensors of the batch.",
                                     sensor.filmWidth, shared.sensors));
    sensor.filmWidth /= shared.sensors;
    sensor.width = sensor.filmWidth;
}

} // namespace quasilux

// <film type="hdrfilm"> and its reconstruction filter.
#include "scene/sensors/sensors.h"

#include <fmt/format.h>

namespace quasilux {

namespace {

constexpr int64_t maximumSize = 32768; // pixels along one side

unsigned readSize(Properties& properties, const std::string& name, unsigned missing) {
    const int64_t size = properties.integer(name, missing);
    if (size < 1 || size > maximumSize)
        throw InputError(properties.where(name),
                         fmt::format("parameter '{}' is {}; expected 1 to {} pixels.", name, size, maximumSize));
    return static_cast<unsigned>(size);
}

void readFilter(const Element& element, LoadContext& context, Sensor& sensor) {
    Properties properties(element, context);
    const std::string& plugin = properties.plugin();
    if (plugin == "box") {
        sensor.filter = FILTER_BOX;
        sensor.filterRadius = 0.5;
    } else if (plugin == "tent") {
        sensor.filter = FILTER_TENT;
        sensor.filterRadius = properties.numberAbove("radius", 1, 0, true);
    } else if (plugin == "gaussian") {
        sensor.filter = FILTER_GAUSSIAN;
        sensor.filterStddev = properties.numberAbove("stddev", 0.5, 0, true);
        sensor.filterRadius = 4 * sensor.filterStddev;
    } else {
        throw InputError(element.where, fmt::format("unknown rfilter plugin '{}'.{}", plugin,
                                                    knownNames(plugin, {"box", "tent", "gaussian"})));
    }
    constexpr double maximumRadius = 16;
    if (sensor.filterRadius > maximumRadius)
        throw InputError(element.where, fmt::format("the filter reaches {} pixels; at most {} are supported.",
                                                    sensor.filterRadius, maximumRadius));
    properties.finish();
}

} // namespace

void readFilm(const Element& element, LoadContext& context, Sensor& sensor) {
    if (element.get("type") != "hdrfilm")
        throw InputError(element.where, fmt::format("unknown film plugin '{}'.{}", element.get("type"),
                                                    knownNames(element.get("type"), {"hdrfilm"})));
    Properties properties(element, context);
    sensor.width = readSize(properties, "width", sensor.width);
    sensor.height = readSize(properties, "height", sensor.height);
    if (const Element* filter = properties.object("rfilter")) readFilter(*filter, context, sensor);
    for (const char* name : {"crop_offset_x", "crop_offset_y", "crop_width", "crop_height"})
        properties.refuse(name, "the whole image is rendered; remove the crop");
    properties.accept({"file_format", "pixel_format", "component_format", "banner", "high_quality_edges",
                       "sample_border", "compensate"});
    properties.finish();
}

} // namespace quasilux

// <film type="hdrfilm">: size, crop window, what the image holds.
#include "scene/plugin_lookup.h"
#include "scene/sensors/sensors.h"

#include <algorithm>
#include <fmt/format.h>

namespace quasilux {

namespace {

constexpr std::string_view ldrName = "ldrfilm"; // of Mitsuba 0.x
constexpr int64_t maximumSize = 32768;          // pixels along one side

unsigned readSize(Properties& properties, const std::string& name, unsigned missing) {
    const int64_t size = properties.integer(name, missing);
    if (size < 1 || size > maximumSize)
        throw InputError(properties.where(name),
                         fmt::format("parameter '{}' is {}; expected 1 to {} pixels.", name, size, maximumSize));
    return static_cast<unsigned>(size);
}

/// Pixels of the film along one axis: where the image begins, and how many it has.
struct CropRange {
    unsigned begin, count;
};

CropRange readCrop(Properties& properties, const std::string& axis, const std::string& size, unsigned all) {
    const std::string offsetName = "crop_offset_" + axis, sizeName = "crop_" + size;
    const int64_t begin = properties.integer(offsetName, 0), count = properties.integer(sizeName, all);
    if (begin >= 0 && count >= 1 && begin <= all && count <= all - begin)
        return {static_cast<unsigned>(begin), static_cast<unsigned>(count)};
    throw InputError(properties.where(properties.has(sizeName) ? sizeName : offsetName),
                     fmt::format("the crop window takes pixels {} to {} of a film whose {} is {}; give {} and {} such "
                                 "that it lies within.",
                                 begin, begin + count - 1, size, all, offsetName, sizeName));
}

PixelFormat readPixelFormat(Properties& properties) {
    const std::string name = properties.choiceOfAnyCase("pixel_format", "rgb",
                                                        {"luminance", "luminance_alpha", "rgb", "rgba", "xyz", "xyza"});
    PixelFormat format;
    format.luminance = name == "luminance" || name == "luminance_alpha";
    format.xyz = name == "xyz" || name == "xyza";
    format.alpha = name == "luminance_alpha" || name == "rgba" || name == "xyza";
    return format;
}

void readFileFormats(Properties& properties, LoadContext& context) {
    const bool isToneMapped = properties.plugin() == ldrName;
    const Names known = isToneMapped ? Names{"png", "jpeg"} : Names{"openexr", "exr", "rgbe", "pfm"};
    const std::string file = properties.choiceOfAnyCase("file_format", std::string(known.front()), known);
    if (isToneMapped)
        context.warn(properties.element().where, "film 'ldrfilm' of Mitsuba 0.x: the image is an OpenEXR file that is "
                                                 "not tone mapped; 'quasilux render --png' makes a picture of it.");
    else if (file == "rgbe" || file == "pfm")
        context.warn(properties.where("file_format"),
                     fmt::format("file_format '{}': images are written as OpenEXR.", file));
    properties.choiceOfAnyCase("component_format", "float16", {"float16", "float32", "uint32"});
    properties.accept({"component_format"});
}

} // namespace

Names filmPluginNames() { return {"hdrfilm", "specfilm"}; }

void readFilm(const Element& element, LoadContext& context, Sensor& sensor) {
    if (element.get("type") == "specfilm")
        throw InputError(element.where, "film 'specfilm' records spectral bands, and light is linear RGB here; use "
                                        "<film type=\"hdrfilm\">.");
    if (element.get("type") != "hdrfilm" && element.get("type") != ldrName) throwUnknownPlugin(element, {"hdrfilm"});
    Properties properties(element, context);
    sensor.filmWidth = readSize(properties, "width", sensor.filmWidth);
    sensor.filmHeight = readSize(properties, "height", sensor.filmHeight);
    const CropRange columns = readCrop(properties, "x", "width", sensor.filmWidth),
                    rows = readCrop(properties, "y", "height", sensor.filmHeight);
    sensor.cropX = columns.begin;
    sensor.cropY = rows.begin;
    sensor.width = columns.count;
    sensor.height = rows.count;
    readFilter(properties.object("rfilter"), context, sensor);
    sensor.filterEnds = !properties.boolean("sample_border", true);
    sensor.pixelFormat = readPixelFormat(properties);
    readFileFormats(properties, context);
    properties.accept({"banner", "high_quality_edges", "compensate", "attach_log"});
    if (properties.plugin() == ldrName) properties.accept({"gamma", "exposure", "key", "burn", "tonemap_method"});
    properties.finish();
}

} // namespace quasilux

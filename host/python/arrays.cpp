#include "python/arrays.h"

#include "output/meter_reading.h"
#include "util/error.h"

#include <algorithm>
#include <fmt/format.h>

namespace quasilux {

namespace py = pybind11;

namespace {

// "nn.X", "nn.Y", "nn.Z" are layer "nn", or, where another one has that name, "nn.XYZ".
std::string layerName(const std::vector<std::string>& channels, const py::dict& others) {
    const size_t dot = channels.front().rfind('.');
    std::string name = channels.front().substr(0, dot);
    if (!others.contains(name)) return name;
    name += '.';
    for (const std::string& channel : channels) name += channel.substr(dot + 1);
    return name;
}

/// (name or None, values, standard errors, points or None) of some pixels.
py::tuple readingArrays(const Rendered& rendered, size_t first, unsigned width, unsigned height,
                        const IlluminanceGrid* grid) {
    const std::vector<size_t> shape{height, width};
    const bool isErrorKnown = rendered.image.isErrorKnown();
    py::array_t<double> values(shape), errors(shape);
    for (unsigned y = 0; y < height; ++y)
        for (unsigned x = 0; x < width; ++x) {
            const MeterReading reading =
                readingOf(rendered.image, first + size_t{y} * width + x, rendered.record.settings.photometric);
            values.mutable_at(y, x) = reading.photometricValue;
            errors.mutable_at(y, x) =
                isErrorKnown ? reading.photometricStandardError : std::numeric_limits<double>::infinity();
        }
    if (!grid) return py::make_tuple(py::none(), values, errors, py::none());
    py::array_t<double> points({size_t{height}, size_t{width}, size_t{3}});
    for (unsigned y = 0; y < height; ++y)
        for (unsigned x = 0; x < width; ++x)
            for (int axis = 0; axis < 3; ++axis) points.mutable_at(y, x, axis) = grid->point(x, y)[axis];
    return py::make_tuple(grid->name, values, errors, points);
}

} // namespace

py::object imageArray(const RenderedPointer& owner, const std::vector<float>& values, size_t channels) {
    if (values.empty()) return py::none();
    const auto* kept = new RenderedPointer(owner);
    const py::capsule keeper(kept, [](void* pointer) { delete static_cast<RenderedPointer*>(pointer); });
    py::array_t<float> array({size_t{owner->image.height}, size_t{owner->image.width}, channels}, values.data(),
                             keeper);
    array.attr("setflags")(py::arg("write") = false); // other users of the render see the same memory
    return array;
}

py::dict componentArrays(const RenderedPointer& owner) {
    py::dict arrays;
    for (unsigned k = 0; k < FILM_COMPONENTS; ++k)
        if (const auto& values = owner->image.components[k].radiance; !values.empty())
            arrays[py::str(componentName(k))] = imageArray(owner, values);
    return arrays;
}

py::dict layerArrays(const RenderedPointer& owner) {
    py::dict arrays = componentArrays(owner);
    const auto add = [&](const std::string& name, const std::vector<float>& values, size_t channels) {
        if (!values.empty()) arrays[py::str(name)] = imageArray(owner, values, channels);
    };
    const FilmImage& image = owner->image;
    if (image.isErrorKnown()) add("stderr", image.standardError, 3);
    add("bias", image.bias, 3);
    add("bias_stderr", image.biasError, 3);
    for (const AovImage& layer : owner->layers)
        add(layerName(layer.channels, arrays), layer.values, layer.channels.size());
    return arrays;
}

py::list readingsOf(const Rendered& rendered) {
    const FilmImage& image = rendered.image;
    const std::vector<IlluminanceGrid>& grids = rendered.record.grids;
    const std::vector<PixelRange> ranges = rangesOf(grids);
    py::list readings;
    if (grids.empty()) readings.append(readingArrays(rendered, 0, image.width, image.height, nullptr));
    for (size_t k = 0; k < grids.size(); ++k)
        readings.append(readingArrays(rendered, ranges[k].first, grids[k].nx, grids[k].ny, &grids[k]));
    return readings;
}

RadianceImage radianceOf(const py::array_t<float, py::array::c_style | py::array::forcecast>& array,
                         const std::string& name) {
    const bool isGrey = array.ndim() == 2;
    if (!isGrey && (array.ndim() != 3 || array.shape(2) != 3))
        throw InputError(fmt::format("{}: expected an array of shape (height, width, 3) or (height, width)", name));
    RadianceImage image;
    image.path = name;
    image.height = static_cast<unsigned>(array.shape(0));
    image.width = static_cast<unsigned>(array.shape(1));
    if (image.pixels() == 0) throw InputError(fmt::format("{}: the array has no pixels", name));
    image.radiance.resize(3 * image.pixels());
    for (size_t i = 0; i < image.radiance.size(); ++i) image.radiance[i] = array.data()[isGrey ? i / 3 : i];
    return image;
}

RadianceImage radianceOf(const Rendered& rendered, const std::string& name) {
    RadianceImage image;
    image.path = name;
    image.width = rendered.image.width;
    image.height = rendered.image.height;
    image.radiance = rendered.image.radiance;
    if (rendered.image.isErrorKnown()) image.standardError = rendered.image.standardError;
    dropUnusableErrors(image);
    return image;
}

} // namespace quasilux

// The module quasilux._core, which python/quasilux wraps for users: names and types are documented there, in _core.pyi.
#include "compare/comparison_json.h"
#include "output/atomic_file.h"
#include "output/grid_csv.h"
#include "output/png.h"
#include "output/statistics.h"
#include "python/arrays.h"
#include "python/scene_tree.h"
#include "render/pass_params.h"
#include "render/scene_report.h"
#include "scene/loader.h"
#include "scene/plugin_kinds.h"
#include "scene/transform.h"
#include "scene/xml/tags.h"
#include "util/error.h"
#include "util/file_ending.h"
#include "util/stopwatch.h"

#include <pybind11/stl.h>

namespace py = pybind11;

namespace quasilux {

namespace {

using Definitions = std::vector<std::pair<std::string, std::string>>;

std::string textOf(const nlohmann::json& json) {
    return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

template <typename Load>
LoadedScene timed(const Load& load) {
    const Stopwatch watch;
    auto scene = std::make_shared<const Scene>(load());
    return {std::move(scene), watch.seconds()};
}

LoadChoice choiceOf(const std::string& sensor, bool lenient) {
    return {sensor, lenient ? Unknown::forgiven : Unknown::refused};
}

LoadedScene loadFile(const std::string& path, const Definitions& parameters, const std::string& sensor, bool lenient) {
    const py::gil_scoped_release release;
    return timed([&] { return loadScene(path, parameters, choiceOf(sensor, lenient)); });
}

LoadedScene loadTree(const py::handle& root, const std::string& folder, const std::string& sensor, bool lenient) {
    const SceneDocument document = documentOf(root, folder);
    const py::gil_scoped_release release;
    return timed([&] { return loadScene(document, "scene", choiceOf(sensor, lenient)); });
}

py::tuple render(const LoadedScene& scene, const std::vector<std::string>& arguments, py::object callback,
                 bool measuresGrids) {
    RenderWatch watch(std::move(callback));
    RenderedPointer rendered;
    try {
        const py::gil_scoped_release release;
        rendered = renderScene(scene, arguments, measuresGrids, watch);
    } catch (const std::exception&) {
        if (watch.raised().is_none()) throw;
    }
    return py::make_tuple(rendered ? py::cast(std::const_pointer_cast<Rendered>(rendered)) : py::none(),
                          watch.raised());
}

void save(const Rendered& rendered, const std::string& path, std::optional<double> stops, std::optional<double> scale) {
    const py::gil_scoped_release release;
    const std::string extension = fileEnding(path);
    if (extension == ".exr") {
        checkOutputPath(path, "save", extension);
        writeExr(path, rendered.image, rendered.record, rendered.layers);
    } else if (extension == ".png") {
        checkOutputPath(path, "save", extension);
        writePng(path, rendered.image, chooseToneCurve(rendered.image, {stops, scale}), rendered.record);
    } else if (extension == ".json") {
        checkOutputPath(path, "save", extension);
        writeJson(path, statisticsJson(rendered.record, rendered.image));
    } else if (extension == ".csv") {
        if (rendered.record.grids.empty())
            throw InputError("save " + path + ": a table is of a grid, and none was measured");
        checkOutputPath(path, "save", extension);
        writeGridCsv(path, rendered.image, rendered.record);
    } else {
        throw InputError("save " + path + ": expected a name that ends in .exr, .png, .json or, of a grid, .csv");
    }
}

std::string devicesJson() {
    const py::gil_scoped_release release;
    const DelayedSignals delayed;
    nlohmann::json rows = nlohmann::json::array();
    for (const DeviceInfo& device : listDevices()) {
        rows.push_back(deviceJson(device));
        rows.back()["number"] = rows.size() - 1;
    }
    return textOf(rows);
}

RadianceImage imageOf(const py::handle& given, const std::string& name) {
    if (py::isinstance<py::str>(given)) {
        const auto path = py::cast<std::string>(given);
        const py::gil_scoped_release release;
        return readRadiance(path);
    }
    if (py::isinstance<Rendered>(given)) return radianceOf(py::cast<const Rendered&>(given), name);
    return radianceOf(py::cast<py::array_t<float, py::array::c_style | py::array::forcecast>>(given), name);
}

py::tuple compare(const py::handle& first, const py::handle& second, const std::string& mask,
                  const std::vector<std::pair<std::string, std::vector<std::string>>>& groups,
                  const std::map<std::string, double>& referenceNoise, bool netOfImageNoise, size_t maximumNonFinite,
                  size_t worstPixels) {
    const RadianceImage image = imageOf(first, "image"), reference = imageOf(second, "reference");
    const py::gil_scoped_release release;
    requireEqualSizes(image, reference);
    std::vector<RegionGroup> named;
    named.reserve(groups.size());
    for (const auto& [name, values] : groups) {
        if (name == "all") throw InputError("regions: 'all' means the whole picture, expected another name");
        named.push_back({name, values});
    }
    CompareSettings settings;
    settings.referenceNoise = referenceNoise;
    settings.netOfImageNoise = netOfImageNoise;
    settings.maximumNonFinite = maximumNonFinite;
    settings.worstPixels = worstPixels;
    if (netOfImageNoise && image.standardError.empty())
        throw InputError("net_of_image_noise: " + image.path + " has no usable standard errors");
    const auto regions = chooseRegions(mask, named, image.width, image.height);
    for (const auto& [region, noise] : referenceNoise) checkReferenceNoise("reference_noise", region, noise, regions);
    const std::string text = textOf(comparisonJson(compareImages(image, reference, regions, settings)));
    std::vector<std::string> warnings;
    for (const auto* one : {&image, &reference})
        if (!one->warning.empty()) warnings.push_back(one->warning);
    const py::gil_scoped_acquire acquire;
    return py::make_tuple(text, warnings);
}

SceneChecksums checksums(const LoadedScene& scene) {
    const py::gil_scoped_release release;
    return checksumsOf(flattenFor(*scene.scene, RenderSettings{}), scene.scene->maxDepth);
}

// Rows, as they are written on paper.
std::vector<std::vector<double>> matrixOf(const py::handle& node) {
    Element element = elementOf(node);
    for (const Element& operation : element.children) checkElement(operation, &element);
    const glm::dmat4 matrix = parseTransform(element);
    std::vector<std::vector<double>> rows(4, std::vector<double>(4));
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 4; ++column)
            rows[static_cast<size_t>(row)][static_cast<size_t>(column)] = matrix[column][row];
    return rows;
}

void defineErrors(py::module_& module) {
    py::register_exception<InputError>(module, "InputError", PyExc_ValueError).attr("__module__") = "quasilux";
    py::register_exception<DeviceError>(module, "DeviceError", PyExc_RuntimeError).attr("__module__") = "quasilux";
}

void defineScene(py::module_& module) {
    py::class_<LoadedScene>(
        module, "Scene",
        "A scene that load() has read, for render() and meter(). Parameters and what is in it do not change any more.")
        .def_property_readonly("path", [](const LoadedScene& self) { return self.scene->path; })
        .def_property_readonly("width", [](const LoadedScene& self) { return self.scene->sensor.width; })
        .def_property_readonly("height", [](const LoadedScene& self) { return self.scene->sensor.height; })
        .def_property_readonly("sensor_count", [](const LoadedScene& self) { return self.scene->sensorCount; })
        .def_property_readonly("is_meter",
                               [](const LoadedScene& self) { return self.scene->sensor.meter != MeterKind::none; })
        .def_property_readonly("has_grid", [](const LoadedScene& self) { return !self.scene->grids.empty(); })
        .def_property_readonly("warnings", [](const LoadedScene& self) { return self.scene->warnings; });
    module.def("load_file", loadFile);
    module.def("load_tree", loadTree);
    module.def("checksums", checksums);
    module.def("transform", matrixOf);
    module.def("tag_of_plugin", [](const std::string& plugin) { return std::string(tagOfPlugin(plugin)); });
    module.def("known_plugins", [](const std::string& plugin) { return knownNames(plugin, pluginNames()); });
    module.attr("MAXIMUM_NESTING") = maximumNesting;
}

void defineRender(py::module_& module) {
    const auto orNone = [](double value) { return value < 0 ? std::nullopt : std::optional(value); };
    py::class_<Progress>(
        module, "Progress",
        "How far a render has come, for its callback: times in seconds, error as an estimated ratio to the image.")
        .def_readonly("phase", &Progress::phase)
        .def_readonly("passes", &Progress::passes)
        .def_readonly("seconds", &Progress::seconds)
        .def_property_readonly("seconds_left", [=](const Progress& self) { return orNone(self.secondsLeft); })
        .def_property_readonly("error", [=](const Progress& self) { return orNone(self.relativeError); });
    using Shared = std::shared_ptr<Rendered>; // pybind11 has no holders of what is const
    py::class_<Rendered, Shared>(module, "Rendered")
        .def_property_readonly("image", [](const Shared& self) { return imageArray(self, self->image.radiance); })
        .def_property_readonly("components", [](const Shared& self) { return componentArrays(self); })
        .def_property_readonly("layers", [](const Shared& self) { return layerArrays(self); })
        .def_property_readonly("readings", [](const Rendered& self) { return readingsOf(self); })
        .def_property_readonly("passes", [](const Rendered& self) { return self.image.passes; })
        .def_property_readonly("failure", [](const Rendered& self) { return self.record.failure; })
        .def_property_readonly("warnings", [](const Rendered& self) { return self.warnings; })
        .def("record", [](const Rendered& self) { return textOf(statisticsJson(self.record, self.image)); })
        .def("save", save);
    module.def("render", render);
}

} // namespace

PYBIND11_MODULE(_core, module) {
    module.doc() = "Compiled part of quasilux; use the package.";
    module.attr("__version__") = QUASILUX_VERSION;
    defineErrors(module);
    defineScene(module);
    defineRender(module);
    module.def("devices", devicesJson);
    module.def("compare", compare);
}

} // namespace quasilux

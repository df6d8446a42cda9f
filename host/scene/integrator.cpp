// <integrator>: what light it leaves out. Which method computes the rest is quasilux' own affair.
#include "scene/integrator.h"

#include "scene/properties.h"

#include <algorithm>
#include <fmt/format.h>

namespace quasilux {

namespace {

constexpr int64_t largestDepth = 1000000;

/// Of integrators that take samples; none of them changes the image.
const Names sampling = {"timeout", "block_size", "samples_per_pass"};

int readDepthParameter(Properties& properties) {
    const int64_t depth = properties.integer("max_depth", -1);
    if (depth < -1 || depth > largestDepth)
        throw InputError(
            properties.where("max_depth"),
            fmt::format("parameter 'max_depth' is {}; expected -1 (no limit), or 0 to {} (0: nothing, 1: emitters seen "
                        "directly, 2: and direct light).",
                        depth, largestDepth));
    return static_cast<int>(depth);
}

int readPath(Properties& properties) {
    properties.accept(sampling);
    properties.accept({"rr_depth", "hide_emitters"});
    if (properties.plugin() == "volpathmis") properties.accept({"use_spectral_mis"});
    return readDepthParameter(properties);
}

/// Light of one scattering, and of emitters seen directly.
int readDirect(Properties& properties) {
    properties.accept(sampling);
    properties.accept({"shading_samples", "emitter_samples", "bsdf_samples", "hide_emitters"});
    return 2;
}

constexpr std::string_view quantityNames[] = {"albedo", "depth", "position", "uv",     "geo_normal", "sh_normal",
                                              "dp_du",  "dp_dv", "duv_dx",   "duv_dy", "prim_index", "shape_index"};

AovQuantity quantityOf(const std::string& name, const SourceLocation& where) {
    const auto found = std::find(std::begin(quantityNames), std::end(quantityNames), name);
    if (found == std::end(quantityNames))
        throw InputError(where,
                         fmt::format("parameter 'aovs': unknown quantity '{}'.{}", name,
                                     knownNames(name, Names(std::begin(quantityNames), std::end(quantityNames)))));
    if (name == "uv" || name.starts_with("dp_") || name.starts_with("duv_"))
        throw InputError(where,
                         fmt::format("parameter 'aovs': '{}' goes by texture coordinates, which are not among the "
                                     "layers; remove it.",
                                     name));
    return static_cast<AovQuantity>(found - std::begin(quantityNames));
}

std::string trimmed(const std::string& text) {
    const size_t first = text.find_first_not_of(" \t\n"), last = text.find_last_not_of(" \t\n");
    return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

/// "dd.y:depth,nn:sh_normal".
std::vector<AovLayer> readLayers(Properties& properties) {
    const std::string text = properties.string("aovs", "");
    const SourceLocation where = properties.where("aovs");
    std::vector<AovLayer> layers;
    for (size_t first = 0; first < text.size();) {
        const size_t end = std::min(text.find(',', first), text.size());
        const std::string item = trimmed(text.substr(first, end - first));
        const size_t colon = item.find(':');
        if (colon == std::string::npos || colon == 0)
            throw InputError(where,
                             fmt::format("parameter 'aovs': '{}' is no NAME:QUANTITY, such as nn:sh_normal.", item));
        layers.push_back({item.substr(0, colon), quantityOf(item.substr(colon + 1), where)});
        first = end + 1;
    }
    return layers;
}

/// The integrator whose image they have beside layers of their own.
int readNested(Properties& properties) {
    properties.accept(sampling);
    properties.accept({"hide_emitters"});
    const std::string& plugin = properties.plugin();
    if (plugin == "moment")
        properties.context().warn(
            properties.element().where,
            "integrator 'moment': every image has its standard error in layers stderr.R, stderr.G "
            "and stderr.B; layers of second moments are not written.");
    if (plugin == "aov") properties.context().scene.aovs = readLayers(properties);
    const Element* nested = properties.object("integrator");
    return nested ? readMaxDepth(*nested, properties.context()) : -1;
}

/// Of Mitsuba 0.x, for all light.
int readFormer(Properties& properties) {
    const int depth = readDepthParameter(properties);
    properties.acceptAll();
    return depth;
}

struct IntegratorPlugin {
    std::string_view name;
    int (*read)(Properties&);
};
constexpr IntegratorPlugin integratorPlugins[] = {
    {"path", readPath},   {"volpath", readPath},  {"volpathmis", readPath},     {"direct", readDirect},
    {"aov", readNested},  {"moment", readNested}, {"photonmapper", readFormer}, {"sppm", readFormer},
    {"ppm", readFormer},  {"bdpt", readFormer},   {"mlt", readFormer},          {"pssmlt", readFormer},
    {"erpt", readFormer},
};

struct RefusedIntegrator {
    std::string_view name, why;
};
constexpr std::string_view derivatives = "it is there for derivatives; use 'path', or 'volpath' where there are media";
constexpr RefusedIntegrator refusedIntegrators[] = {
    {"ptracer", "use 'path', or 'volpath' where there are media: photons are traced for either"},
    {"depth", "it draws distances, not light; use 'path'"},
    {"emission", "use 'path' with max_depth 1"},
    {"stokes", "light has no polarisation here; use the integrator within it"},
    {"prb", derivatives},
    {"prb_basic", derivatives},
    {"prb_projective", derivatives},
    {"prbvolpath", derivatives},
    {"direct_projective", "it is there for derivatives; use 'direct'"},
    {"volprim_rf_basic", "radiance fields are not supported; use shapes"},
};

const IntegratorPlugin& findIntegrator(const Element& element) {
    const std::string& name = element.get("type");
    for (const RefusedIntegrator& refused : refusedIntegrators)
        if (refused.name == name)
            throw InputError(element.where, fmt::format("integrator '{}' is not supported: {}.", name, refused.why));
    Names known;
    for (const IntegratorPlugin& plugin : integratorPlugins) {
        if (plugin.name == name) return plugin;
        known.push_back(plugin.name);
    }
    throw InputError(element.where, fmt::format("unknown integrator plugin '{}'.{}", name, knownNames(name, known)));
}

} // namespace

int readMaxDepth(const Element& element, LoadContext& context) {
    const IntegratorPlugin& plugin = findIntegrator(element);
    Properties properties(element, context);
    const int depth = plugin.read(properties);
    properties.finish();
    return depth;
}

bool readHideEmitters(const Element& element, LoadContext& context) {
    Properties properties(element, context);
    bool inherited = false;
    const Element* nested = properties.object("integrator");
    for (const Element& child : element.children)
        if (&child == nested) inherited = readHideEmitters(child, context);
    return properties.boolean("hide_emitters", inherited);
}

} // namespace quasilux

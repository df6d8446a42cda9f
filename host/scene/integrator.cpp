// <integrator>: what light it leaves out. Which method computes the rest is quasilux' own affair.
#include "scene/integrator.h"

#include "scene/plugin_lookup.h"
#include "scene/properties.h"

#include <algorithm>
#include <fmt/format.h>
#include <limits>

namespace quasilux {

namespace {

constexpr int64_t largestDepth = 1000000;

/// Of integrators that take samples; none of them changes the image.
const Names sampling = {"timeout", "block_size", "samples_per_pass"};

int readDepthParameter(Properties& properties, int missing = -1) {
    const int64_t depth = properties.integer("max_depth", missing);
    if (depth < -1 || depth > largestDepth)
        throw InputError(
            properties.where("max_depth"),
            fmt::format("parameter 'max_depth' is {}; expected -1 (no limit), or 0 to {} (0: nothing, 1: emitters seen "
                        "directly, 2: and direct light).",
                        depth, largestDepth));
    return static_cast<int>(depth);
}

IntegratorChoice readPath(Properties& properties) {
    properties.accept(sampling);
    properties.accept({"rr_depth", "strict_normals"}); // the latter of Mitsuba 0.x
    if (properties.plugin() == "volpathmis") properties.accept({"use_spectral_mis"});
    const bool ofVolumes = properties.plugin() != "path";
    return {readDepthParameter(properties), properties.boolean("hide_emitters", false), !ofVolumes};
}

/// Of integrators for derivatives, Mitsuba's default.
constexpr int depthForDerivatives = 6;
const Names ofSilhouettes = {"sppc", "sppp", "sppi", "guiding", "guiding_proj", "guiding_rounds", "project_seed"};
/// Of those that Mitsuba had up to 3.4.
const Names ofReparameterization = {"reparam_max_depth", "reparam_rays",       "reparam_kappa",
                                    "reparam_exp",       "reparam_antithetic", "reparam_unroll"};

IntegratorChoice readForDerivatives(Properties& properties) {
    properties.accept(sampling);
    properties.accept({"rr_depth"});
    if (properties.plugin() == "prb_projective") properties.accept(ofSilhouettes);
    if (properties.plugin() == "prb_reparam") properties.accept(ofReparameterization);
    return {readDepthParameter(properties, depthForDerivatives), properties.boolean("hide_emitters", false),
            properties.plugin() != "prbvolpath"};
}

/// How many samples are taken is chosen here, but a way of sampling that Mitsuba has none of leaves out light.
void checkSamples(Properties& properties) {
    constexpr int most = std::numeric_limits<int>::max();
    const int both = properties.integerWithin("shading_samples", 1, 0, most);
    const int ofEmitters = properties.integerWithin("emitter_samples", both, 0, most);
    const int ofBsdfs = properties.integerWithin("bsdf_samples", both, 0, most);
    const auto warn = [&](const char* name, const char* lost) {
        properties.context().warn(properties.where(name),
                                  fmt::format("integrator 'direct' without {}: Mitsuba's image lacks {}; here it is "
                                              "there.",
                                              name, lost));
    };
    if (ofEmitters == 0 && ofBsdfs == 0)
        properties.context().refuseUnknown(properties.element().where,
                                           "integrator 'direct' has neither emitter_samples nor bsdf_samples; give one "
                                           "of them, or none.",
                                           "taken as if both were 1");
    else if (ofEmitters == 0)
        warn("emitter_samples", "the light of points and parallel light");
    else if (ofBsdfs == 0)
        warn("bsdf_samples", "what smooth mirrors and glass show");
    properties.accept({"shading_samples", "emitter_samples", "bsdf_samples"});
}

/// Light of one scattering, and of emitters seen directly.
IntegratorChoice readDirect(Properties& properties) {
    properties.accept(sampling);
    if (properties.plugin() == "direct") {
        checkSamples(properties);
    } else {
        properties.accept(properties.plugin() == "direct_reparam" ? ofReparameterization : ofSilhouettes);
        properties.accept({"max_depth", "rr_depth"}); // read by Mitsuba, and replaced by 2
    }
    return {2, properties.boolean("hide_emitters", false), true, false};
}

constexpr std::string_view quantityNames[] = {"albedo", "depth", "position", "uv",     "geo_normal", "sh_normal",
                                              "dp_du",  "dp_dv", "duv_dx",   "duv_dy", "prim_index", "shape_index"};

AovQuantity quantityOf(const std::string& name, const SourceLocation& where) {
    const auto found = std::find(std::begin(quantityNames), std::end(quantityNames), name);
    if (found == std::end(quantityNames))
        throw InputError(where,
                         fmt::format("parameter 'aovs': unknown quantity '{}'.{}", name,
                                     knownNames(name, Names(std::begin(quantityNames), std::end(quantityNames)))));
    return static_cast<AovQuantity>(found - std::begin(quantityNames));
}

std::string trimmed(const std::string& text) {
    const size_t first = text.find_first_not_of(" \t\n"), last = text.find_last_not_of(" \t\n");
    return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

constexpr std::string_view colorChannels = "RGB";
/// What an image has beside the sum: its light by component (componentName), and errors.
constexpr std::string_view layersOfImage[] = {"direct",   "caustic", "quasi_caustic", "diffuse",
                                              "emission", "stderr",  "bias",          "bias_stderr"};

/// Where its channels have names that others of the image have, too.
void refuseTakenName(const std::vector<AovLayer>& layers, const SourceLocation& where) {
    const std::string& name = layers.back().name;
    const std::string_view letters = aovChannels(layers.back().quantity);
    const auto count = std::count_if(layers.begin(), layers.end(), [&](const AovLayer& other) {
        return other.name == name && aovChannels(other.quantity).find_first_of(letters) != std::string_view::npos;
    });
    if (count > 1)
        throw InputError(where,
                         fmt::format("parameter 'aovs': two layers have channels '{}.{}'; give each a name of its "
                                     "own.",
                                     name, letters.front()));
    const std::string_view* taken = std::find(std::begin(layersOfImage), std::end(layersOfImage), name);
    if (letters == colorChannels && taken != std::end(layersOfImage))
        throw InputError(
            where, fmt::format("parameter 'aovs': the image has a layer '{}' itself; choose another name.", name));
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
        refuseTakenName(layers, where);
        first = end + 1;
    }
    return layers;
}

/// The integrator whose image they have beside layers of their own.
IntegratorChoice readNested(Properties& properties) {
    properties.accept(sampling);
    const std::string& plugin = properties.plugin();
    if (plugin == "moment")
        properties.context().warn(
            properties.element().where,
            "integrator 'moment': every image has its standard error in layers stderr.R, stderr.G "
            "and stderr.B; layers of second moments are not written.");
    if (plugin == "aov") properties.context().scene.aovs = readLayers(properties);
    const Element* nested = properties.object("integrator");
    properties.accept({"hide_emitters"}); // in Mitsuba the nested one goes by its own
    return nested ? readIntegrator(*nested, properties.context()) : IntegratorChoice{};
}

/// Of Mitsuba 0.x and 2, for all light.
IntegratorChoice readFormer(Properties& properties) {
    const IntegratorChoice choice{readDepthParameter(properties), properties.boolean("hide_emitters", false)};
    properties.acceptAll();
    return choice;
}

/// Of Mitsuba 0.x, about the one whose image they compute.
IntegratorChoice readFormerAround(Properties& properties) {
    const Element* nested = properties.object("integrator");
    properties.acceptAll();
    return nested ? readIntegrator(*nested, properties.context()) : IntegratorChoice{};
}

struct IntegratorPlugin {
    std::string_view name;
    IntegratorChoice (*read)(Properties&);
};
constexpr IntegratorPlugin integratorPlugins[] = {
    {"path", readPath},
    {"volpath", readPath},
    {"volpathmis", readPath},
    {"direct", readDirect},
    {"aov", readNested},
    {"moment", readNested},
    {"photonmapper", readFormer},
    {"sppm", readFormer},
    {"ppm", readFormer},
    {"bdpt", readFormer},
    {"mlt", readFormer},
    {"pssmlt", readFormer},
    {"erpt", readFormer},
    {"vpl", readFormer},
    {"volpath_simple", readFormer},
    {"volpathsimple", readFormer},
    {"irrcache", readFormerAround},
    {"adaptive", readFormerAround},
    {"prb", readForDerivatives},
    {"prb_basic", readForDerivatives},
    {"prb_projective", readForDerivatives},
    {"prb_reparam", readForDerivatives},
    {"prbvolpath", readForDerivatives},
    {"direct_projective", readDirect},
    {"direct_reparam", readDirect},
    {"ptracer", readPath},
};

} // namespace

Names integratorPluginNames() { return namesOf(integratorPlugins); }

IntegratorChoice readIntegrator(const Element& element, LoadContext& context) {
    const IntegratorPlugin* plugin = findPlugin(integratorPlugins, element, context, "taken as 'path'");
    if (!plugin) return {};
    Properties properties(element, context);
    const IntegratorChoice choice = plugin->read(properties);
    properties.finish();
    return choice;
}

std::string_view aovChannels(AovQuantity quantity) {
    switch (quantity) {
    case AovQuantity::albedo:
        return colorChannels;
    case AovQuantity::uv:
    case AovQuantity::duv_dx:
    case AovQuantity::duv_dy:
        return "UV";
    case AovQuantity::depth:
        return "T";
    case AovQuantity::prim_index:
    case AovQuantity::shape_index:
        return "I";
    default:
        return "XYZ";
    }
}

} // namespace quasilux

#include "scene/unsupported_plugins.h"

namespace quasilux {

namespace {

struct Unsupported {
    std::string_view tag, plugin, instead;
};

constexpr std::string_view noPolarisation = "light has no polarisation here; remove it";
constexpr std::string_view formerFilm = "it is of Mitsuba 0.x; use 'hdrfilm'";
constexpr std::string_view asMesh = "export the shape as a mesh, such as 'ply'";

constexpr std::string_view roughDiffuse = "it is of Mitsuba 0.x; use 'diffuse', or 'principled' with specular 0";

constexpr Unsupported unsupported[] = {
    {"shape", "sdfgrid", asMesh},
    {"shape", "ellipsoids", asMesh},
    {"shape", "ellipsoidsmesh", asMesh},
    {"bsdf", "hair", "fibres are not modelled; use 'principled' or 'roughplastic'"},
    {"bsdf", "measured", "tables of measured scattering are not read; use 'principled' or a rough bsdf that is near"},
    {"bsdf", "measured_polarized", noPolarisation},
    {"bsdf", "pplastic", "light has no polarisation here; use 'roughplastic'"},
    {"bsdf", "polarizer", noPolarisation},
    {"bsdf", "retarder", noPolarisation},
    {"bsdf", "circular", noPolarisation},
    {"bsdf", "roughdiffuse", roughDiffuse},
    {"bsdf", "coating", "it is of Mitsuba 0.x; use 'plastic', or 'principled' with a clearcoat"},
    {"bsdf", "roughcoating", "it is of Mitsuba 0.x; use 'roughplastic', or 'principled' with a clearcoat"},
    {"bsdf", "mixturebsdf", "it is of Mitsuba 0.x; use 'blendbsdf'"},
    {"bsdf", "ward", "it is of Mitsuba 0.x; use 'roughconductor', 'roughplastic' or 'principled'"},
    {"bsdf", "difftrans", "it is of Mitsuba 0.x; use 'principledthin' with diff_trans"},
    {"bsdf", "hk", "it is of Mitsuba 0.x; use 'principledthin', or a medium within a border"},
    {"emitter", "timed_sunsky",
     "it moves the sun while the shutter is open; use 'sunsky', which has one place and time"},
    {"sensor", "distant",
     "use sensor 'orthographic', whose rays are parallel too, or 'radiancemeter' for a single ray"},
    {"integrator", "depth", "it draws distances, not light; use 'aov' with a layer such as dd:depth"},
    {"integrator", "emission", "use 'path' with max_depth 1"},
    {"integrator", "stokes", "light has no polarisation here; use the integrator within it"},
    {"integrator", "volprim_rf_basic", "radiance fields are not supported; use shapes"},
    {"shape", "heightfield", asMesh},
    {"shape", "hair", "it is of Mitsuba 0.x; use 'bsplinecurve'"},
    {"emitter", "sky", "it is of Mitsuba 0.x; use 'sunsky' with sun_scale 0"},
    {"emitter", "sun", "it is of Mitsuba 0.x; use 'sunsky' with sky_scale 0"},
    {"emitter", "collimated", "it is of Mitsuba 0.x; use 'directionalarea' on a small shape"},
    {"sensor", "telecentric", "it is of Mitsuba 0.x; use 'orthographic'"},
    {"sensor", "perspective_rdist", "it is of Mitsuba 0.x; use 'perspective'"},
    {"film", "tiledhdrfilm", formerFilm},
    {"film", "mfilm", formerFilm},
    {"film", "exrfilm", formerFilm},
    {"texture", "scale", "it is of Mitsuba 0.x; use the texture within it, of scaled colours"},
    {"texture", "gridtexture", "it is of Mitsuba 0.x; use 'checkerboard' or 'bitmap'"},
    {"texture", "vertexcolors", "it is of Mitsuba 0.x; use 'mesh_attribute' with the name vertex_color"},
    {"integrator", "ao", "use 'path' with max_depth 2 and the emitter 'constant'"},
    {"integrator", "field", "it is of Mitsuba 0.x; use 'aov' with a layer such as dd:depth"},
    {"integrator", "multichannel", "it is of Mitsuba 0.x; use 'aov' with layers such as dd:depth"},
    {"phase", "sggx", "use 'hg', or 'tabphase' with its mean over the fibres' directions"},
};

} // namespace

std::string_view insteadOfUnsupported(std::string_view tag, std::string_view plugin) {
    for (const Unsupported& entry : unsupported)
        if (entry.tag == tag && entry.plugin == plugin) return entry.instead;
    return {};
}

std::string_view tagOfUnsupported(std::string_view plugin) {
    for (const Unsupported& entry : unsupported)
        if (entry.plugin == plugin) return entry.tag;
    return {};
}

} // namespace quasilux

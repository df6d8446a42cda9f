// What a scene file says, in world space (less Scene::origin) and resolved: the input of host/prepare. No device, no
// Embree, no XML here.
#pragma once

#include "bsdf/lobe_list.h"
#include "scene/goniograms/goniogram.h"
#include "scene/load_limits.h"
#include "scene/sensor.h"
#include "scene/setting_choices.h"
#include "scene/shape_group.h"
#include "shared_types.h"
#include "util/error.h"

#include <array>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace quasilux {

using shared::Rgb;

/// What `<?quasilux quasi-specular="…"?>` in a bsdf or a medium, or the command line, says of its lobes.
struct QuasiSpecularChoice {
    enum class Kind { automatic, yes, no, lobes, level };
    Kind kind = Kind::automatic;
    std::vector<std::string> lobes; ///< Kind::lobes: names such as "specular"
    double level = 0;    ///< Kind::level, media only: sr^-1, what of the phase function lies below is genuine diffuse
    bool stated = false; ///< false: nothing was said, the global setting decides
};

/// A texture of numbers, of which `offset` + `factor` times the value counts.
struct LevelTexture {
    unsigned texture = 0; ///< index into Scene::textures, of equal channels
    double offset = 0, factor = 1;

    bool operator==(const LevelTexture&) const = default;
};

/// One lobe as the scene describes it. `device.scattering` is SCATTER_SPECULAR for delta lobes and otherwise 0 until
/// host/prepare/split decides between genuine diffuse and quasi-specular.
struct LobeDescription {
    shared::Lobe device{};
    std::vector<shared::LobeWeight> weights; ///< factors by texture; their textures count from 0 in Scene::textures
    std::vector<LevelTexture> levelTextures; ///< of what the lobe is not linear in, such as its roughness
    /// Sets what these textures decide, by their values in the same order.
    std::function<void(shared::Lobe&, const std::vector<double>&)> setLevel;
    std::string name;                  ///< "diffuse", "specular", …, as a quasi-specular list names it
    QuasiSpecularChoice quasiSpecular; ///< from the innermost bsdf that says something
    double halfWidth = 0; ///< radians: half the lobe's energy lies within this angle of its peak (0 delta, 45° Lambert)
    bool axesByTexture = false; ///< textures may tell its two alphas apart, whatever their means
};

struct Bsdf {
    std::string id;     ///< as in the scene, or "<plugin>@line" where it has none
    std::string plugin; ///< outermost plugin name
    SourceLocation where;
    std::vector<LobeDescription> front;                    ///< lobes seen from the side of the normal
    std::vector<LobeDescription> back;                     ///< lobes seen from behind; empty = black (one-sided)
    std::optional<shared::Relief> frontRelief, backRelief; ///< what bends the normals; textures count from 0
    bool isNull = false;

    /// Of its lobes and what bends the normals, without those within them; each as often as it is used.
    std::vector<unsigned> textures() const;
    /// Whether any lobe, or what bends the normals, has a texture.
    bool isTextured() const { return !textures().empty(); }
    /// Whether light passes as if the surface were not there, at least in part.
    bool letsPass() const;
    /// Whether a lobe is not the same in all directions about the normal, at least in part.
    bool isAnisotropic() const;
    /// Whether the complex index of refraction of a conductor or a thin sheet goes by textures.
    bool hasIndexTexture() const;
};

/// Radiance that a shape emits on the side of its normal, W sr^-1 m^-2.
struct AreaEmitter {
    Rgb radiance{};
    std::optional<unsigned> texture; ///< index into Scene::textures; multiplies the radiance
    bool alongNormal = false;        ///< only; what `radiance` holds is the irradiance across the beam then, W m^-2
    SourceLocation where;
};

/// Pixels of an image, row by row from v = 0 on, linear. Copies share them.
class Texels {
public:
    Texels() = default;
    Texels(std::vector<Rgb> pixels) : pixels_(std::make_shared<const std::vector<Rgb>>(std::move(pixels))) {}

    operator const std::vector<Rgb>&() const { return *pixels_; }
    /// The same for copies, different for others.
    const void* identity() const { return pixels_.get(); }
    bool empty() const { return pixels_->empty(); }
    size_t size() const { return pixels_->size(); }
    const Rgb& at(size_t i) const { return pixels_->at(i); }
    const Rgb& operator[](size_t i) const { return (*pixels_)[i]; }
    auto begin() const { return pixels_->begin(); }
    auto end() const { return pixels_->end(); }

private:
    std::shared_ptr<const std::vector<Rgb>> pixels_ = std::make_shared<const std::vector<Rgb>>();
};

/// Values of at least 0 that vary in space, one or three channels.
struct VolumeDescription {
    shared::VolumeGrid device{};
    std::vector<float> values; ///< channels of a voxel side by side, x fastest, z slowest
    SourceLocation where;
};

/// What a texture multiplies: what surfaces scatter, in [0, 1], or what emitters send, at least 0. Or it is an index of
/// refraction, at least 0. Or the height of a bump map.
enum class TextureUse { reflectance, emission, index, height };

/// A factor over a surface that scatters or emits, or over the directions of a point emitter.
struct TextureDescription {
    TextureUse use = TextureUse::reflectance;
    shared::Texture device{};
    Texels texels;                                   ///< bitmap
    std::string attribute;                           ///< of meshes: its name
    float attributeScale = 1;                        ///< a factor on it
    std::shared_ptr<const VolumeDescription> volume; ///< TEXTURE_VOLUME
    bool isNumber = false; ///< a weight is wanted, so that an attribute may have one channel only
    SourceLocation where;
};

/// Values that a mesh file gives its vertices (names vertex_…) or faces (face_…).
struct MeshAttribute {
    std::string name;
    unsigned channels = 3;   ///< 1 or 3
    std::vector<Rgb> values; ///< by index into Mesh::positions, or by triangle; of one channel grey

    bool isOfFaces() const { return name.rfind("face_", 0) == 0; }
};

struct Mesh {
    std::vector<glm::vec3> positions;     ///< world space
    std::vector<glm::uvec3> triangles;    ///< indices into positions; counter-clockwise seen from the normal's side
    std::vector<glm::vec3> cornerNormals; ///< 3 per triangle, unit; empty = flat. flip_normals is already applied
    std::vector<glm::vec2> cornerUvs;     ///< 3 per triangle; empty = the mesh has none
    size_t cornersWithoutUv = 0;          ///< corners to which the file gives none, if it gives some: theirs are (0, 0)
    std::vector<MeshAttribute> attributes; ///< of the file, those that the bsdf shows
};

struct Sphere {
    glm::vec3 center{};
    float radius = 0;
    glm::mat3 toLocal{1.f}; ///< rotation (and mirroring) from the world to its own axes, for texture coordinates
};

/// A rectangle that emits can be sampled by solid angle: corner, two orthogonal sides along which u and v run from 0 to
/// 1, unit normal.
struct RectangleFrame {
    glm::vec3 corner{}, edgeU{}, edgeV{}, normal{};
};

/// One of the phase functions that make up a medium's.
struct PhasePartDescription {
    unsigned phase = PHASE_ISOTROPIC; ///< PHASE_*, of one function
    double g = 0;                     ///< mean cosine
    double weight = 1;
    std::vector<double> values; ///< PHASE_TABULATED: sr^-1, at equal steps of the cosine from -1 to 1
};

/// <medium>: what fills the inside of shapes, or surrounds them.
struct MediumDescription {
    std::string id; ///< as in the scene, or "<plugin>@line"
    SourceLocation where;
    unsigned phase = PHASE_ISOTROPIC;             ///< PHASE_*
    double g = 0;                                 ///< mean cosine, > 0 forwards
    std::vector<PhasePartDescription> phaseParts; ///< PHASE_MIXED: their weights add up to 1
    Rgb sigmaT{}; ///< 1/scene unit, `scale` included; heterogeneous: mean over the volume
    Rgb albedo{}; ///< likewise
    std::optional<unsigned> extinction, albedoVolume; ///< heterogeneous: index into Scene::volumes
    float extinctionScale = 1;                        ///< on the former
    QuasiSpecularChoice quasiSpecular;
};

struct ShapeDescription {
    std::string id; ///< as in the scene, or "<plugin>@line"
    std::string plugin;
    SourceLocation where;
    Mesh mesh; ///< empty for a sphere
    std::optional<Sphere> sphere;
    std::optional<RectangleFrame> rectangle; ///< set for `rectangle` whose sides stayed orthogonal
    bool flipNormals = false;                ///< already applied to a mesh's winding; a sphere's normal points inwards
    int bsdf = -1;                           ///< index into Scene::bsdfs
    std::optional<AreaEmitter> emitter;
    bool emitterIsOff = false; ///< it has one that emits nothing; `hide_emitters` hides it all the same
    std::optional<unsigned> interior, exterior; ///< media as stated, index into Scene::media
};

struct PointEmitter {
    std::string id;
    SourceLocation where;
    glm::vec3 position{};
    Rgb intensity{}; ///< W sr^-1; of a spot on its axis
    struct Spot {
        glm::vec3 axis{}; ///< unit
        double beamAngle = 0,
               cutoffAngle = 0; ///< radians: full intensity up to the one, none beyond the other, linear between
    };
    /// Across an axis: looked up at 1/2 + (d·u, d·v) / (d·axis) in the direction d.
    struct Picture {
        glm::vec3 u{}, v{};
        std::optional<unsigned> texture; ///< index into Scene::textures; multiplies the intensity
    };
    /// Throws its picture: the intensity is that on the axis over cos^3 of the angle to it, none outside of the unit
    /// square.
    struct Projector {
        glm::vec3 axis{}; ///< unit
        Picture picture;
    };
    /// Shines as the file of a luminaire says.
    struct Luminaire {
        unsigned type = 0;    ///< index into Scene::luminaireTypes; the intensity multiplies its candela
        glm::dmat3 axes{1.0}; ///< the luminaire's own x, y, z in the world, orthonormal
    };
    std::optional<Luminaire> luminaire;
    std::optional<Picture> picture; ///< of a spot
    std::optional<Projector> projector;
    std::optional<Spot> spot;
    std::optional<unsigned> medium; ///< in which it stands, as stated, index into Scene::media
};

/// What luminaires of one file have in common.
struct LuminaireType {
    Goniogram goniogram;
    double metresPerUnit = 1; ///< of the scene
    bool fromShape = true;    ///< light leaves through the luminous shape; or else from its centre
};

/// Parallel light from outside of the scene.
struct DirectionalEmitter {
    std::string id;
    SourceLocation where;
    glm::vec3 direction{}; ///< in which it travels, unit
    Rgb irradiance{};      ///< of a surface across it, W m^-2
};

/// An image by latitude and longitude (kernels/emitters/envmap.clh).
struct EnvironmentImage {
    unsigned width = 0, height = 0; ///< pixels, at least 1 × 2
    std::vector<Rgb> pixels;        ///< W sr^-1 m^-2, row by row from +y on
    glm::dmat3 axes{1.0};           ///< its own x, y, z in the world, orthonormal
    bool hasSun = false;            ///< the sun's disc is a part of it
    Rgb groundBySun{};              ///< what the lower half has by a sun that is parallel light
};

/// Radiance that comes from everywhere outside of the scene, W sr^-1 m^-2.
struct Surroundings {
    std::string id;
    SourceLocation where;
    std::string plugin;
    Rgb radiance{};              ///< without an image: the same from everywhere
    bool isPerNanometre = false; ///< radiance is W m^-2 sr^-1 nm^-1, of which 683 lm/W makes no lux
    std::optional<EnvironmentImage> image;
};

/// quasilux settings of the scene; std::nullopt = not said. Command-line options override them.
struct SceneSettings {
    std::optional<unsigned> bdd;
    std::optional<Variant> variant;
    std::optional<std::string> quasiSpecular; ///< "auto", "none", "all", "level:NUMBER", "ID,ID"
    std::optional<DirectLight> direct;
    std::optional<CausticLight> caustics;
    std::optional<MapOrder> map;
    std::optional<unsigned> photons;     ///< emitted per pass
    std::optional<unsigned> cameraPaths; ///< of a pixel in each pass
    std::optional<CameraSampling> cameraSampling;
    std::optional<uint64_t> seed;
    std::optional<Units> units; ///< radiometric where not said
    std::optional<InstanceLevels> instances;
};

/// What a layer of integrator 'aov' shows of the surface that a pixel's rays meet first.
enum class AovQuantity {
    albedo,
    depth,
    position,
    uv,
    geo_normal,
    sh_normal,
    dp_du,
    dp_dv,
    duv_dx,
    duv_dy,
    prim_index,
    shape_index
};
struct AovLayer {
    std::string name; ///< of its channels, before the dot
    AovQuantity quantity;
};

struct Scene {
    std::string path;
    glm::dvec3 origin{0}; ///< coordinates here are those of the file less this (host/scene/origin.h)
    std::vector<Bsdf> bsdfs;
    std::vector<ShapeDescription> shapes; ///< in the world; then, in spaces of their own, those of `groups`
    std::vector<ShapeGroup> groups;
    std::vector<Instance> instances;
    std::vector<TextureDescription> textures; ///< Lobe::reflectanceTexture and so on: 1 + index
    std::vector<VolumeDescription> volumes;
    std::vector<MediumDescription> media;
    std::vector<PointEmitter> pointEmitters;
    std::vector<LuminaireType> luminaireTypes;
    std::vector<DirectionalEmitter> directionalEmitters;
    std::optional<Surroundings> surroundings;
    Sensor sensor;          ///< the one that is rendered
    size_t sensorCount = 0; ///< in the file
    std::vector<IlluminanceGrid>
        grids; ///< measured by MeterKind::grid, whose film has their points one after the other
    std::vector<Observer> observers;
    bool hideEmitters = false; ///< the camera looks through emitting shapes and sees no surroundings (hide_emitters)
    int maxDepth = -1; ///< limit on the segments of the whole path, photon plus camera; -1 = none (Mitsuba's max_depth)
    /// For both: what passes straight through a surface (`null`, `mask`, a thin pane) begins a segment.
    bool countsPassages = true;
    bool hidesBeyondPassages = true; ///< then: surroundings, and shapes at the end of the longest paths
    std::vector<AovLayer> aovs;      ///< that the integrator asks for
    SceneSettings settings;
    std::vector<std::string> warnings;      ///< "file:line:column: …"; things accepted but without effect
    std::vector<std::string> withoutEffect; ///< parameters that are accepted without effect and without a warning

    std::span<const ShapeDescription> worldShapes() const {
        return {shapes.data(), groups.empty() ? shapes.size() : groups.front().firstShape};
    }
    std::span<const ShapeDescription> shapesOf(const ShapeGroup& group) const {
        return {shapes.data() + group.firstShape, group.shapeCount};
    }
};

/// Plugins, parameters and elements that are not known, and values out of range: an InputError, or a warning, and they
/// are left out or something plain stands in for them (docs/reference/scene-language.md#what-is-not-known).
enum class Unknown { refused, forgiven };

/// How a file is read.
struct LoadChoice {
    std::string sensor = {}; ///< its number in the order of the file, from 0 on, or its id; empty: the first one
    Unknown unknown = Unknown::refused;
    std::optional<LoadLimits> limits = {}; ///< of a scene that is not trusted
    bool observersSuffice = false;         ///< a scene with observers needs neither sensor nor grid
};

/// Loads a Mitsuba 3 scene (docs/reference/scene-language.md). Throws InputError at file:line:column.
/// `parameters` replace `<default>` values, as `-D name=value` does.
Scene loadScene(const std::string& path, const std::vector<std::pair<std::string, std::string>>& parameters = {},
                const LoadChoice& choice = {});

/// Makes the grids of the scene its sensor. Throws InputError where the scene has none, or they have too many points
/// together.
void useGridsAsSensor(Scene& scene);

} // namespace quasilux

// Emitting shapes, points and surroundings into the emitter table, with selection in proportion to power.
#include "prepare/bounding_sphere.h"
#include "prepare/device_scene.h"
#include "prepare/environment.h"
#include "prepare/goniogram_table.h"
#include "prepare/light_tree.h"
#include "prepare/pack.h"
#include "prepare/texture_mean.h"
#include "scene/color.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace quasilux {

namespace {

using std::numbers::pi;

void addTriangles(const Mesh& mesh, shared::Emitter& emitter, std::vector<shared::EmitterTriangle>& triangles) {
    emitter.firstTriangle = static_cast<unsigned>(triangles.size());
    double area = 0;
    std::vector<double> sums;
    for (const auto& t : mesh.triangles) {
        const glm::vec3 p0 = mesh.positions[t.x], e1 = mesh.positions[t.y] - p0, e2 = mesh.positions[t.z] - p0;
        const double here = 0.5 * glm::length(glm::cross(glm::dvec3(e1), glm::dvec3(e2)));
        area += here;
        sums.push_back(area);
        triangles.push_back({pack(p0), pack(e1), pack(e2), 0});
    }
    emitter.triangleCount = static_cast<unsigned>(sums.size());
    emitter.area = static_cast<float>(area);
    // One without area has the cdf of the one before, or of all, so that it is never chosen; the numbers stay those of
    // the mesh.
    for (size_t k = 0; k < sums.size(); ++k)
        triangles[emitter.firstTriangle + k].areaCdf = sums[k] == area ? 1.f : static_cast<float>(sums[k] / area);
}

/// Of the triangles of a plane mesh, or 0 where they differ by more than rounding.
glm::vec3 commonNormal(const Mesh& mesh) {
    glm::dvec3 sum(0);
    std::vector<glm::dvec3> crosses;
    double size = 0;
    for (const auto& p : mesh.positions)
        size = std::max({size, std::abs(double(p.x)), std::abs(double(p.y)), std::abs(double(p.z))});
    for (const auto& t : mesh.triangles) {
        const glm::dvec3 p0 = mesh.positions[t.x];
        crosses.push_back(glm::cross(glm::dvec3(mesh.positions[t.y]) - p0, glm::dvec3(mesh.positions[t.z]) - p0));
        sum += crosses.back();
    }
    // In a plane as far as positions are known: the normals of thin triangles, such as a disk's, are known less well.
    const double rounding = 8 * std::numeric_limits<float>::epsilon() * size;
    const glm::dvec3 normal = glm::normalize(sum), corner = mesh.positions[mesh.triangles.front().x];
    const auto isInPlane = [&](unsigned vertex) {
        return std::abs(glm::dot(glm::dvec3(mesh.positions[vertex]) - corner, normal)) <= rounding;
    };
    for (size_t k = 0; k < crosses.size(); ++k) {
        const auto& t = mesh.triangles[k];
        if (!isInPlane(t.x) || !isInPlane(t.y) || !isInPlane(t.z) || glm::dot(crosses[k], normal) < 0)
            return glm::vec3(0);
    }
    return normal;
}

shared::Emitter areaEmitter(const ShapeDescription& shape, unsigned index,
                            std::vector<shared::EmitterTriangle>& triangles) {
    shared::Emitter emitter{};
    emitter.shape = index;
    emitter.radiance = shape.emitter->radiance;
    emitter.texture = shape.emitter->texture ? *shape.emitter->texture + 1 : 0;
    emitter.normalSign = shape.flipNormals ? -1.f : 1.f;
    if (shape.emitter->alongNormal) {
        emitter.type = EMITTER_DIRECTIONALAREA;
        addTriangles(shape.mesh, emitter, triangles);
        emitter.normal = pack(commonNormal(shape.mesh));
    } else if (shape.rectangle) {
        const auto& frame = *shape.rectangle;
        emitter.type = EMITTER_RECTANGLE;
        emitter.origin = pack(frame.corner);
        emitter.edgeU = pack(frame.edgeU);
        emitter.edgeV = pack(frame.edgeV);
        emitter.normal = pack(frame.normal);
        emitter.area = static_cast<float>(double(glm::length(frame.edgeU)) * glm::length(frame.edgeV));
    } else if (shape.sphere) {
        emitter.type = EMITTER_SPHERE;
        emitter.origin = pack(shape.sphere->center);
        emitter.radius = shape.sphere->radius;
        emitter.area = static_cast<float>(4 * pi * shape.sphere->radius * shape.sphere->radius);
    } else {
        emitter.type = EMITTER_TRIANGLES;
        addTriangles(shape.mesh, emitter, triangles);
    }
    return emitter;
}

/// Mean of its texture by area.
Rgb meanOfRadiance(const ShapeDescription& shape, const Scene& scene) {
    if (!shape.emitter->texture) return {1, 1, 1};
    const TextureDescription& texture = scene.textures[*shape.emitter->texture];
    if (shape.sphere) // even in azimuth and in the cosine of the angle to its axis
        return meanOfTexture(texture, scene.textures, [](double x, double y) {
            return TexturePlace{{x, std::acos(1 - 2 * y) / pi}, 1};
        });
    return meanOfTexture(texture, scene.textures, shape.mesh);
}

/// Of its intensity over that on the axis: 2 pi times the integral of min(1, (cutoff - angle) / (cutoff - beam))
/// sin(angle).
double solidAngleOf(const PointEmitter::Spot& spot) {
    const double b = spot.beamAngle, c = spot.cutoffAngle;
    return 2 * pi * (1 - (std::sin(c) - std::sin(b)) / (c - b));
}

/// Mean of the picture's texture over the spot's intensity without it.
Rgb meanOfPicture(const TextureDescription& texture, const PointEmitter& point,
                  const std::vector<TextureDescription>& all) {
    const PointEmitter::Spot& spot = *point.spot;
    const glm::dvec3 axis(spot.axis), u(point.picture->u), v(point.picture->v);
    const glm::dvec3 s = glm::normalize(u), t = glm::normalize(v);
    return meanOfTexture(texture, all, [&](double x, double y) {
        const double cosine = 1 - x * 2 * std::pow(std::sin(spot.cutoffAngle / 2), 2), azimuth = 2 * pi * y;
        const double sine = std::sqrt(std::max(1 - cosine * cosine, 0.0));
        const glm::dvec3 d = cosine * axis + sine * (std::cos(azimuth) * s + std::sin(azimuth) * t);
        const double share = (spot.cutoffAngle - std::acos(cosine)) / (spot.cutoffAngle - spot.beamAngle);
        return TexturePlace{0.5 + glm::dvec2(glm::dot(d, u), glm::dot(d, v)) / glm::dot(d, axis),
                            std::clamp(share, 0.0, 1.0)};
    });
}

void setPicture(const PointEmitter::Picture& picture, shared::Emitter& emitter) {
    emitter.texture = picture.texture ? *picture.texture + 1 : 0;
    emitter.edgeU = pack(picture.u);
    emitter.edgeV = pack(picture.v);
}

/// Its flux over its intensity on the axis, without a texture; completes the record.
double solidAngleOf(const PointEmitter& point, shared::Emitter& emitter) {
    if (point.spot) {
        emitter.type = EMITTER_SPOT;
        emitter.normal = pack(point.spot->axis);
        emitter.beamAngle = static_cast<float>(point.spot->beamAngle);
        emitter.cutoffAngle = static_cast<float>(point.spot->cutoffAngle);
        if (point.picture) setPicture(*point.picture, emitter);
        return solidAngleOf(*point.spot);
    }
    if (point.projector) {
        emitter.type = EMITTER_PROJECTOR;
        emitter.normal = pack(point.projector->axis);
        setPicture(point.projector->picture, emitter);
        const double area =
            1 / (double(glm::length(point.projector->picture.u)) * glm::length(point.projector->picture.v));
        emitter.area = static_cast<float>(area);
        const double toCorner = std::hypot(0.5 / glm::length(point.projector->picture.u),
                                           0.5 / glm::length(point.projector->picture.v)); // at depth 1
        emitter.cutoffAngle = static_cast<float>(std::atan(toCorner));
        return area;
    }
    emitter.type = EMITTER_POINT;
    return 4 * pi;
}

/// Mean of its texture over what it would send without.
Rgb meanOfPicture(const PointEmitter& point, const shared::Emitter& emitter,
                  const std::vector<TextureDescription>& all) {
    if (emitter.texture == 0) return {1, 1, 1};
    const TextureDescription& texture = all[emitter.texture - 1];
    if (point.spot) return meanOfPicture(texture, point, all);
    return meanOfTexture(texture, all, [](double x, double y) { return TexturePlace{{x, y}, 1}; });
}

/// Completes the record and returns the flux over the intensity.
double setLuminaire(const PointEmitter::Luminaire& luminaire, const GoniogramKind& kind, shared::Emitter& emitter) {
    emitter.type = EMITTER_GONIOGRAM;
    emitter.goniogram = kind.first;
    const glm::dmat3 axes = luminaire.axes * kind.axes;
    emitter.edgeU = pack(axes[0]);
    emitter.edgeV = pack(axes[1]);
    emitter.normal = pack(axes[2]);
    emitter.radius = static_cast<float>(kind.radius);
    emitter.cutoffAngle = static_cast<float>(kind.spread);
    return kind.lumens;
}

/// A point emitter with its power.
shared::Emitter pointEmitter(const PointEmitter& point, const std::vector<TextureDescription>& textures,
                             const std::vector<GoniogramKind>& luminaires, double* power) {
    shared::Emitter emitter{};
    emitter.shape = QL_NONE;
    emitter.radiance = point.intensity;
    emitter.origin = pack(point.position);
    *power = point.luminaire ? setLuminaire(*point.luminaire, luminaires[point.luminaire->type], emitter)
                             : solidAngleOf(point, emitter);
    *power *= mean(point.intensity * meanOfPicture(point, emitter, textures));
    return emitter;
}

/// One that shines into the scene from outside of its bounds.
shared::Emitter distantEmitter(unsigned type, const Rgb& radiance, const Sphere& bounds) {
    shared::Emitter emitter{};
    emitter.type = type;
    emitter.medium = MEDIUM_NONE;
    emitter.shape = QL_NONE;
    emitter.radiance = radiance;
    emitter.origin = pack(bounds.center);
    emitter.radius = bounds.radius;
    emitter.area = static_cast<float>(pi * bounds.radius * bounds.radius);
    return emitter;
}

/// `words`: of their image, if they have one; `radiance` as in EmitterTables.
shared::Emitter surroundings(const Surroundings& from, const Sphere& bounds, std::vector<uint32_t>& words,
                             double& radiance) {
    radiance = mean(from.radiance);
    if (!from.image) return distantEmitter(EMITTER_CONSTANT, from.radiance, bounds);
    EnvironmentTable table = makeEnvironmentTable(*from.image);
    words = std::move(table.words);
    radiance = table.radianceByFlux;
    auto emitter = distantEmitter(EMITTER_ENVMAP, table.meanRadiance, bounds);
    emitter.edgeU = pack(from.image->axes[0]);
    emitter.edgeV = pack(from.image->axes[1]);
    emitter.normal = pack(from.image->axes[2]);
    return emitter;
}

void addDistantEmitters(const Scene& scene, EmitterTables& tables) {
    if (scene.directionalEmitters.empty() && !scene.surroundings) return;
    const Sphere bounds = boundingSphere(scene);
    const auto add = [&](shared::Emitter emitter, double power, double radiance, const std::string& id) {
        tables.emitters.push_back(emitter);
        tables.power.push_back(power);
        tables.radiance.push_back(radiance);
        tables.ids.push_back(id);
    };
    for (const auto& light : scene.directionalEmitters) {
        auto emitter = distantEmitter(EMITTER_DIRECTIONAL, light.irradiance, bounds);
        emitter.normal = pack(light.direction);
        add(emitter, emitter.area * mean(light.irradiance), 0, light.id);
    }
    if (scene.surroundings) { // last, where the kernels look for it
        double radiance = 0;
        const auto emitter = surroundings(*scene.surroundings, bounds, tables.environment, radiance);
        // pi L by area on the sphere about the scene is 4 pi^2 R^2 L = 4 pi L times the great disc.
        add(emitter, 4 * pi * emitter.area * mean(emitter.radiance), radiance, scene.surroundings->id);
    }
}

/// Kernels need an emitter: of a scene without light a faint one that shines from outside of it away from it.
void addNoLight(const Scene& scene, EmitterTables& tables) {
    const Sphere bounds = boundingSphere(scene);
    PointEmitter point;
    point.position = bounds.center + glm::vec3(0, 0, 2 * bounds.radius);
    point.intensity = {1e-9f, 1e-9f, 1e-9f};
    point.spot = {glm::vec3(0, 0, 1), pi / 8, pi / 4};
    double power = 0;
    tables.emitters.push_back(pointEmitter(point, scene.textures, {}, &power));
    tables.emitters.back().medium = MEDIUM_NONE;
    tables.power.push_back(power);
    tables.radiance.push_back(0);
    tables.ids.push_back("none");
    tables.hasLight = false;
}

// Of fewer emitters all can be listed by what was learned.
constexpr size_t manyEmitters = LIGHT_CHOICES;

template <typename T>
void reorder(std::vector<T>& values, const std::vector<unsigned>& order) {
    std::vector<T> sorted;
    sorted.reserve(order.size());
    for (const unsigned k : order) sorted.push_back(values[k]);
    values = std::move(sorted);
}

void sortIntoTree(EmitterTables& tables) {
    const bool isDark = std::all_of(tables.power.begin(), tables.power.end(), [](double p) { return p == 0; });
    if (tables.emitters.size() < manyEmitters || isDark) return;
    LightTree tree = buildLightTree(tables);
    reorder(tables.emitters, tree.order);
    reorder(tables.power, tree.order);
    reorder(tables.radiance, tree.order);
    reorder(tables.ids, tree.order);
    for (unsigned k = 0; k < tables.emitters.size(); ++k)
        if (tables.emitters[k].shape != QL_NONE) tables.emitterOfShape[tables.emitters[k].shape] = k;
    tables.lightTree = std::move(tree.nodes);
}

void setSelection(EmitterTables& tables) {
    double total = 0;
    for (const double power : tables.power) total += power;
    double sum = 0;
    for (size_t k = 0; k < tables.emitters.size(); ++k) {
        // Values that multiply to nothing, such as a red spot through a green picture, are not seen to be off before.
        const double share = total > 0 ? tables.power[k] / total : 1.0 / static_cast<double>(tables.emitters.size());
        sum += share;
        tables.emitters[k].selectionProbability = static_cast<float>(share);
        tables.emitters[k].selectionCdf = k + 1 == tables.emitters.size() ? 1.f : static_cast<float>(sum);
    }
}

} // namespace

EmitterTables flattenEmitters(const Scene& scene, const MediumPlacement& placement) {
    EmitterTables tables;
    tables.emitterOfShape.assign(scene.shapes.size(), QL_NONE);
    for (unsigned k = 0; k < scene.shapes.size(); ++k) {
        const auto& shape = scene.shapes[k];
        if (!shape.emitter) continue;
        tables.emitterOfShape[k] = static_cast<unsigned>(tables.emitters.size());
        tables.emitters.push_back(areaEmitter(shape, k, tables.triangles));
        tables.emitters.back().medium = placement.shapeEmitters[k];
        const double solidAngle = shape.emitter->alongNormal ? 1 : pi; // by the cosine
        const double radiance = mean(shape.emitter->radiance * meanOfRadiance(shape, scene));
        tables.power.push_back(solidAngle * tables.emitters.back().area * radiance);
        tables.radiance.push_back(shape.emitter->alongNormal ? 0 : radiance);
        tables.ids.push_back(shape.id);
    }
    std::vector<GoniogramKind> luminaires;
    for (const LuminaireType& type : scene.luminaireTypes) luminaires.push_back(addGoniogram(type, tables.goniograms));
    for (size_t k = 0; k < scene.pointEmitters.size(); ++k) {
        const auto& point = scene.pointEmitters[k];
        double power = 0;
        tables.emitters.push_back(pointEmitter(point, scene.textures, luminaires, &power));
        tables.emitters.back().medium = placement.pointEmitters[k];
        tables.power.push_back(power);
        tables.radiance.push_back(0);
        tables.ids.push_back(point.id);
    }
    sortIntoTree(tables);
    addDistantEmitters(scene, tables);
    if (tables.emitters.empty()) addNoLight(scene, tables);
    setSelection(tables);
    return tables;
}

} // namespace quasilux

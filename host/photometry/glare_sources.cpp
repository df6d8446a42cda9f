// What an eye sees of luminaires: luminance, solid angle, position, and how much of each is hidden.
#include "photometry/glare.h"

#include "scene/photometric_units.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace quasilux {

namespace {

// Places on a luminaire that are looked at.
constexpr unsigned placesOfLuminaire = 64;
// Triangles are divided until they look smaller than this, sr: one position holds for them.
constexpr double smallTriangle = 2e-4;
constexpr unsigned mostDivisions = 6;

/// Fractions of the R3 sequence (Roberts 2018), evenly spread in the unit cube.
glm::dvec3 evenPlace(unsigned k) {
    const glm::dvec3 step(0.8191725133961645, 0.6710436067037893, 0.5497004779019703);
    return glm::fract(0.5 + (k + 1.0) * step);
}

bool isWithin(LuminousShape::Kind kind, const glm::dvec3& p) { // from -1 to 1 each
    switch (kind) {
    case LuminousShape::Kind::uprightRod:
        return p.x * p.x + p.y * p.y <= 1;
    case LuminousShape::Kind::rodAlongC0:
        return p.y * p.y + p.z * p.z <= 1;
    case LuminousShape::Kind::rodAlongC90:
        return p.x * p.x + p.z * p.z <= 1;
    case LuminousShape::Kind::ellipsoid:
        return glm::dot(p, p) <= 1;
    default:
        return true;
    }
}

/// In the luminaire's frame, metres: evenly over its luminous shape, as its light leaves it.
std::vector<glm::dvec3> placesOn(const LuminousShape& shape) {
    std::vector<glm::dvec3> places;
    for (unsigned k = 0; places.size() < placesOfLuminaire; ++k) {
        const glm::dvec3 p = 2.0 * evenPlace(k) - 1.0;
        if (isWithin(shape.kind, p)) places.push_back(0.5 * p * glm::dvec3(shape.sizeC0, shape.sizeC90, shape.height));
    }
    return places;
}

class Eye {
public:
    Eye(const Observer& observer, const Occlusion& occlusion)
        : place_(observer.position), sight_{observer.direction, observer.up}, occlusion_(occlusion) {}

    const glm::dvec3& place() const { return place_; }
    bool sees(const glm::dvec3& at) const { return !occlusion_.isHidden(place_, at); }
    /// 1 / p² of what lies there, 0 behind the eye.
    double weight(const glm::dvec3& at) const {
        const double p = positionIndex(sight_, glm::normalize(at - place_));
        return std::isfinite(p) ? 1 / (p * p) : 0;
    }

private:
    glm::dvec3 place_;
    LineOfSight sight_;
    const Occlusion& occlusion_;
};

double luminanceOfRgb(const Rgb& rgb, bool photometric) {
    return (photometric ? 1 : luminousEfficacy) * luminanceOf(rgb.r, rgb.g, rgb.b);
}

/// Sums over the parts of a source that are seen.
struct Sums {
    double whole = 0, seen = 0, weighted = 0; ///< sr: all of it, what is seen of it, that over p²

    void add(const Eye& eye, const glm::dvec3& at, double solidAngle) {
        whole += solidAngle;
        const double weight = eye.weight(at);
        if (!(weight > 0) || !eye.sees(at)) return;
        seen += solidAngle;
        weighted += weight * solidAngle;
    }

    GlareSource source(const std::string& name, double luminance) const {
        return {name, luminance, seen, std::sqrt(seen / weighted), seen / whole};
    }
};

/// Van Oosterom & Strackee 1983.
double solidAngleOf(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
    return 2 * std::abs(std::atan2(glm::dot(a, glm::cross(b, c)),
                                   la * lb * lc + glm::dot(a, b) * lc + glm::dot(a, c) * lb + glm::dot(b, c) * la));
}

void addTriangle(Sums& sums, const Eye& eye, const std::array<glm::dvec3, 3>& corners, unsigned divisions) {
    const auto& [a, b, c] = corners;
    const double solidAngle = solidAngleOf(a - eye.place(), b - eye.place(), c - eye.place());
    if (solidAngle < smallTriangle || divisions == 0) return sums.add(eye, (a + b + c) / 3.0, solidAngle);
    const glm::dvec3 ab = (a + b) / 2.0, bc = (b + c) / 2.0, ca = (c + a) / 2.0;
    for (const std::array<glm::dvec3, 3>& part :
         {std::array{a, ab, ca}, std::array{ab, b, bc}, std::array{ca, bc, c}, std::array{ab, bc, ca}})
        addTriangle(sums, eye, part, divisions - 1);
}

void addMesh(Sums& sums, const Eye& eye, const Mesh& mesh) {
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
        // They emit on the side of their normal.
        if (glm::dot(glm::cross(b - a, c - a), eye.place() - a) <= 0) continue;
        addTriangle(sums, eye, {a, b, c}, mostDivisions);
    }
}

/// As equal parts of the disc that is seen.
void addSphere(Sums& sums, const Eye& eye, const Sphere& sphere) {
    const glm::dvec3 centre(sphere.center), way = centre - eye.place();
    const double distance = glm::length(way), radius = sphere.radius;
    const double solidAngle = 2 * std::numbers::pi * (1 - std::sqrt(1 - radius * radius / (distance * distance)));
    const glm::dvec3 forward = way / distance;
    const glm::dvec3 right = glm::normalize(std::abs(forward.x) < 0.5 ? glm::cross(forward, glm::dvec3(1, 0, 0))
                                                                      : glm::cross(forward, glm::dvec3(0, 1, 0)));
    for (unsigned k = 0; k < placesOfLuminaire; ++k) {
        const double r = radius * std::sqrt((k + 0.5) / placesOfLuminaire), turn = 2.399963 * k; // sunflower
        const glm::dvec3 at = centre + r * (std::cos(turn) * right + std::sin(turn) * glm::cross(forward, right)) -
                              std::sqrt(radius * radius - r * r) * forward;
        sums.add(eye, at, solidAngle / placesOfLuminaire);
    }
}

bool isInside(const Sphere& sphere, const glm::dvec3& place) {
    return glm::length(glm::dvec3(sphere.center) - place) <= sphere.radius;
}

class Collector {
public:
    Collector(const Scene& scene, const Observer& observer, const Occlusion& occlusion, bool photometric)
        : scene_(scene), eye_(observer, occlusion), photometric_(photometric) {}

    void addPoint(const PointEmitter& emitter) {
        if (!emitter.luminaire) return leaveOut(emitter.id, "is a point, so that its luminance has no bounds");
        const LuminaireType& type = scene_.luminaireTypes[emitter.luminaire->type];
        const LuminousShape& shape = type.goniogram.shape;
        const glm::dvec3 centre(emitter.position), way = eye_.place() - centre;
        const double metres = type.metresPerUnit * glm::length(way);
        const glm::dvec3 local = glm::transpose(emitter.luminaire->axes) * glm::normalize(way);
        // Intensities of scenes are by the square of a scene unit.
        const double candela = luminanceOfRgb(emitter.intensity, photometric_) * type.goniogram.intensity(local) *
                               type.metresPerUnit * type.metresPerUnit;
        const double area = shape.projectedArea(local);
        if (!shape.hasArea())
            return leaveOut(emitter.id, "has no luminous area in its file, so that its luminance is not known");
        if (!(area > 0 && candela > 0)) return;
        Sums sums;
        for (const glm::dvec3& place : placesOn(shape))
            sums.add(eye_, centre + emitter.luminaire->axes * place / type.metresPerUnit,
                     area / (metres * metres) / placesOfLuminaire);
        add(sums, emitter.id, candela / area);
    }

    void addShape(const ShapeDescription& shape) {
        if (shape.emitter->alongNormal)
            return leaveOut(shape.id, "emits along its normal only, so that it has no luminance");
        if (shape.emitter->texture) return leaveOut(shape.id, "has a texture, so that its luminance varies over it");
        // A sphere is dark on the side that its normals turn away from.
        if (shape.sphere && isInside(*shape.sphere, eye_.place()) != shape.flipNormals) return;
        if (shape.sphere && shape.flipNormals)
            return leaveOut(shape.id, "surrounds the eye, so that it has no one position");
        Sums sums;
        if (shape.sphere)
            addSphere(sums, eye_, *shape.sphere);
        else
            addMesh(sums, eye_, shape.mesh);
        add(sums, shape.id, luminanceOfRgb(shape.emitter->radiance, photometric_));
    }

    GlareSources take() {
        std::sort(found_.seen.begin(), found_.seen.end(),
                  [](const GlareSource& a, const GlareSource& b) { return a.strength() > b.strength(); });
        return std::move(found_);
    }

private:
    void leaveOut(const std::string& name, const char* why) {
        found_.leftOut.push_back(fmt::format("'{}' {}.", name, why));
    }
    void add(const Sums& sums, const std::string& name, double luminance) {
        if (sums.weighted > 0 && luminance > 0) found_.seen.push_back(sums.source(name, luminance));
    }

    const Scene& scene_;
    Eye eye_;
    bool photometric_;
    GlareSources found_;
};

} // namespace

GlareSources glareSources(const Scene& scene, const Observer& observer, const Occlusion& occlusion, bool photometric) {
    Collector collector(scene, observer, occlusion, photometric);
    for (const PointEmitter& emitter : scene.pointEmitters) collector.addPoint(emitter);
    for (const ShapeDescription& shape : scene.shapes)
        if (shape.emitter) collector.addShape(shape);
    return collector.take();
}

} // namespace quasilux

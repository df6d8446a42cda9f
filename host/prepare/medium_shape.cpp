#include "prepare/medium_shape.h"

#include "prepare/bounding_sphere.h"
#include "prepare/pack.h"
#include "scene/box.h"
#include "scene/origin.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace quasilux {

namespace {

using std::numbers::pi;
constexpr double sameDirection = 1e-5; // sine between normals of one plane
constexpr double plateShare = 0.6;     // of the surface, in two parallel faces
constexpr size_t planesMax = 12;

struct Face {
    glm::dvec3 normal{};
    double offset = 0, area = 0;
};

// The planes of a mesh, by area; none where there are more than a polyhedron of few faces has.
std::vector<Face> facesOf(const Mesh& mesh, double size) {
    std::vector<Face> faces;
    for (const auto& t : mesh.triangles) {
        const glm::dvec3 a = mesh.positions[t.x], b = mesh.positions[t.y], c = mesh.positions[t.z];
        const glm::dvec3 doubled = glm::cross(b - a, c - a);
        const double area = 0.5 * glm::length(doubled);
        if (area == 0) continue;
        const Face face{glm::normalize(doubled), glm::dot(glm::normalize(doubled), a), area};
        const auto same = std::find_if(faces.begin(), faces.end(), [&](const Face& other) {
            return glm::length(other.normal - face.normal) < sameDirection &&
                   std::abs(other.offset - face.offset) < sameDirection * size;
        });
        if (same != faces.end())
            same->area += area;
        else if (faces.size() == planesMax)
            return {};
        else
            faces.push_back(face);
    }
    return faces;
}

// By the divergence theorem; negative where the normals point inwards.
double enclosedVolume(const Mesh& mesh) {
    double six = 0;
    for (const auto& t : mesh.triangles) {
        const glm::dvec3 a = mesh.positions[t.x], b = mesh.positions[t.y], c = mesh.positions[t.z];
        six += glm::dot(a, glm::cross(b, c));
    }
    return six / 6;
}

/// What surfaces go round together. Those that are not closed by themselves may be so together, as six rectangles are;
/// or else, as the surface of a pool, they say nothing of how deep the medium is.
class EnclosedVolume {
public:
    void add(const ShapeDescription& shape) {
        if (shape.sphere) {
            closed_ += 4.0 / 3 * pi * std::pow(double(shape.sphere->radius), 3);
            return;
        }
        glm::dvec3 vectorArea{0};
        double area = 0;
        for (const auto& t : shape.mesh.triangles) {
            const glm::dvec3 a = shape.mesh.positions[t.x], b = shape.mesh.positions[t.y],
                             c = shape.mesh.positions[t.z];
            vectorArea += glm::cross(b - a, c - a);
            area += glm::length(glm::cross(b - a, c - a));
        }
        const double volume = enclosedVolume(shape.mesh);
        if (glm::length(vectorArea) < sameDirection * area) {
            closed_ += std::abs(volume);
            return;
        }
        openVectorArea_ += vectorArea;
        openArea_ += area;
        openVolume_ += volume;
    }
    /// `extent`: of the surfaces. Where they are open, that of a cube as wide.
    double value(double extent) const {
        const bool isOpen = glm::length(openVectorArea_) >= sameDirection * openArea_ && openArea_ > 0;
        return closed_ + (isOpen ? extent * extent * extent : std::abs(openVolume_));
    }

private:
    double closed_ = 0, openVolume_ = 0, openArea_ = 0;
    glm::dvec3 openVectorArea_{0};
};

// All corners on the inner side of all planes, and the surface closed: then its faces' vector areas add up to nothing.
bool isConvexPolyhedron(const Mesh& mesh, const std::vector<Face>& faces, double size) {
    glm::dvec3 vectorArea{0};
    double area = 0;
    for (const auto& face : faces) {
        vectorArea += face.area * face.normal;
        area += face.area;
        for (const auto& p : mesh.positions)
            if (glm::dot(face.normal, glm::dvec3(p)) > face.offset + sameDirection * size) return false;
    }
    return faces.size() >= 4 && glm::length(vectorArea) < sameDirection * area && enclosedVolume(mesh) > 0;
}

bool isEmptyInside(const Scene& scene, const ShapeDescription& own) {
    const Box box = boxOf(own);
    const double margin = 1e-6 * box.diagonal();
    const auto reachesInto = [&](const Box& its) {
        return glm::all(glm::lessThan(its.lower + margin, box.upper)) &&
               glm::all(glm::lessThan(box.lower + margin, its.upper));
    };
    const auto world = scene.worldShapes();
    return std::none_of(world.begin(), world.end(),
                        [&](const auto& other) { return &other != &own && reachesInto(boxOf(other)); }) &&
           std::none_of(scene.instances.begin(), scene.instances.end(),
                        [&](const Instance& instance) { return reachesInto(boxOf(scene, instance)); });
}

void findPlate(const std::vector<Face>& faces, const Box& box, MediumShape& shape) {
    double total = 0, largest = 0;
    for (const auto& face : faces) total += face.area;
    for (const auto& face : faces)
        for (const auto& opposite : faces) {
            if (glm::length(face.normal + opposite.normal) > sameDirection) continue;
            const double area = face.area + opposite.area, thickness = face.offset + opposite.offset;
            if (area < plateShare * total || area <= largest || thickness <= 0 || thickness > 0.5 * box.diagonal())
                continue;
            largest = area;
            shape.isPlate = true;
            shape.axis = face.normal;
            shape.thickness = thickness;
        }
}

void addPlanes(const std::vector<Face>& faces, MediumShape& shape) {
    for (const auto& face : faces)
        shape.planes.push_back(
            {{static_cast<float>(face.normal.x), static_cast<float>(face.normal.y), static_cast<float>(face.normal.z)},
             static_cast<float>(face.offset)});
}

} // namespace

MediumShape findMediumShape(const Scene& scene, unsigned medium) {
    MediumShape shape;
    Box box;
    const ShapeDescription* only = nullptr;
    size_t boundaries = 0;
    EnclosedVolume volume;
    for (const auto& candidate : scene.shapes) {
        if (candidate.interior == candidate.exterior) continue; // it goes on behind the surface
        boundaries += candidate.interior == medium || candidate.exterior == medium;
        if (candidate.interior != medium) continue;
        box.add(boxOf(candidate));
        only = &candidate;
        volume.add(candidate);
    }
    if (!only) {
        const Sphere bounds = boundingSphere(scene);
        shape.volume = 4.0 / 3 * pi * std::pow(double(bounds.radius), 3);
        shape.extent = 2 * double(bounds.radius);
        shape.isUnbounded = true;
        return shape;
    }
    const glm::dvec3 sides = box.extent();
    shape.extent = std::max({sides.x, sides.y, sides.z});
    shape.volume = volume.value(shape.extent);
    if (boundaries != 1 || only->sphere) return shape;
    const auto faces = facesOf(only->mesh, shape.extent);
    if (!isConvexPolyhedron(only->mesh, faces, shape.extent)) return shape;
    findPlate(faces, box, shape);
    if (isEmptyInside(scene, *only)) addPlanes(faces, shape);
    return shape;
}

} // namespace quasilux

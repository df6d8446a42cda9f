#include "bench/parts/growth_scene.h"

#include "scene/bsdfs/bsdf_plugin.h"
#include "scene/shapes/mesh_builder.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace quasilux {

namespace {

using std::numbers::pi;
constexpr int wall = 0, shiny = 1, passing = 2; // places in Scene::bsdfs

void addBsdfs(Scene& scene) {
    const auto lambert = [](const Rgb& reflectance) {
        return makeLobe(LOBE_LAMBERT, "diffuse", reflectance, lambertHalfWidth);
    };
    constexpr float exponent = 1000;
    LobeDescription lobe = makeLobe(LOBE_PHONG, "specular", Rgb{0.025f, 0.25f, 0.025f}, phongHalfWidth(exponent));
    lobe.device.exponent = exponent;
    scene.bsdfs.resize(3);
    scene.bsdfs[wall].id = "wall";
    scene.bsdfs[wall].front = {lambert({0.5f, 0.5f, 0.5f})};
    scene.bsdfs[shiny].id = "shiny";
    scene.bsdfs[shiny].front = {lambert({0.5f, 0, 0}), lobe};
    scene.bsdfs[passing].id = "passing";
    scene.bsdfs[passing].isNull = true;
}

ShapeDescription& addRectangle(Scene& scene, const std::string& id, const glm::vec3& corner, const glm::vec3& u,
                               const glm::vec3& v, int bsdf) {
    ShapeDescription& shape = scene.shapes.emplace_back();
    shape.id = id;
    shape.plugin = "rectangle";
    shape.bsdf = bsdf;
    shape.mesh.positions = {corner, corner + u, corner + u + v, corner + v};
    shape.mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    shape.rectangle = RectangleFrame{corner, u, v, glm::normalize(glm::cross(u, v))};
    return shape;
}

void addBox(Scene& scene) {
    const glm::vec3 x(2, 0, 0), y(0, 2, 0), z(0, 0, 2), low(-1);
    addRectangle(scene, "floor", low, z, x, wall);
    addRectangle(scene, "ceiling", low + y, x, z, wall);
    addRectangle(scene, "back", low, x, y, wall);
    addRectangle(scene, "left", low, y, z, wall);
    addRectangle(scene, "right", low + x, z, y, wall);
    const glm::vec3 corner(-0.25f, 0.99f, -0.25f);
    addRectangle(scene, "light", corner, {0, 0, 0.5f}, {0.5f, 0, 0}, passing).emitter.emplace().radiance = {100, 100,
                                                                                                            100};
}

/// Latitudes and longitudes, poles included; `rings` bands of 2 * rings quadrilaterals.
MeshSource bumpySphere(unsigned rings) {
    const unsigned segments = 2 * rings;
    MeshSource source;
    for (unsigned j = 0; j <= rings; ++j)
        for (unsigned i = 0; i < segments; ++i) {
            const double theta = pi * j / rings, phi = 2 * pi * i / segments;
            const double radius = 0.6 * (1 + 0.03 * std::sin(6 * phi) * std::sin(theta) * std::sin(5 * theta));
            source.positions.push_back(
                radius * glm::dvec3(std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi)));
        }
    // All points of a pole's row are one vertex.
    const auto corner = [&](unsigned j, unsigned i) {
        const unsigned index = j == 0 || j == rings ? j * segments : j * segments + i % segments;
        return MeshSource::Corner{index, QL_NONE, QL_NONE, index};
    };
    for (unsigned j = 0; j < rings; ++j)
        for (unsigned i = 0; i < segments; ++i) {
            if (j > 0) source.triangles.push_back({corner(j, i), corner(j, i + 1), corner(j + 1, i + 1)});
            if (j + 1 < rings) source.triangles.push_back({corner(j, i), corner(j + 1, i + 1), corner(j + 1, i)});
        }
    return source;
}

void addSphere(Scene& scene, unsigned triangles) {
    // 2 * rings * segments triangles, less a row at each pole.
    const auto rings = static_cast<unsigned>(std::lround(0.5 * (1 + std::sqrt(1.0 + triangles))));
    ShapeDescription& shape = scene.shapes.emplace_back();
    shape.id = "bumpy";
    shape.plugin = "ply";
    shape.bsdf = shiny;
    shape.mesh = fileMesh(bumpySphere(std::max(3u, rings)), glm::dmat4(1), false, false, {});
}

void addCamera(Scene& scene, unsigned resolution) {
    Sensor& sensor = scene.sensor;
    // From (0, 0, 3.9) towards -z; Mitsuba's cameras look along their +z, with +x to the left.
    sensor.toWorld =
        glm::dmat4(glm::dvec4(-1, 0, 0, 0), glm::dvec4(0, 1, 0, 0), glm::dvec4(0, 0, -1, 0), glm::dvec4(0, 0, 3.9, 1));
    sensor.fovX = 39.3077 * pi / 180;
    sensor.width = sensor.height = sensor.filmWidth = sensor.filmHeight = resolution;
    sensor.filter = FILTER_BOX;
    sensor.filterRadius = 0.5;
}

} // namespace

Scene growthScene(unsigned triangles, unsigned resolution) {
    Scene scene;
    scene.path = "made in code";
    addBsdfs(scene);
    addBox(scene);
    addSphere(scene, triangles);
    addCamera(scene, resolution);
    return scene;
}

} // namespace quasilux

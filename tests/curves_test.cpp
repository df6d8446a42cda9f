// Tubes about curves: how far their meshes are from the surfaces that they stand for.
#include "scene/scene.h"

#include "support/scene_files.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>
#include <random>

namespace quasilux {
namespace {

using test::expectNear;
using test::SceneFiles;
using test::sceneWith;

glm::vec3 faceNormal(const Mesh& mesh, size_t triangle) {
    const glm::uvec3 t = mesh.triangles.at(triangle);
    const glm::vec3 a = mesh.positions.at(t.x);
    return glm::normalize(glm::cross(mesh.positions.at(t.y) - a, mesh.positions.at(t.z) - a));
}

Mesh curveMesh(const std::string& plugin, const std::string& points, const std::string& parameters = "") {
    SceneFiles files;
    files.write("curve.txt", points);
    const std::string shape =
        "<shape type=\"" + plugin + "\"><string name=\"filename\" value=\"curve.txt\"/>" + parameters + "</shape>";
    return loadScene(files.write("scene.xml", sceneWith(shape))).shapes.at(0).mesh;
}
double areaOf(const Mesh& mesh) {
    double area = 0;
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::dvec3 a = mesh.positions.at(t.x), b = mesh.positions.at(t.y), c = mesh.positions.at(t.z);
        area += glm::length(glm::cross(b - a, c - a)) / 2;
    }
    return area;
}
/// Corners, and middles of sides and of the whole, of all triangles.
std::vector<glm::dvec3> placesOn(const Mesh& mesh) {
    std::vector<glm::dvec3> places;
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::dvec3 a = mesh.positions.at(t.x), b = mesh.positions.at(t.y), c = mesh.positions.at(t.z);
        places.insert(places.end(), {a, (a + b) / 2.0, (b + c) / 2.0, (c + a) / 2.0, (a + b + c) / 3.0});
    }
    return places;
}

std::string fileOf(const std::vector<glm::dvec4>& points) {
    std::string text;
    for (const glm::dvec4& p : points) text += fmt::format("{} {} {} {}\n", p.x, p.y, p.z, p.w);
    return text;
}

/// Of a tube about a helix; the radius goes as 0.1 + 0.02 cos.
struct Helix {
    static constexpr int count = 24;
    std::vector<glm::dvec4> points; ///< and radius
    Helix() {
        for (int k = 0; k < count; ++k)
            points.emplace_back(std::cos(0.6 * k), std::sin(0.6 * k), 0.15 * k, 0.1 + 0.02 * std::cos(0.5 * k));
    }
    /// Of the uniform cubic B-spline, by its blending functions; t counts segments. `order`: of the derivative.
    glm::dvec4 at(double t, int order) const {
        const int k = std::min(int(t), count - 4);
        const double u = t - k, v = 1 - u;
        const double weights[3][4] = {{v * v * v / 6, (3 * u * u * u - 6 * u * u + 4) / 6,
                                       (-3 * u * u * u + 3 * u * u + 3 * u + 1) / 6, u * u * u / 6},
                                      {-v * v / 2, (3 * u * u - 4 * u) / 2, (-3 * u * u + 2 * u + 1) / 2, u * u / 2},
                                      {v, 3 * u - 2, -3 * u + 1, u}};
        glm::dvec4 sum(0);
        for (int i = 0; i < 4; ++i) sum += weights[order][i] * points.at(size_t(k + i));
        return sum;
    }
    /// How far outside of the tube a place is, by the nearest point of the axis.
    double distance(const glm::dvec3& place) const {
        const auto to = [&](double t) { return glm::length(place - glm::dvec3(at(t, 0))); };
        constexpr int steps = 400;
        double nearest = 0;
        for (int i = 0; i <= steps; ++i)
            if (const double t = double(i) * (count - 3) / steps; to(t) < to(nearest)) nearest = t;
        double low = std::max(nearest - 0.1, 0.0), high = std::min(nearest + 0.1, double(count - 3));
        for (int i = 0; i < 40; ++i) {
            const double a = low + (high - low) / 3, b = high - (high - low) / 3;
            (to(a) < to(b) ? high : low) = to(a) < to(b) ? b : a;
        }
        return to(low) - at(low, 0).w;
    }
    double area() const {
        constexpr int alongSteps = 2000, roundSteps = 32;
        double sum = 0;
        for (int i = 0; i < alongSteps; ++i) {
            const double t = (i + 0.5) * (count - 3) / alongSteps;
            const glm::dvec4 place = at(t, 0), slope = at(t, 1);
            const glm::dvec3 velocity = slope, bend = at(t, 2);
            const double speed = glm::length(velocity);
            const glm::dvec3 axis = velocity / speed, turn = (bend - glm::dot(bend, axis) * axis) / speed;
            const glm::dvec3 x = glm::normalize(glm::cross(axis, glm::dvec3(0, 0, 1))), y = glm::cross(axis, x);
            for (int k = 0; k < roundSteps; ++k) {
                const double angle = 2 * std::numbers::pi * k / roundSteps;
                const double along = speed - place.w * glm::dot(turn, std::cos(angle) * x + std::sin(angle) * y);
                sum += place.w * std::hypot(along, slope.w);
            }
        }
        return sum * 2 * std::numbers::pi / roundSteps * (count - 3) / alongSteps;
    }
};

// The bounds that docs/reference/scene-language.md states.
TEST(Curves, ASplineKeepsToItsTube) {
    const Helix helix;
    const Mesh mesh = curveMesh("bsplinecurve", fileOf(helix.points));
    EXPECT_NEAR(areaOf(mesh) / helix.area(), 1, 0.002);
    double least = 0, most = 0;
    for (const glm::dvec3& place : placesOn(mesh)) {
        least = std::min(least, helix.distance(place));
        most = std::max(most, helix.distance(place));
    }
    constexpr double radius = 0.12;
    EXPECT_GT(least, -0.007 * radius);
    EXPECT_LT(most, 0.005 * radius);
    // A tube 2 % thicker is found out.
    Helix thick;
    for (glm::dvec4& point : thick.points) point.w *= 1.02;
    double within = 0;
    for (const glm::dvec3& place : placesOn(mesh)) within = std::min(within, thick.distance(place));
    EXPECT_LT(within, -0.007 * radius);
    EXPECT_GT(std::abs(areaOf(mesh) / thick.area() - 1), 0.002);
}

// A cone of slope 1/10.
TEST(Curves, NormalsLeanWithTheRadius) {
    const Mesh mesh = curveMesh("bsplinecurve", "0 0 0 0.5\n0 0 1 0.4\n0 0 2 0.3\n0 0 3 0.2\n");
    ASSERT_EQ(mesh.cornerNormals.size(), 3 * mesh.triangles.size());
    for (size_t t = 0; t < mesh.triangles.size(); ++t)
        for (glm::length_t k = 0; k < 3; ++k) {
            const glm::vec3 p = mesh.positions.at(mesh.triangles[t][k]);
            const glm::vec3 normal = glm::normalize(glm::vec3(glm::normalize(glm::vec2(p)), 0.1f));
            expectNear(mesh.cornerNormals[3 * t + size_t(k)], normal, 1e-5f);
            EXPECT_GT(glm::dot(faceNormal(mesh, t), normal), 0.99f);
        }
    const Mesh flipped = curveMesh("bsplinecurve", "0 0 0 0.5\n0 0 1 0.4\n0 0 2 0.3\n0 0 3 0.2\n",
                                   "<boolean name=\"flip_normals\" value=\"true\"/>");
    EXPECT_LT(glm::dot(faceNormal(flipped, 0), faceNormal(mesh, 0)), -0.99f);
}

// As in Mitsuba, transforms move the points and leave the radii.
TEST(Curves, RadiiAreNotTransformed) {
    const Mesh mesh = curveMesh("linearcurve",
                                "\xef\xbb\xbf"
                                "0 0 0 0.5\n0 0 1 0.5\n",
                                "<transform name=\"to_world\"><scale value=\"3\"/></transform>");
    float top = 0, out = 0;
    for (const glm::vec3& p : mesh.positions) {
        top = std::max(top, p.z);
        out = std::max(out, p.x);
    }
    EXPECT_NEAR(top, 3.5f, 1e-5f);
    EXPECT_NEAR(out, 0.5f, 0.5f * 0.0017f);
    EXPECT_NEAR(areaOf(mesh) / (2 * std::numbers::pi * 0.5 * 3 + 4 * std::numbers::pi * 0.25), 1, 0.003);
}

/// Distance from the union of all balls between the control points, x y z radius.
double distanceFromBalls(const std::vector<glm::dvec4>& points, const glm::dvec3& place) {
    double distance = 1e9;
    for (size_t k = 0; k + 1 < points.size(); ++k) {
        const auto at = [&](double t) {
            const glm::dvec4 ball = (1 - t) * points[k] + t * points[k + 1];
            return glm::length(place - glm::dvec3(ball)) - ball.w;
        };
        double low = 0, high = 1; // it is convex in t
        for (int i = 0; i < 60; ++i) {
            const double a = low + (high - low) / 3, b = high - (high - low) / 3;
            (at(a) < at(b) ? high : low) = at(a) < at(b) ? b : a;
        }
        distance = std::min(distance, at(low));
    }
    return distance;
}

// Every ray from outside meets the mesh where it meets the balls: nothing is missing at joints, and nothing stands out.
TEST(Curves, APolylineIsTheUnionOfItsBalls) {
    const std::vector<glm::dvec4> points = {
        {0, 0, 0, .15}, {0, .3, 1, .2}, {1, .2, 1.2, .1}, {1.2, 1, .9, .25}, {0.4, .9, .3, .1}};
    const Mesh mesh = curveMesh("linearcurve", fileOf(points));
    constexpr double tolerance = 0.007 * 0.25;
    for (const glm::dvec3& place : placesOn(mesh)) EXPECT_LT(distanceFromBalls(points, place), tolerance);
    std::mt19937 random(1);
    std::normal_distribution<double> normal;
    std::vector<glm::dvec4> thick = points;
    for (glm::dvec4& point : thick) point.w *= 1.02;
    int hits = 0, found = 0;
    for (int ray = 0; ray < 300; ++ray) {
        const glm::dvec3 centre(.5, .5, .6), side(normal(random), normal(random), normal(random));
        const glm::dvec3 origin = centre + 4.0 * glm::normalize(side);
        const glm::dvec3 aim = centre + 0.5 * glm::dvec3(normal(random), normal(random), normal(random));
        const glm::dvec3 d = glm::normalize(aim - origin);
        double t = 0, closest = 1;
        for (double step = 1; step > 1e-6 && t < 10; t += step)
            closest = std::min(closest, step = distanceFromBalls(points, origin + t * d));
        double nearest = 1e9; // on the mesh
        for (const glm::uvec3& corner : mesh.triangles) {
            const glm::dvec3 a = mesh.positions[corner.x], e1 = glm::dvec3(mesh.positions[corner.y]) - a,
                             e2 = glm::dvec3(mesh.positions[corner.z]) - a;
            const glm::dvec3 p = glm::cross(d, e2), s = origin - a, q = glm::cross(s, e1);
            const double det = glm::dot(e1, p), u = glm::dot(s, p) / det, v = glm::dot(d, q) / det;
            if (u >= 0 && v >= 0 && u + v <= 1) nearest = std::min(nearest, glm::dot(e2, q) / det);
        }
        if (t < 10) hits += 1;
        if (nearest < 1e8) {
            EXPECT_NEAR(distanceFromBalls(points, origin + nearest * d), 0, tolerance) << ray;
            found += std::abs(distanceFromBalls(thick, origin + nearest * d)) > tolerance;
        } else if (t < 10) { // it may only have grazed them
            EXPECT_GT(distanceFromBalls(points, origin + (t + 0.05) * d), -tolerance) << ray;
        }
    }
    EXPECT_GT(hits, 50);
    EXPECT_GT(found, 50); // balls 2 % larger
}

TEST(Curves, BoundNoMedia) {
    SceneFiles files;
    files.write("curve.txt", "0 0 0 1\n0 0 1 1\n");
    const std::string shape = "<shape type=\"linearcurve\"><string name=\"filename\" value=\"curve.txt\"/>\n<medium "
                              "type=\"homogeneous\" name=\"interior\"/></shape>";
    EXPECT_NE(test::errorOf(files.write("scene.xml", sceneWith(shape)))
                  .find("scene.xml:5:1: shape 'linearcurve' bounds no medium; use another shape."),
              std::string::npos);
}

} // namespace
} // namespace quasilux

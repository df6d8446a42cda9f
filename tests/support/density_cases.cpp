#include "support/density_cases.h"

#include "support/border_scenes.h"

#include <cmath>

namespace quasilux {

namespace {

using Outline = std::vector<dvec3>;

void addObstacles(DensityCase& c, const Outline& corners) {
    for (size_t k = 0; k < corners.size(); ++k) c.obstacles.emplace_back(corners[k], corners[(k + 1) % corners.size()]);
}

/// The floor [-3, 3]^2 at z = 0 with primitives 0 and 1, and a point on it.
DensityCase onFloor(const std::string& name, dvec3 position, double kept) {
    DensityCase c;
    c.name = name;
    addPlane(c.scene, {-3, -3, 0}, {6, 0, 0}, {0, 6, 0});
    addObstacles(c, {{-3, -3, 0}, {3, -3, 0}, {3, 3, 0}, {-3, 3, 0}});
    c.position = position;
    c.primitive = position.y > position.x ? 1 : 0;
    c.kept = kept;
    return c;
}

/// Cuboid from `lower` to `upper`; hides the photons of the floor below it if `hides`, and of its own part below.
void addBox(DensityCase& c, dvec3 lower, dvec3 upper, bool hides = true) {
    addCube(c.scene, glm::scale(glm::translate(glm::dmat4(1), 0.5 * (lower + upper)), 0.5 * (upper - lower)));
    addObstacles(c, {{lower.x, lower.y, 0}, {upper.x, lower.y, 0}, {upper.x, upper.y, 0}, {lower.x, upper.y, 0}});
    if (!hides) return;
    c.hidden = [lower, upper, before = c.hidden](dvec3 p, unsigned primitive) {
        const bool below = p.z < 1e-6 && p.x > lower.x && p.x < upper.x && p.y > lower.y && p.y < upper.y;
        return p.z < -1e-6 || below || (before && before(p, primitive));
    };
}

DensityCase lShaped(const std::string& name, dvec3 position, double kept) {
    DensityCase c;
    c.name = name;
    const Outline corners{{-3, -3, 0}, {3, -3, 0}, {3, 0, 0}, {0, 0, 0}, {0, 3, 0}, {-3, 3, 0}};
    addMesh(c.scene, corners, {{0, 1, 3}, {1, 2, 3}, {0, 3, 5}, {3, 4, 5}});
    addObstacles(c, corners);
    c.position = position;
    c.kept = kept;
    return c;
}

DensityCase onRoundTable(unsigned pieces, double fromCenter, double kept) {
    DensityCase c;
    c.name =
        "round table, " + std::to_string(pieces) + " edges, point " + std::to_string(fromCenter) + " from its centre";
    Outline rim;
    std::vector<dvec3> positions{{0, 0, 0}};
    std::vector<glm::uvec3> triangles;
    for (unsigned k = 0; k < pieces; ++k) {
        rim.push_back(1.5 * dvec3(std::cos(2 * pi * k / pieces), std::sin(2 * pi * k / pieces), 0));
        triangles.push_back({0, 1 + k, 1 + (k + 1) % pieces});
    }
    positions.insert(positions.end(), rim.begin(), rim.end());
    addMesh(c.scene, positions, triangles);
    addObstacles(c, rim);
    c.position = fromCenter * dvec3(std::cos(0.3), std::sin(0.3), 0);
    c.kept = kept;
    return c;
}

/// Two quads to the right of x = 0 against one to the left: three vertices on one side of the line, two on the other.
DensityCase atTJunction() {
    DensityCase c;
    c.name = "T-junction";
    addPlane(c.scene, {-3, -3, 0}, {3, 0, 0}, {0, 6, 0});
    addPlane(c.scene, {0, -3, 0}, {3, 0, 0}, {0, 3, 0});
    addPlane(c.scene, {0, 0, 0}, {3, 0, 0}, {0, 3, 0});
    addObstacles(c,
                 {{-3, -3, 0}, {0, -3, 0}, {0, 3, 0}, {-3, 3, 0}}); // light may pass, but the estimate looks no further
    c.position = {-0.2, 0.1, 0};
    c.primitive = 1;
    c.kept = 0.93;
    return c;
}

void addFreePlanes(std::vector<DensityCase>& cases) {
    cases.push_back(onFloor("whole disc", {0.1, 0.2, 0}, 1));
    for (const double h : {0.9, 0.5, 0.2, 0.05, 1e-3})
        cases.push_back(onFloor("half plane at " + std::to_string(h), {3 - h, 0.3, 0}, 0.94));
    cases.push_back(onFloor("corner", {2.7, -2.8, 0}, 0.92));
    cases.push_back(onFloor("corner at 0.01", {2.99, 2.995, 0}, 0.88));
    cases.push_back(lShaped("reentrant corner, diagonal", {-0.2, -0.25, 0}, 0.95));
    cases.push_back(lShaped("reentrant corner, along a side", {0.3, -0.05, 0}, 0.95));
    cases.push_back(atTJunction());
    cases.push_back(onRoundTable(1000, 1.2, 0.95));
    cases.push_back(onRoundTable(1000, 1.499, 0.92));
    cases.push_back(onRoundTable(17, 1.1, 0.95));
}

void addContacts(std::vector<DensityCase>& cases) {
    for (const double h : {0.4, 0.1, 0.01, 1e-4}) {
        cases.push_back(onFloor("foot of a box at " + std::to_string(h), {0.5 + h, 0.3, 0}, 0.93));
        addBox(cases.back(), {-0.5, -0.8, 0}, {0.5, 0.8, 1});
    }
    cases.push_back(onFloor("corner of a box", {0.6, 0.85, 0}, 0.95));
    addBox(cases.back(), {-0.5, -0.8, 0}, {0.5, 0.8, 1});
    cases.push_back(onFloor("box sunk into the floor", {0.55, 0.3, 0}, 0.93));
    addBox(cases.back(), {-0.5, -0.8, -0.5}, {0.5, 0.8, 1});
    cases.push_back(onFloor("a box before another", {0.7, 0, 0}, 0.93));
    addBox(cases.back(), {-0.2, -0.2, 0}, {0.5, 0.2, 1});
    addBox(cases.back(), {-0.8, -0.7, 0}, {-0.3, 0.7, 1});
    cases.push_back(onFloor("slab just above the floor", {0.6, 0.1, 0}, 0.93)); // cuts, though light may come below it
    addBox(cases.back(), {-0.5, -0.8, 0.02}, {0.5, 0.8, 1}, false);
    cases.push_back(onFloor("slab above the floor", {0.6, 0.1, 0}, 1)); // too high to cut
    addBox(cases.back(), {-0.5, -0.8, 0.2}, {0.5, 0.8, 1}, false);
    cases.back().obstacles.resize(4);
}

void addWalls(std::vector<DensityCase>& cases) {
    cases.push_back(onFloor("fin that ends in the disc", {0.1, 0.3, 0}, 0.92));
    addPlane(cases.back().scene, {0, 0, 0}, {0, 2, 0}, {0, 0, 1});
    cases.back().obstacles.emplace_back(dvec3(0, 0, 0), dvec3(0, 2, 0));
    cases.push_back(onFloor("fin that points at the point", {0, -0.4, 0}, 0.95));
    addPlane(cases.back().scene, {0.001, 0, 0}, {0, 2, 0}, {0, 0, 1});
    cases.back().obstacles.emplace_back(dvec3(0.001, 0, 0), dvec3(0.001, 2, 0));
    cases.push_back(onFloor("corner of a room", {2.8, 2.6, 0}, 0.92));
    addPlane(cases.back().scene, {3, -3, 0}, {0, 0, 3}, {0, 6, 0});
    addPlane(cases.back().scene, {-3, 3, 0}, {6, 0, 0}, {0, 0, 3});

    DensityCase side; // a point on the side of a box, just above the floor
    side.name = "side of a box at its foot";
    addPlane(side.scene, {-3, -3, 0}, {6, 0, 0}, {0, 6, 0});
    addPlane(side.scene, {0.5, -0.8, 0}, {0, 1.6, 0}, {0, 0, 2});
    addObstacles(side, {{0.5, -0.8, 0}, {0.5, 0.8, 0}, {0.5, 0.8, 2}, {0.5, -0.8, 2}});
    side.position = {0.5, 0.1, 0.02};
    side.normal = {1, 0, 0};
    side.primitive = 2;
    side.kept = 0.91;
    cases.push_back(side);
}

} // namespace

std::vector<DensityCase> densityCases() {
    std::vector<DensityCase> cases;
    addFreePlanes(cases);
    addContacts(cases);
    addWalls(cases);
    return cases;
}

DensityCase moved(DensityCase c, const glm::dmat3& rotation, double scale, dvec3 offset) {
    const auto move = [&](dvec3 p) { return scale * (rotation * p) + offset; };
    for (ShapeDescription& shape : c.scene.shapes)
        for (glm::vec3& p : shape.mesh.positions) p = glm::vec3(move(dvec3(p)));
    c.position = move(c.position);
    c.normal = rotation * c.normal;
    for (auto& [a, b] : c.obstacles) {
        a = move(a);
        b = move(b);
    }
    if (c.hidden)
        c.hidden = [=, before = c.hidden](dvec3 p, unsigned primitive) {
            return before(glm::transpose(rotation) * ((p - offset) / scale), primitive);
        };
    return c;
}

RegionQuery queryOf(const DensityCase& c, double radius) {
    const auto pack = [](dvec3 v) { return shared::Packed3{float(v.x), float(v.y), float(v.z)}; };
    return {pack(c.position), pack(c.normal), c.primitive, float(radius)};
}

} // namespace quasilux

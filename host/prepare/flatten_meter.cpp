// What a meter measures on, as the kernels draw points of it and find crossings (kernels/meter_surface.clh).
#include "prepare/device_scene.h"
#include "prepare/pack.h"

#include <cmath>
#include <numbers>

namespace quasilux {

namespace {

using std::numbers::pi;

using Primitives = std::vector<shared::MeterPrimitive>;

shared::MeterPrimitive flatPiece(unsigned type, glm::dvec3 p0, glm::dvec3 e1, glm::dvec3 e2, float sign) {
    shared::MeterPrimitive piece{};
    piece.type = type;
    piece.p0 = pack(p0);
    piece.e1 = pack(e1);
    piece.e2 = pack(e2);
    piece.sign = sign;
    piece.areaCdf = 1;
    return piece;
}

// Mitsuba's rectangle is a parallelogram once transformed; its corners keep their order when the winding turns.
double addRectangle(const Mesh& mesh, Primitives& pieces) {
    const glm::dvec3 p0 = mesh.positions[0], e1 = glm::dvec3(mesh.positions[1]) - p0,
                     e2 = glm::dvec3(mesh.positions[3]) - p0;
    const glm::uvec3 t = mesh.triangles[0];
    const glm::dvec3 a = mesh.positions[t.x];
    const glm::dvec3 front = glm::cross(glm::dvec3(mesh.positions[t.y]) - a, glm::dvec3(mesh.positions[t.z]) - a);
    const glm::dvec3 normal = glm::cross(e1, e2);
    pieces.push_back(flatPiece(METER_PARALLELOGRAM, p0, e1, e2, glm::dot(front, normal) < 0 ? -1.f : 1.f));
    return glm::length(normal);
}

double addMesh(const Mesh& mesh, Primitives& pieces) {
    double area = 0;
    std::vector<double> sums;
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::dvec3 p0 = mesh.positions[t.x], e1 = glm::dvec3(mesh.positions[t.y]) - p0,
                         e2 = glm::dvec3(mesh.positions[t.z]) - p0;
        const double here = 0.5 * glm::length(glm::cross(e1, e2));
        if (!(here > 0)) continue;
        area += here;
        sums.push_back(area);
        pieces.push_back(flatPiece(METER_TRIANGLE, p0, e1, e2, 1));
    }
    for (size_t k = 0; k + 1 < pieces.size(); ++k) pieces[k].areaCdf = static_cast<float>(sums[k] / area);
    return area;
}

double addSphere(const ShapeDescription& shape, Primitives& pieces) {
    const glm::mat3 axes = glm::transpose(shape.sphere->toLocal); // columns: its own axes
    shared::MeterPrimitive piece{};
    piece.type = METER_SPHERE;
    piece.p0 = pack(shape.sphere->center);
    piece.e1 = pack(axes[0]);
    piece.e2 = pack(axes[1]);
    piece.e3 = pack(axes[2]);
    piece.radius = shape.sphere->radius;
    piece.sign = shape.flipNormals ? -1.f : 1.f;
    piece.areaCdf = 1;
    pieces.push_back(piece);
    return 4 * pi * double(piece.radius) * piece.radius;
}

double addPrimitives(const Scene& scene, Primitives& pieces) {
    const ShapeDescription& shape = scene.shapes.at(scene.sensor.meterShape);
    if (shape.sphere) return addSphere(shape, pieces);
    return shape.plugin == "rectangle" ? addRectangle(shape.mesh, pieces) : addMesh(shape.mesh, pieces);
}

std::vector<shared::MeterGrid> gridsOf(const Scene& scene, const std::vector<unsigned>& media) {
    std::vector<shared::MeterGrid> grids;
    unsigned first = 0;
    for (const IlluminanceGrid& grid : scene.grids) {
        const bool isCylindrical = grid.kind == IlluminanceKind::cylindrical;
        const double cellArea = glm::length(glm::cross(grid.edgeU, grid.edgeV)) / static_cast<double>(grid.points());
        shared::MeterGrid flat{};
        flat.plane = flatPiece(METER_PARALLELOGRAM, grid.origin, grid.edgeU, grid.edgeV, grid.flipNormals ? -1.f : 1.f);
        flat.firstPixel = first;
        flat.columns = grid.nx;
        flat.rows = grid.ny;
        flat.quantity = isCylindrical ? GRID_CYLINDRICAL : GRID_PLANAR;
        flat.medium = media.empty() ? MEDIUM_NONE : media[grids.size()];
        flat.height = static_cast<float>(grid.height);
        flat.inverseExtent = static_cast<float>(1 / (isCylindrical ? cellArea * grid.height : cellArea));
        first += static_cast<unsigned>(grid.points());
        grids.push_back(flat);
    }
    return grids;
}

unsigned kindOf(MeterKind meter) {
    switch (meter) {
    case MeterKind::ray:
        return METER_RAY;
    case MeterKind::area:
        return METER_AREA;
    case MeterKind::grid:
        return METER_GRID;
    case MeterKind::none:
        break;
    }
    return METER_NONE;
}

} // namespace

MeterTables flattenMeter(const Scene& scene, unsigned medium, const std::vector<unsigned>& gridMedia) {
    const Sensor& sensor = scene.sensor;
    MeterTables tables;
    auto& meter = tables.meter;
    meter.kind = kindOf(sensor.meter);
    meter.samples = 1;
    if (meter.kind == METER_NONE) return tables;
    meter.width = sensor.width;
    meter.height = sensor.height;
    meter.medium = medium;
    if (meter.kind == METER_RAY) return tables;
    if (meter.kind == METER_GRID) {
        tables.grids = gridsOf(scene, gridMedia);
        meter.primitiveCount = static_cast<unsigned>(tables.grids.size());
        return tables;
    }
    const double area = addPrimitives(scene, tables.primitives);
    meter.primitiveCount = static_cast<unsigned>(tables.primitives.size());
    meter.inverseArea = static_cast<float>(double(sensor.width) * sensor.height / area);
    return tables;
}

} // namespace quasilux

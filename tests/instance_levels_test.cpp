// Instances as a level of the tree against the same instances flattened, and against all triangles one by one.
#include "bench/micro/ray_types.h"
#include "photometry/occlusion.h"
#include "prepare/borders.h"
#include "render/aovs.h"
#include "support/density_scene.h"
#include "support/render_statistics.h"
#include "support/scene_files.h"
#include "support/test_kernels.h"

#include <cmath>
#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>
#include <map>
#include <random>

namespace quasilux {
namespace {

using glm::dvec3;

// A roof of two smooth sides with normals and texture coordinates of its own.
const char* const roof =
    "v -1 -1 0\nv 1 -1 0\nv 0 -1 1\nv -1 1 0\nv 1 1 0\nv 0 1 1\nvn -0.8 0 0.6\nvn 0.8 0 0.6\nvn 0 0 1\n"
    "vt 0 0\nvt 1 0\nvt 0 1\nvt 1 1\nf 1/1/1 3/2/3 6/4/3\nf 1/1/1 6/4/3 4/3/1\nf 3/1/3 2/2/2 5/4/2\n"
    "f 3/1/3 5/4/2 6/3/3\n";
const char* const bumps = "P3\n4 4\n255\n0 0 0 60 60 60 120 120 120 60 60 60\n30 30 30 90 90 90 150 150 150 90 90 90\n"
                          "60 60 60 120 120 120 180 180 180 120 120 120\n0 0 0 60 60 60 120 120 120 60 60 60\n";

const char* const turned = R"(<rotate x="1" y="2" z="3" angle="50"/><scale value="0.7"/><translate x="-2.2" z="1.2"/>)";
const char* const distorted = R"(<scale x="1.5" y="0.5" z="0.8"/><rotate y="1" angle="35"/><translate z="0.4"/>)";
const char* const mirrored =
    R"(<scale x="-0.8" y="0.8" z="0.8"/><rotate z="1" angle="20"/><translate x="2.3" z="0.6"/>)";
const char* const sunk = R"(<rotate x="1" angle="25"/><translate x="0.3" y="2.5" z="-0.1"/>)";

std::string instance(const std::string& group, const std::string& operations) {
    return "<shape type=\"instance\"><ref id=\"" + group + "\"/><transform name=\"to_world\">" + operations +
           "</transform></shape>";
}

/// What the scenes of this test have in common: a floor, a group of a mesh with relief, a mask and a one-sided cube,
/// and one of a sphere.
class TwoLevels {
public:
    explicit TwoLevels(bool hasRelief = true, const std::string& further = {}) {
        const std::string diffuse = R"(<bsdf type="diffuse"><texture type="checkerboard" name="reflectance"><transform
        name="to_uv"><scale value="4"/></transform></texture></bsdf>)",
                          bumped = R"(<bsdf type="bumpmap"><texture type="bitmap" name="any"><string name="filename"
        value="bumps.ppm"/><boolean name="raw" value="true"/></texture><float name="scale" value="0.2"/>)" +
                                   diffuse + "</bsdf>";
        files_.write("roof.obj", roof);
        files_.write("bumps.ppm", bumps);
        body_ =
            R"(<shape type="rectangle" id="floor"><transform name="to_world"><scale value="6"/></transform><bsdf type="diffuse"/></shape>
        <shape type="shapegroup" id="house"><shape type="obj"><string name="filename" value="roof.obj"/><transform name="to_world"><translate
        z="0.6"/></transform><bsdf type="twosided">)" +
            (hasRelief ? bumped : diffuse) + R"(</bsdf></shape>
        <shape type="cube"><transform name="to_world"><scale value="0.5"/></transform><bsdf type="diffuse"><rgb name="reflectance"
        value="0.7,0.3,0.1"/></bsdf></shape><shape type="rectangle"><transform name="to_world"><rotate x="1" angle="90"/><translate
        y="-1.2"/></transform><bsdf type="mask"><float name="opacity" value="0.5"/><bsdf type="twosided"><bsdf
        type="diffuse"/></bsdf></bsdf></shape></shape>
        <shape type="shapegroup" id="ball"><shape type="sphere"><float name="radius" value="0.6"/><bsdf type="diffuse"><texture
        type="checkerboard" name="reflectance"/></bsdf></shape></shape>)" +
            instance("house", turned) + instance("house", distorted) + instance("house", mirrored) +
            instance("house", sunk) +
            instance("ball", R"(<scale value="0.7"/><rotate x="1" angle="40"/><translate x="-1" y="-2.4" z="0.3"/>)") +
            instance("ball", R"(<scale x="-1"/><translate x="1.2" y="-2.4" z="0.6"/>)") + further +
            R"(<shape type="rectangle"><transform name="to_world"><scale value="0.7"/><rotate x="1" angle="180"/><translate
        z="5"/></transform><emitter type="area"/></shape>)";
    }

    Scene load(const std::string& levels, unsigned pixels = 48) const {
        return loadScene(files_.write(
            levels + ".xml",
            fmt::format(R"(<scene version="3.0.0"><?quasilux instances="{}"?><integrator type="aov"><string name="aovs"
        value="al:albedo,dd:depth,po:position,gn:geo_normal,sn:sh_normal,pi:prim_index,uv:uv,du:dp_du"/><integrator type="path"/></integrator>
        <sensor type="perspective"><float name="fov" value="50"/><transform name="to_world"><lookat origin="1,-8,5" target="0,0,0.5"
        up="0,0,1"/></transform><film type="hdrfilm"><rfilter type="box"/><integer name="width" value="{}"/><integer name="height"
        value="{}"/></film></sensor>{}</scene>)",
                        levels, pixels, pixels, body_)));
    }

private:
    test::SceneFiles files_;
    std::string body_;
};

Scene flattened(const TwoLevels& scenes) { return scenes.load("flattened"); }
Scene twoLevel(const TwoLevels& scenes) { return scenes.load("two-level"); }

TEST(InstanceLevels, AreThereWhereTheyAreAskedFor) {
    const TwoLevels scenes;
    EXPECT_TRUE(flattened(scenes).instances.empty());
    const Scene scene = twoLevel(scenes);
    EXPECT_EQ(scene.instances.size(), 6u);
    EXPECT_EQ(scene.groups.size(), 2u);
    EXPECT_EQ(scene.worldShapes().size(), 2u);
    EXPECT_EQ(scene.shapes.size(), 6u);
}

// One sample in the middle of each pixel: the same rays.
std::map<std::string, std::vector<float>> layersOf(const Scene& scene, const std::string& control = {}) {
    RenderSettings settings;
    settings.controlOptions = control;
    std::map<std::string, std::vector<float>> layers;
    for (const AovImage& layer : renderAovs(testDevice(), scene, settings, 1))
        for (size_t k = 0; k < layer.values.size(); ++k)
            layers[layer.channels[k % layer.channels.size()]].push_back(layer.values[k]);
    return layers;
}

/// Pixels that differ in any layer by more than rounding; a ray on an edge may go either way.
unsigned pixelsThatDiffer(const Scene& a, const Scene& b, const std::string& control = {}) {
    const auto of = layersOf(a), other = layersOf(b, control);
    EXPECT_EQ(of.size(), other.size());
    std::vector<bool> differs(of.begin()->second.size());
    for (const auto& [name, values] : of)
        for (size_t k = 0; k < values.size(); ++k)
            differs[k] = differs[k] || !(std::abs(values[k] - other.at(name)[k]) <= 2e-4 * (1 + std::abs(values[k])));
    return unsigned(std::count(differs.begin(), differs.end(), true));
}

TEST(InstanceLevels, CameraRaysMeetTheSame) {
    const TwoLevels scenes;
    const Scene flat = flattened(scenes), levels = twoLevel(scenes);
    const unsigned differing = pixelsThatDiffer(flat, levels);
    std::printf("%u of %u pixels differ\n", differing, 48 * 48);
    EXPECT_LE(differing, 4u);
    EXPECT_GT(pixelsThatDiffer(flat, levels, " -DNORMALS_AS_VECTORS"), 20u); // negative control: of one instance
}

/// As tests/kernels/instances.cl has it.
struct InstanceHit {
    float t;
    unsigned primitive, instance, patch;
    shared::Packed3 position, normal;
    unsigned isOccluded, returned;
};

std::vector<InstanceHit> meet(const DeviceScene& flat, const std::vector<MicroRay>& rays) {
    Program program = testProgram("instances.cl", flat.features.options() + ' ' + bvhOptions(flat.bvh));
    Buffer<shared::BvhNode> nodes(testDevice(), flat.bvh.nodes, "tree nodes");
    Buffer<shared::PrimitiveBlock> blocks(testDevice(), flat.bvh.blocks, "primitives");
    Buffer<uint32_t> tables(testDevice(), flat.tables, "scene tables");
    Buffer<MicroRay> rayBuffer(testDevice(), rays, "rays");
    Buffer<InstanceHit> hits(testDevice(), rays.size(), "hits");
    program.kernel("meetInstances")
        .launch(rays.size(), nodes, blocks, tables, flat.offsets, rayBuffer, hits, unsigned(rays.size()));
    return hits.read();
}

/// A triangle where it lies in the world.
struct WorldTriangle {
    dvec3 a, e1, e2;
    unsigned primitive, instance;
};

std::vector<WorldTriangle> trianglesOf(const Scene& scene) {
    std::vector<WorldTriangle> all;
    std::vector<unsigned> firstOfShape;
    unsigned primitive = 0;
    for (const ShapeDescription& shape : scene.shapes) {
        firstOfShape.push_back(primitive);
        primitive += shape.sphere ? 1 : unsigned(shape.mesh.triangles.size());
    }
    const auto add = [&](size_t index, const glm::dmat4& m, unsigned instance) {
        const ShapeDescription& shape = scene.shapes[index];
        for (size_t t = 0; t < shape.mesh.triangles.size(); ++t) {
            dvec3 p[3];
            for (int k = 0; k < 3; ++k) p[k] = m * glm::dvec4(shape.mesh.positions[shape.mesh.triangles[t][k]], 1);
            all.push_back({p[0], p[1] - p[0], p[2] - p[0], firstOfShape[index] + unsigned(t), instance});
        }
    };
    for (size_t k = 0; k < scene.worldShapes().size(); ++k) add(k, glm::dmat4(1), QL_NONE);
    for (unsigned k = 0; k < scene.instances.size(); ++k) {
        const ShapeGroup& group = scene.groups[scene.instances[k].group];
        for (unsigned s = 0; s < group.shapeCount; ++s)
            add(group.firstShape + s, glm::dmat4(scene.instances[k].toWorld), k);
    }
    return all;
}

/// How surely a ray meets a triangle: barycentric coordinates' distance from its edges, < 0 outside; `t` is where.
double surely(const WorldTriangle& triangle, const dvec3& o, const dvec3& d, double& t) {
    const dvec3 p = glm::cross(d, triangle.e2);
    const double det = glm::dot(triangle.e1, p);
    const dvec3 from = o - triangle.a, q = glm::cross(from, triangle.e1);
    const double u = glm::dot(from, p) / det, v = glm::dot(d, q) / det;
    t = glm::dot(triangle.e2, q) / det;
    return std::min({u, v, 1 - u - v});
}

/// Many instances, rotated, mirrored and distorted, some far away, some small; no spheres.
Scene scattered() {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> place(-6, 6), angle(0, 360), scale(0.1, 1.5);
    std::string further;
    for (int k = 0; k < 60; ++k)
        further += instance(
            "house",
            fmt::format(
                "<scale x=\"{}\" y=\"{}\" z=\"{}\"/><rotate x=\"{}\" y=\"0.3\" z=\"1\" angle=\"{}\"/><translate "
                "x=\"{}\" y=\"{}\" z=\"{}\"/>",
                (k % 3 ? 1 : -1) * scale(random), scale(random), scale(random), place(random), angle(random),
                place(random), place(random), place(random)));
    return twoLevel(TwoLevels(true, further));
}

TEST(InstanceLevels, RaysMeetTheNearestOfAllTriangles) {
    const Scene scene = scattered();
    const DeviceScene flat = flattenScene(scene);
    const auto triangles = trianglesOf(scene);
    const auto first = firstPatches(scene, findBorders(scene));
    std::mt19937 random(7);
    std::uniform_real_distribution<float> place(-9, 9), length(0.01f, 20);
    std::vector<MicroRay> rays(4000);
    for (MicroRay& ray : rays) {
        const glm::vec3 to(place(random), place(random), place(random));
        const glm::vec3 o(place(random), place(random), place(random)), d = glm::normalize(to - o);
        ray = {o, d, 0, length(random)};
    }
    const auto hits = meet(flat, rays);
    unsigned met = 0, onInstances = 0, wrong = 0, wrongOcclusion = 0, returned = 0;
    for (size_t k = 0; k < rays.size(); ++k) {
        const dvec3 o(rays[k].origin), d(rays[k].direction);
        const InstanceHit& hit = hits[k];
        double nearest = rays[k].tMax, named = -1, t = 0;
        for (const WorldTriangle& triangle : triangles) {
            const double inside = surely(triangle, o, d, t);
            if (inside > 1e-4 && t > 1e-4 && t < nearest) nearest = t;
            if (triangle.primitive == hit.primitive && triangle.instance == hit.instance && inside > -1e-4) named = t;
        }
        const bool isSphere = hit.primitive != QL_NONE && named < 0 && hit.instance != QL_NONE &&
                              scene.instances[hit.instance].group == 1;
        if (isSphere) continue; // those are held against flattened ones above
        met += hit.primitive != QL_NONE;
        onInstances += hit.primitive != QL_NONE && hit.instance != QL_NONE;
        const double tolerance = 1e-4 * (1 + nearest);
        wrong += hit.primitive == QL_NONE ? nearest < rays[k].tMax - tolerance
                                          : std::abs(named - hit.t) > tolerance || hit.t > nearest + tolerance;
        wrongOcclusion += (hit.isOccluded != 0) != (hit.primitive != QL_NONE);
        if (hit.primitive != QL_NONE && hit.instance != QL_NONE) wrong += hit.patch < first[hit.instance];
        returned += hit.returned;
    }
    std::printf("%u of %zu rays met something, %u an instance\n", met, rays.size(), onInstances);
    EXPECT_GT(onInstances, 1000u);
    EXPECT_EQ(wrong, 0u);
    EXPECT_EQ(wrongOcclusion, 0u);
    EXPECT_EQ(returned, 0u);
}

// What glare asks: by Embree's own instances.
TEST(InstanceLevels, HideTheSame) {
    const TwoLevels scenes;
    const Scene flat = flattened(scenes), levels = twoLevel(scenes);
    const Occlusion ofFlat(flat), ofLevels(levels);
    std::mt19937 random(11);
    std::uniform_real_distribution<double> place(-3, 3);
    unsigned hidden = 0, differing = 0;
    for (int k = 0; k < 2000; ++k) {
        const dvec3 from(place(random), place(random), 1 + std::abs(place(random)));
        const dvec3 to(place(random), place(random), std::abs(place(random)));
        const bool isHidden = ofFlat.isHidden(from, to);
        hidden += isHidden;
        differing += isHidden != ofLevels.isHidden(from, to);
    }
    EXPECT_GT(hidden, 300u);
    EXPECT_LE(differing, 2u); // at an edge
}

/// Points on the floor and on flat faces near their edges, by number of the primitive in the world or in its instance.
std::vector<std::pair<RegionQuery, RegionQuery>> pointsOnBoth(const Scene& flat, const Scene& levels) {
    const auto ofFlat = trianglesOf(flat), ofLevels = trianglesOf(levels);
    const auto first = firstPatches(levels, findBorders(levels));
    std::mt19937 random(3);
    std::uniform_real_distribution<double> uniform(0, 1);
    std::vector<std::pair<RegionQuery, RegionQuery>> points;
    for (const WorldTriangle& t : ofLevels)
        for (int k = 0; k < 40; ++k) {
            const double s = std::sqrt(uniform(random)), v = uniform(random);
            dvec3 p = t.a + s * (1 - v) * t.e1 + s * v * t.e2;
            if (t.instance == QL_NONE) { // the floor: about the instances
                p = dvec3(6 * uniform(random) - 3, 6 * uniform(random) - 3, 0);
                if (t.primitive > 1) continue;
            }
            const dvec3 n = glm::normalize(glm::cross(t.e1, t.e2));
            // The same triangle, flattened.
            const auto same = std::find_if(ofFlat.begin(), ofFlat.end(), [&](const WorldTriangle& f) {
                double at = 0;
                return surely(f, p + 0.001 * n, -n, at) > 1e-3 && std::abs(at - 0.001) < 1e-4 &&
                       std::abs(std::abs(glm::dot(n, glm::normalize(glm::cross(f.e1, f.e2)))) - 1) < 1e-5;
            });
            if (same == ofFlat.end()) continue;
            const shared::Packed3 position{float(p.x), float(p.y), float(p.z)},
                normal{float(n.x), float(n.y), float(n.z)};
            const float radius = float(0.05 + 0.6 * uniform(random));
            points.push_back({{position, normal, same->primitive, radius, 0},
                              {position, normal, t.primitive, radius, t.instance == QL_NONE ? 0 : first[t.instance]}});
        }
    return points;
}

unsigned regionsThatDiffer(const std::vector<RegionAnswer>& a, const std::vector<RegionAnswer>& b) {
    unsigned differing = 0;
    for (size_t k = 0; k < a.size(); ++k) {
        bool differs = a[k].bordered != b[k].bordered ||
                       std::abs(a[k].radiusSquared - b[k].radiusSquared) > 1e-4 * a[k].radiusSquared;
        for (unsigned s = 0; s < densitySectors; ++s)
            differs = differs || std::abs(std::sqrt(a[k].reachSquared[s]) - std::sqrt(b[k].reachSquared[s])) >
                                     1e-3 * std::sqrt(a[k].radiusSquared);
        differing += differs;
    }
    return differing;
}

// Faces of cubes and floors, the mask's, and the roof's, where instances stand apart, on the floor, and sunk into it.
TEST(InstanceLevels, DensityRegionsEndAtTheSameBorders) {
    const TwoLevels scenes;
    const Scene flat = flattened(scenes), levels = twoLevel(scenes);
    std::vector<RegionQuery> ofFlat, ofLevels, beside;
    for (const auto& [a, b] : pointsOnBoth(flat, levels)) {
        ofFlat.push_back(a);
        ofLevels.push_back(b);
        beside.push_back(b);
        beside.back().position.x += 0.02f * b.radius;
    }
    DensityScene flatScene(flat, 1), levelScene(levels, 1);
    const auto expected = flatScene.regions(ofFlat), found = levelScene.regions(ofLevels);
    const auto bordered = std::count_if(expected.begin(), expected.end(), [](const auto& r) { return r.bordered; });
    const unsigned differing = regionsThatDiffer(expected, found);
    std::printf("%u of %zu regions differ, %td are bordered\n", differing, expected.size(), bordered);
    EXPECT_GT(bordered, 500);
    EXPECT_LE(differing, expected.size() / 100);
    EXPECT_GT(regionsThatDiffer(expected, levelScene.regions(beside)), expected.size() / 2); // negative control
}

// Means of both, by quarters of the image, of independent seeds. A right case passes within 4 standard errors of 8
// batches: one of 8 comparisons fails with a probability of 1 % (Student t, 14 degrees of freedom); seeds are fixed.
TEST(InstanceLevels, ImagesAreTheSame) {
    std::vector<int> quarters(32 * 32);
    for (int k = 0; k < 32 * 32; ++k) quarters[size_t(k)] = (k % 32 >= 16) + 2 * (k >= 512);
    for (const bool camera : {false, true}) {
        const TwoLevels scenes(!camera); // normal maps are for photons
        const Scene flat = scenes.load("flattened", 32), levels = scenes.load("two-level", 32);
        RenderSettings settings;
        settings.photonsPerPass = 20'000;
        settings.direct = camera ? DirectLight::emitters : DirectLight::photons;
        if (camera) settings.map = MapOrder::camera;
        settings.seed = 1;
        const auto a = renderGroups(flat, settings, quarters, 8, 3);
        settings.seed = 2;
        const auto b = renderGroups(levels, settings, quarters, 8, 3);
        for (size_t k = 0; k < 4; ++k) {
            std::printf("%zu: %.5f +- %.5f, %.5f +- %.5f\n", k, a[k].mean, a[k].standardError, b[k].mean,
                        b[k].standardError);
            EXPECT_NEAR(a[k].mean, b[k].mean, 4 * std::hypot(a[k].standardError, b[k].standardError)) << camera;
            EXPECT_GT(a[k].mean, 20 * a[k].standardError) << "the test would see nothing";
        }
    }
}

} // namespace
} // namespace quasilux

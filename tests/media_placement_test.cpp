// Which medium lies around shapes, the camera and the emitters: as stated, or derived from what holds what.
#include "prepare/media.h"
#include "prepare/medium_shape.h"

#include "support/border_scenes.h"

#include <gtest/gtest.h>
#include <random>

namespace quasilux {
namespace {

constexpr unsigned fog = 0, milk = 1, juice = 2;

glm::dmat4 placed(dvec3 center, double halfSide) {
    return glm::scale(glm::translate(glm::dmat4(1), center), dvec3(halfSide));
}

ShapeDescription& cube(Scene& scene, dvec3 center, double halfSide) {
    addCube(scene, glm::rotate(placed(center, halfSide), 0.3, dvec3(1, 2, 3)));
    return scene.shapes.back();
}

ShapeDescription& sphere(Scene& scene, dvec3 center, double radius) {
    addSphere(scene, center, radius);
    return scene.shapes.back();
}

void turnInsideOut(ShapeDescription& shape) {
    shape.flipNormals = true;
    for (glm::uvec3& triangle : shape.mesh.triangles) std::swap(triangle.y, triangle.z);
}

void moveCamera(Scene& scene, dvec3 position) { scene.sensor.toWorld = glm::translate(glm::dmat4(1), position); }

unsigned cameraMedium(Scene scene, dvec3 position) {
    moveCamera(scene, position);
    return placeMedia(scene).camera;
}

/// Cube of fog, sphere of milk in it, cube of juice in that one, and beside the milk, in the fog, a sphere of juice.
Scene nested() {
    Scene scene;
    scene.media.resize(3);
    cube(scene, {0, 0, 0}, 10).interior = fog;
    sphere(scene, {0, 0, 0}, 4).interior = milk;
    cube(scene, {0, 0, 0}, 1).interior = juice;
    sphere(scene, {6, 0, 0}, 1).interior = juice;
    return scene;
}

TEST(MediaPlacement, WithoutMediaNothingChanges) {
    Scene scene;
    cube(scene, {0, 0, 0}, 1).emitter.emplace();
    scene.pointEmitters.emplace_back();
    const MediumPlacement placement = placeMedia(scene);
    EXPECT_EQ(placement.interior, std::vector<unsigned>{MEDIUM_UNCHANGED});
    EXPECT_EQ(placement.exterior, std::vector<unsigned>{MEDIUM_UNCHANGED});
    EXPECT_EQ(placement.shapeEmitters, std::vector<unsigned>{MEDIUM_NONE});
    EXPECT_EQ(placement.pointEmitters, std::vector<unsigned>{MEDIUM_NONE});
    EXPECT_EQ(placement.camera, MEDIUM_NONE);
}

TEST(MediaPlacement, AroundNestedShapesLiesTheInnermostMedium) {
    const MediumPlacement placement = placeMedia(nested());
    EXPECT_EQ(placement.interior, (std::vector<unsigned>{fog, milk, juice, juice}));
    EXPECT_EQ(placement.exterior, (std::vector<unsigned>{MEDIUM_NONE, fog, milk, fog}));
}

// Fog in which the camera says that it stands, outside of all bodies, is what lies outside.
TEST(MediaPlacement, OutsideLiesWhatTheCameraStandsIn) {
    Scene scene;
    scene.media.resize(2);
    sphere(scene, {0, 0, 0}, 1).interior = milk;
    cube(scene, {5, 0, 0}, 1).emitter.emplace();
    scene.pointEmitters.emplace_back().position = {0, 5, 0};
    scene.sensor.medium = fog;
    moveCamera(scene, {0, 0, 5});
    MediumPlacement placement = placeMedia(scene);
    EXPECT_EQ(placement.exterior.front(), fog);
    EXPECT_EQ(placement.shapeEmitters.back(), fog);
    EXPECT_EQ(placement.pointEmitters, std::vector<unsigned>{fog});
    moveCamera(scene, {0, 0, 0}); // what it says there is of the sphere's inside
    placement = placeMedia(scene);
    EXPECT_EQ(placement.exterior.front(), MEDIUM_NONE);
    EXPECT_EQ(placement.shapeEmitters.back(), MEDIUM_NONE);
    EXPECT_EQ(placement.pointEmitters, std::vector<unsigned>{MEDIUM_NONE});
}

TEST(MediaPlacement, TheOrderOfTheShapesDoesNotMatter) {
    Scene scene = nested();
    std::reverse(scene.shapes.begin(), scene.shapes.end());
    const MediumPlacement placement = placeMedia(scene);
    EXPECT_EQ(placement.interior, (std::vector<unsigned>{juice, juice, milk, fog}));
    EXPECT_EQ(placement.exterior, (std::vector<unsigned>{fog, milk, fog, MEDIUM_NONE}));
}

TEST(MediaPlacement, AnySizeAndPlace) {
    for (const double scale : {1e-4, 1e4})
        for (const double offset : {0.0, 1e3}) { // in units of the scale: single precision then leaves 1e-4 of them
            Scene scene = nested();
            transform(scene, scale, dvec3(offset * scale));
            scene.sensor.nearClip = 1e-2 * scale;
            for (ShapeDescription& shape : scene.shapes)
                if (shape.sphere) {
                    shape.sphere->center = glm::vec3((dvec3(shape.sphere->center) + offset) * scale);
                    shape.sphere->radius = float(shape.sphere->radius * scale);
                }
            const MediumPlacement placement = placeMedia(scene);
            EXPECT_EQ(placement.exterior, (std::vector<unsigned>{MEDIUM_NONE, fog, milk, fog}))
                << scale << ' ' << offset;
            EXPECT_EQ(cameraMedium(scene, dvec3(offset + 2) * scale), milk) << scale << ' ' << offset;
        }
}

TEST(MediaPlacement, WhereTheCameraStands) {
    const Scene scene = nested();
    EXPECT_EQ(cameraMedium(scene, {0, 0, 0}), juice);
    EXPECT_EQ(cameraMedium(scene, {0, 3, 0}), milk);
    EXPECT_EQ(cameraMedium(scene, {0, 5, 0}), fog);
    EXPECT_EQ(cameraMedium(scene, {6.5, 0, 0}), juice);
    EXPECT_EQ(cameraMedium(scene, {0, 0, 30}), MEDIUM_NONE);
}

TEST(MediaPlacement, RaysOfACameraBeginOnItsNearPlane) {
    Scene scene = nested();
    for (const bool orthographic : {true, false}) {
        scene.sensor.orthographic = orthographic;
        scene.sensor.nearClip = 25; // along +z from -30 to -5
        EXPECT_EQ(cameraMedium(scene, {0, 0, -30}), fog);
        scene.sensor.nearClip = 1;
        EXPECT_EQ(cameraMedium(scene, {0, 0, -30}), MEDIUM_NONE);
    }
    scene.sensor.nearClip = 25;
    EXPECT_EQ(cameraMedium(scene, {0, 0, -28}), milk);
    scene.sensor.fovX = 0.5;
    EXPECT_EQ(cameraMedium(scene, {0, 0, -28}), MEDIUM_BY_PLACE) << "the image shows the milk's border";
    scene.sensor.fovX = 0;
    scene.sensor.apertureRadius = 12;
    EXPECT_EQ(cameraMedium(scene, {0, 0, -30}), MEDIUM_BY_PLACE) << "the lens is wider than the fog";
}

// A glass block in a wide sea, say, of which both sides state the same water: water does not end at it.
TEST(MediumShape, EndsNowhereAtASurfaceThatHasItOnBothSides) {
    Scene scene;
    scene.media.resize(1);
    cube(scene, {0, 0, 0}, 1).interior = fog;
    EXPECT_EQ(findMediumShape(scene, fog).planes.size(), 6u);
    scene.shapes[0].exterior = fog;
    addSphere(scene, {0, 0, 0}, 50);
    const MediumShape shape = findMediumShape(scene, fog);
    EXPECT_TRUE(shape.planes.empty());
    EXPECT_GE(shape.extent, 100);
}

TEST(MediaPlacement, WhatIsStatedWins) {
    Scene scene = nested();
    scene.shapes[1].exterior = juice;
    scene.sensor.medium = juice;
    scene.pointEmitters.resize(2);
    scene.pointEmitters[0].medium = fog;
    const MediumPlacement placement = placeMedia(scene);
    EXPECT_EQ(placement.exterior[1], juice);
    EXPECT_EQ(placement.camera, juice);
    EXPECT_EQ(placement.pointEmitters, (std::vector<unsigned>{fog, juice}));
}

TEST(MediaPlacement, NormalsThatPointInwardsSwapTheSides) {
    for (const bool round : {false, true}) {
        Scene scene;
        scene.media.resize(2);
        ShapeDescription& shape = round ? sphere(scene, {0, 0, 0}, 2) : cube(scene, {0, 0, 0}, 2);
        turnInsideOut(shape);
        shape.exterior = fog; // on the side of the normal: within
        sphere(scene, {0.5, 0, 0}, 0.5).interior = milk;
        const MediumPlacement placement = placeMedia(scene);
        EXPECT_EQ(placement.interior, (std::vector<unsigned>{MEDIUM_NONE, milk}));
        EXPECT_EQ(placement.exterior, (std::vector<unsigned>{fog, fog}));
        EXPECT_EQ(cameraMedium(scene, {-1, 0, 0}), fog);
        // Behind the surface is the whole world around the shape: no closed shape holds it.
        scene.shapes[0].interior = milk;
        EXPECT_EQ(cameraMedium(scene, {5, 0, 0}), MEDIUM_NONE);
    }
}

TEST(MediaPlacement, AGlassBallInFog) {
    Scene scene;
    scene.media.resize(2);
    cube(scene, {0, 0, 0}, 10).interior = fog;
    sphere(scene, {0, 0, 0}, 1);                  // states nothing: fog within, too
    sphere(scene, {5, 0, 0}, 1).exterior = fog;   // none within, as in Mitsuba
    sphere(scene, {-5, 0, 0}, 1).interior = milk; // fog about it
    const MediumPlacement placement = placeMedia(scene);
    EXPECT_EQ(placement.interior, (std::vector<unsigned>{fog, MEDIUM_UNCHANGED, MEDIUM_NONE, milk}));
    EXPECT_EQ(placement.exterior, (std::vector<unsigned>{MEDIUM_NONE, MEDIUM_UNCHANGED, fog, fog}));
    EXPECT_EQ(cameraMedium(scene, {0, 0, 0}), fog);
    EXPECT_EQ(cameraMedium(scene, {5, 0, 0}), MEDIUM_NONE);
    EXPECT_EQ(cameraMedium(scene, {-5, 0, 0}), milk);
}

TEST(MediaPlacement, EmittersEmitOnTheSideOfTheirNormal) {
    Scene scene = nested();
    sphere(scene, {0, 3, 0}, 0.2);                      // in milk
    addPlane(scene, {-1, 6, -1}, {2, 0, 0}, {0, 0, 2}); // in fog
    turnInsideOut(sphere(scene, {0, 20, 0}, 0.2));      // outside
    sphere(scene, {0, -6, 0}, 0.5).interior = juice;    // a bulb of juice in fog
    turnInsideOut(sphere(scene, {0, 6, 5}, 0.5));       // a bulb that shines inwards, with milk on that side
    scene.shapes.back().exterior = milk;
    for (size_t i = 4; i < scene.shapes.size(); ++i) scene.shapes[i].emitter.emplace();
    scene.pointEmitters.resize(2);
    scene.pointEmitters[1].position = {0, 3, 0};
    const MediumPlacement placement = placeMedia(scene);
    EXPECT_EQ(placement.shapeEmitters, (std::vector<unsigned>{MEDIUM_NONE, MEDIUM_NONE, MEDIUM_NONE, MEDIUM_NONE, milk,
                                                              fog, MEDIUM_NONE, fog, milk}));
    EXPECT_EQ(placement.pointEmitters, (std::vector<unsigned>{juice, milk}));
    EXPECT_EQ(placement.exterior[4], MEDIUM_UNCHANGED);
    EXPECT_EQ(placement.interior[7], juice);
    EXPECT_EQ(placement.interior[8], fog);
}

TEST(MediaPlacement, AnEmitterOnTheBorderOfAMediumShinesToTheSideOfItsNormal) {
    Scene scene;
    scene.media.resize(1);
    addCube(scene, glm::dmat4(1));
    scene.shapes.back().interior = fog;
    addPlane(scene, {-0.5, -0.5, 1}, {1, 0, 0}, {0, 1, 0}); // on the cube's upper face, upwards
    addPlane(scene, {-0.5, -0.5, 1}, {0, 1, 0}, {1, 0, 0}); // downwards
    for (size_t i = 1; i < 3; ++i) scene.shapes[i].emitter.emplace();
    const MediumPlacement placement = placeMedia(scene);
    EXPECT_EQ(placement.shapeEmitters[1], MEDIUM_NONE);
    EXPECT_EQ(placement.shapeEmitters[2], fog);
}

TEST(MediaPlacement, AnOpenSurfaceHoldsNothing) {
    Scene scene;
    scene.media.resize(3);
    addPlane(scene, {-1, -1, -1}, {2, 0, 2}, {0, 2, 0}, 4); // tilted, so that its bounding box has an inside
    scene.shapes[0].interior = fog;
    EXPECT_EQ(placeMedia(scene).exterior[0], MEDIUM_NONE);
    // Within a larger body its other side is that body's medium.
    cube(scene, {0, 0, 0}, 10).interior = milk;
    EXPECT_EQ(placeMedia(scene).exterior[0], milk);
    EXPECT_EQ(placeMedia(scene).interior[0], fog);
    scene.shapes[0].exterior = juice;
    const dvec3 normal = glm::normalize(dvec3(-1, 0, 1));
    for (const double height : {1e-9, 1e-3, 0.5, 0.0, -1e-9, -1e-3, -0.5})
        EXPECT_EQ(cameraMedium(scene, dvec3(0.1, 0.1, 0.1) + height * normal), milk) << height;
}

TEST(MediaPlacement, AHollowShellHoldsOnlyItsWall) {
    Scene scene;
    scene.media.resize(2);
    addCube(scene, placed({0, 0, 0}, 2));
    addCube(scene, placed({0, 0, 0}, 1));
    turnInsideOut(scene.shapes[1]);
    Mesh& wall = scene.shapes[0].mesh;
    const auto first = static_cast<unsigned>(wall.positions.size());
    wall.positions.insert(wall.positions.end(), scene.shapes[1].mesh.positions.begin(),
                          scene.shapes[1].mesh.positions.end());
    for (const glm::uvec3& t : scene.shapes[1].mesh.triangles) wall.triangles.push_back(t + first);
    scene.shapes.pop_back();
    scene.shapes[0].interior = fog;
    EXPECT_EQ(cameraMedium(scene, {0, 0, 0}), MEDIUM_NONE);
    EXPECT_EQ(cameraMedium(scene, {1.5, 0, 0}), fog);
    EXPECT_EQ(placeMedia(scene).exterior[0], MEDIUM_NONE);
}

/// Against the distance to the centre, points in line with vertices and edges included; where the mesh differs from
/// the sphere (between the radii of its faces and its vertices) no point is asked for.
TEST(MediaPlacement, MeshesAgreeWithTheSphereThatTheyApproximate) {
    Scene scene;
    scene.media.resize(1);
    scene.sensor.nearClip = 0; // so that the camera's rays begin at one point
    addSphereMesh(scene, {1, 2, 3}, 2, 24, 12);
    scene.shapes[0].interior = fog;
    std::mt19937 random(1);
    std::normal_distribution<double> normal;
    for (int i = 0; i < 200; ++i) {
        dvec3 direction = glm::normalize(dvec3(normal(random), normal(random), normal(random)));
        if (i % 2) { // towards a vertex
            const auto& positions = scene.shapes[0].mesh.positions;
            direction = glm::normalize(dvec3(positions[static_cast<size_t>(i) % positions.size()]) - dvec3(1, 2, 3));
        }
        for (const double distance : {0.0, 0.7, 1.9, 2.0001, 5.0}) {
            const unsigned expected = distance < 2 ? fog : MEDIUM_NONE;
            ASSERT_EQ(cameraMedium(scene, dvec3(1, 2, 3) + distance * direction), expected) << distance;
        }
    }
}

} // namespace
} // namespace quasilux

// Groups of shapes, their instances, and merges.
#include "support/scene_files.h"

#include <gmock/gmock.h>

namespace quasilux {
namespace {

using test::expectNear;
using test::SceneFiles;
using test::sceneWith;
using testing::HasSubstr;

const char* const group = "<shape type=\"shapegroup\" id=\"g\"><shape type=\"cube\" id=\"box\"><transform "
                          "name=\"to_world\"><scale value=\"0.5\"/></transform><bsdf type=\"diffuse\" "
                          "id=\"paint\"/></shape><shape type=\"sphere\"/></shape>";

std::string instance(const std::string& operations) {
    return "<shape type=\"instance\" id=\"i\"><ref id=\"g\"/><transform name=\"to_world\">" + operations +
           "</transform></shape>";
}

TEST(Instances, ShapesAreWhereTheTransformsOfInstanceAndShapePutThem) {
    const Scene scene = test::loadBody(group + instance("<translate x=\"3\"/>") +
                                       instance("<scale value=\"2\"/><translate y=\"10\"/>").replace(27, 1, "j"));
    ASSERT_EQ(scene.shapes.size(), 4u); // and none of the group itself
    EXPECT_TRUE(scene.warnings.empty());
    EXPECT_EQ(scene.shapes[0].id, "i/box");
    expectNear(scene.shapes[0].mesh.positions[7], {3.5f, 0.5f, 0.5f}); // shape first, then instance
    expectNear(scene.shapes[1].sphere->center, {3, 0, 0});
    EXPECT_EQ(scene.shapes[2].id, "j/box");
    expectNear(scene.shapes[2].mesh.positions[7], {1, 11, 1});
    EXPECT_FLOAT_EQ(scene.shapes[3].sphere->radius, 2);
    EXPECT_EQ(scene.shapes[0].bsdf, scene.shapes[2].bsdf); // read once
}

TEST(Instances, OfMirroringTransformsKeepNormalsOutside) {
    const Scene scene = test::loadBody(group + instance("<scale x=\"-1\"/>"));
    const Mesh& cube = scene.shapes.at(0).mesh;
    for (const glm::uvec3& t : cube.triangles) {
        const glm::vec3 a = cube.positions[t.x], normal = glm::cross(cube.positions[t.y] - a, cube.positions[t.z] - a);
        EXPECT_GT(glm::dot(normal, a), 0);
    }
}

TEST(Instances, FarFromTheOriginAreWhereTheyBelong) {
    const Scene scene = test::loadBody(group + instance("<translate x=\"1000000\"/>"));
    EXPECT_NEAR(scene.origin.x, 1e6, 1);
    EXPECT_NEAR(scene.origin.x + scene.shapes.at(0).mesh.positions[7].x, 1e6 + 0.5, 1e-6);
}

TEST(Instances, OfAMeshFileReadItOnce) {
    SceneFiles files;
    const std::string obj = files.write("t.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    std::string body = "<shape type=\"shapegroup\" id=\"g\"><shape type=\"obj\"><string name=\"filename\" "
                       "value=\"t.obj\"/></shape></shape>";
    for (int k = 0; k < 3; ++k)
        body += "<shape type=\"instance\"><ref id=\"g\"/><transform name=\"to_world\"><translate x=\"" +
                std::to_string(k) + "\"/></transform></shape>";
    const Scene scene = loadScene(files.write("scene.xml", sceneWith(body)));
    ASSERT_EQ(scene.shapes.size(), 3u);
    for (size_t k = 0; k < 3; ++k) expectNear(scene.shapes[k].mesh.positions[0], {float(k), 0, 0});
}

const std::string asLevel = "<?quasilux instances=\"two-level\"?>", flat = "<?quasilux instances=\"flattened\"?>";

TEST(InstanceLevels, KeepTheShapesOfAGroupOnce) {
    const Scene scene = test::loadBody(asLevel + group + instance("<translate x=\"3\"/>") + "<shape type=\"disk\"/>" +
                                       instance("<scale value=\"2\"/>").replace(27, 1, "j"));
    ASSERT_EQ(scene.shapes.size(), 3u);
    ASSERT_EQ(scene.worldShapes().size(), 1u);
    EXPECT_EQ(scene.worldShapes()[0].plugin, "disk");
    ASSERT_EQ(scene.groups.size(), 1u);
    EXPECT_EQ(scene.groups[0].firstShape, 1u);
    EXPECT_EQ(scene.shapes[1].id, "g/box");
    expectNear(scene.shapes[1].mesh.positions[7], {0.5f, 0.5f, 0.5f}); // in its own space
    ASSERT_EQ(scene.instances.size(), 2u);
    expectNear(scene.instances[0].toWorld[3], {3, 0, 0});
    expectNear(scene.instances[1].toWorld[0], {2, 0, 0});
}

TEST(InstanceLevels, FarFromTheOriginLoseNothing) {
    const std::string far = "<transform name=\"to_world\"><translate x=\"1e7\"/></transform>";
    const Scene scene = test::loadBody(asLevel + "<shape type=\"shapegroup\" id=\"g\"><shape type=\"cube\">" + far +
                                       "</shape></shape>" + instance("<translate y=\"1e7\"/>"));
    const glm::dvec3 corner(scene.instances.at(0).toWorld * glm::vec4(scene.shapes.at(0).mesh.positions[7], 1));
    EXPECT_NEAR(scene.origin.x + corner.x, 1e7 + 1, 1e-6);
    EXPECT_NEAR(scene.origin.y + corner.y, 1e7 + 1, 1e-6);
}

// What kernels cannot carry rays into, or what lies in the world as a whole.
TEST(InstanceLevels, AreFlattenedWhereTheyCannotBeKept) {
    const auto instancesOf = [](const std::string& body) { return test::loadBody(asLevel + body).instances.size(); };
    EXPECT_EQ(instancesOf(group + instance("<translate x=\"3\"/>")), 1u);
    EXPECT_EQ(test::loadBody(flat + group + instance("<translate x=\"3\"/>")).instances.size(), 0u);
    EXPECT_EQ(instancesOf(group + instance("<scale value=\"1e6\"/>")), 0u);
    EXPECT_EQ(instancesOf(group + instance("<scale value=\"1e-6\"/>")), 0u);
    EXPECT_EQ(instancesOf("<shape type=\"shapegroup\" id=\"g\"><shape type=\"cube\"><medium type=\"homogeneous\" "
                          "name=\"interior\"/></shape></shape>" +
                          instance("")),
              0u);
}

const char* const curves = "<shape type=\"shapegroup\" id=\"g\"><shape type=\"linearcurve\"><string "
                           "name=\"filename\" value=\"c.txt\"/><transform name=\"to_world\"><scale value=\"2\"/>"
                           "</transform></shape></shape>";

// As in Mitsuba 3.9.1: the curve's own to_world leaves its radius, that of the instance does not.
TEST(Instances, OfCurvesScaleTheRadiiToo) {
    SceneFiles files;
    files.write("c.txt", "-1 0 0 0.1\n1 0 0 0.1\n");
    const auto sizeUnder = [&](const std::string& operations) {
        const Scene scene = loadScene(files.write("scene.xml", sceneWith(curves + instance(operations))));
        glm::vec3 largest(0);
        for (const glm::vec3& p : scene.shapes.at(0).mesh.positions) largest = glm::max(largest, p);
        return largest;
    };
    expectNear(sizeUnder("") / glm::vec3(2.1, 0.1, 0.1), glm::vec3(1), 0.005f);
    expectNear(sizeUnder("<scale value=\"10\"/>") / glm::vec3(21, 1, 1), glm::vec3(1), 0.005f);
    expectNear(sizeUnder("<scale x=\"1\" y=\"10\" z=\"20\"/>") / glm::vec3(2.1, 1, 2), glm::vec3(1), 0.005f);
}

TEST(InstanceLevels, OfCurvesAreKept) {
    SceneFiles files;
    files.write("c.txt", "-1 0 0 0.1\n1 0 0 0.1\n");
    const std::string far = "<translate x=\"1e6\"/>"; // the scene's origin belongs to the instance
    const Scene scene = loadScene(files.write("scene.xml", sceneWith(asLevel + curves + instance(far))));
    ASSERT_EQ(scene.instances.size(), 1u);
    glm::vec3 largest(0);
    for (const glm::vec3& p : scene.shapes.at(0).mesh.positions) largest = glm::max(largest, p);
    expectNear(largest / glm::vec3(2.1, 0.1, 0.1), glm::vec3(1), 0.005f);
    EXPECT_NEAR(scene.origin.x + scene.instances[0].toWorld[3].x, 1e6, 1e-3);
}

TEST(InstanceLevels, AreChosenWhereCopiesWouldBeAMillionTriangles) {
    SceneFiles files;
    std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\n",
                body = "<shape type=\"shapegroup\" id=\"g\"><shape type=\"obj\"><string "
                       "name=\"filename\" value=\"t.obj\"/></shape></shape>";
    for (int k = 0; k < 100'000; ++k) obj += "f 1 2 3\n";
    files.write("t.obj", obj);
    const auto load = [&](int places) {
        std::string instances;
        for (int k = 0; k < places; ++k) instances += "<shape type=\"instance\"><ref id=\"g\"/></shape>";
        return loadScene(files.write("scene.xml", sceneWith(body + instances)));
    };
    EXPECT_EQ(load(3).shapes.size(), 3u);
    EXPECT_EQ(load(11).instances.size(), 11u);
}

TEST(InstanceLevels, AreOneOfTwoWays) {
    SceneFiles files;
    EXPECT_THAT(test::errorOf(files.write("scene.xml", sceneWith("<?quasilux instances=\"two\"?>"))),
                HasSubstr("instances: unknown value 'two'"));
    EXPECT_THAT(test::errorOf(files.write("scene.xml", sceneWith(asLevel + group + instance("<scale x=\"2\"/>")))),
                HasSubstr("to_world of a sphere scales directions differently"));
}

// Those without an id are kept as places while the file is read (plain_instances.h), and are the same shapes in the
// same order.
TEST(Instances, WithAndWithoutAnIdAreTheSame) {
    SceneFiles files;
    const std::string at = "<ref id=\"g\"/><transform name=\"to_world\"><rotate z=\"1\" angle=\"30\"/><translate "
                           "x=\"3\"/></transform></shape>",
                      with = "<shape type=\"instance\" id=\"i\">" + at, without = "<shape type=\"instance\">" + at;
    files.write("part.xml",
                "<scene version=\"3.0.0\"><shape type=\"cube\"/>" + without + "<shape type=\"cube\"/></scene>");
    const auto load = [&](const std::string& one) {
        return loadScene(
            files.write("scene.xml", sceneWith(group + std::string("<shape type=\"disk\"/>") + one +
                                               "<include filename=\"part.xml\"/><shape type=\"rectangle\"/>")));
    };
    const Scene a = load(with), b = load(without);
    ASSERT_EQ(a.shapes.size(), 8u);
    ASSERT_EQ(b.shapes.size(), 8u);
    const std::vector<std::string> plugins = {"disk", "cube", "sphere", "cube", "cube", "sphere", "cube", "rectangle"};
    for (size_t k = 0; k < plugins.size(); ++k) {
        EXPECT_EQ(a.shapes[k].plugin, plugins[k]);
        EXPECT_EQ(b.shapes[k].plugin, plugins[k]);
        EXPECT_EQ(a.shapes[k].mesh.positions, b.shapes[k].mesh.positions);
    }
    EXPECT_EQ(b.shapes[1].id, "instance@4/box");
    EXPECT_EQ(load(without + asLevel).instances.size(), 2u);
}

// As in Mitsuba: normals of an instance go by the inverse transpose, however its shapes have got theirs.
TEST(Instances, OfMirroringTransformsKeepTheSidesOfMeshesAndSpheres) {
    SceneFiles files;
    files.write("t.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    const Scene scene = loadScene(files.write(
        "scene.xml",
        sceneWith(
            "<shape type=\"shapegroup\" id=\"g\"><shape type=\"sphere\"/><shape type=\"obj\"><string name=\"filename\" "
            "value=\"t.obj\"/></shape></shape>" +
            instance("<scale x=\"-1\"/>"))));
    EXPECT_FALSE(scene.shapes.at(0).flipNormals);
    const Mesh& mesh = scene.shapes.at(1).mesh;
    const glm::uvec3 t = mesh.triangles.at(0);
    const glm::vec3 a = mesh.positions[t.x], normal = glm::cross(mesh.positions[t.y] - a, mesh.positions[t.z] - a);
    EXPECT_GT(normal.z, 0);
}

TEST(Merges, AreTheShapesInThem) {
    const Scene scene = test::loadBody("<shape type=\"merge\"><shape type=\"cube\"/><shape type=\"sphere\"><emitter "
                                       "type=\"area\"/></shape></shape>");
    ASSERT_EQ(scene.shapes.size(), 2u);
    EXPECT_EQ(scene.shapes[0].plugin, "cube");
    EXPECT_TRUE(scene.shapes[1].emitter.has_value());
}

// As in Mitsuba's own Cornell box.
TEST(SharedEmitters, StandInTheSceneForShapesToReference) {
    const std::string emitter = "<emitter type=\"area\" id=\"e\"><rgb name=\"radiance\" value=\"3\"/></emitter>";
    const Scene scene = test::loadBody("<shape type=\"cube\"><ref id=\"e\"/></shape><shape type=\"sphere\"><ref "
                                       "id=\"e\"/></shape>" +
                                       emitter);
    ASSERT_EQ(scene.shapes.size(), 2u);
    for (const ShapeDescription& shape : scene.shapes) EXPECT_EQ(shape.emitter.value().radiance.g, 3);
    EXPECT_TRUE(scene.warnings.empty());
    EXPECT_THAT(test::loadBody(emitter).warnings, testing::ElementsAre(HasSubstr("emitter 'e' is used by no shape")));
}

TEST(Instances, AGroupWithoutAnyIsReported) {
    const Scene scene = test::loadBody(group);
    EXPECT_TRUE(scene.shapes.empty());
    EXPECT_THAT(scene.warnings, testing::Contains(HasSubstr("shapegroup 'g' is used by no instance")));
}

struct BadGroup {
    const char *name, *body, *message;
};
class BadGroups : public testing::TestWithParam<BadGroup> {};
TEST_P(BadGroups, AreRefusedAtTheirPlace) {
    SceneFiles files;
    EXPECT_THAT(test::errorOf(files.write("scene.xml", sceneWith(GetParam().body))), HasSubstr(GetParam().message));
}
#define GROUP(inside)                                                                                                  \
    "<shape type=\"shapegroup\" id=\"g\">" inside "</shape>\n<shape type=\"instance\"><ref id=\"g\"/></shape>"
INSTANTIATE_TEST_SUITE_P(
    Instances, BadGroups,
    testing::Values(
        BadGroup{"NoGroup", "<shape type=\"instance\"/>", "scene.xml:4:1: an instance needs one shapegroup"},
        BadGroup{"OtherShape", "<shape type=\"instance\"><shape type=\"cube\"/></shape>",
                 "scene.xml:4:1: an instance needs one shapegroup"},
        BadGroup{"Empty", GROUP(""), "scene.xml:4:1: shapegroup 'g' has no shape"},
        BadGroup{"Emitter", GROUP("\n<shape type=\"cube\" id=\"c\"><emitter type=\"area\"/></shape>"),
                 "scene.xml:5:1: shape 'c' of a shapegroup has an emitter"},
        BadGroup{"Nested", GROUP("\n<shape type=\"instance\"><ref id=\"g\"/></shape>"),
                 "scene.xml:5:1: <shape type=\"instance\"> within a shapegroup"},
        BadGroup{"Itself", "<shape type=\"merge\" id=\"m\">\n<ref id=\"m\"/></shape>", "a merge within a merge"},
        BadGroup{"TransformOfMerge", "<shape type=\"merge\">\n<transform name=\"to_world\"/></shape>",
                 "scene.xml:5:1: unknown parameter 'to_world' of shape 'merge'"},
        BadGroup{"UnusedHasErrors", "<shape type=\"shapegroup\">\n<shape type=\"cubo\"/></shape>",
                 "scene.xml:5:1: unknown shape plugin 'cubo'. Did you mean 'cube'"}),
    [](const auto& row) { return std::string(row.param.name); });

} // namespace
} // namespace quasilux

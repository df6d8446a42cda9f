// What a scene file means: numbers, units, transforms, emitters, references, settings. Of sensors: sensor_loader_test.
#include "scene/scene.h"

#include "support/scene_files.h"

#include <cmath>
#include <gmock/gmock.h>

namespace quasilux {
namespace {

using test::expectNear;
using test::loadBody;
using test::loadSensor;
using test::loadShape;
using test::placed;
using test::SceneFiles;
using test::sceneWith;

constexpr double degree = 3.14159265358979324 / 180;

void expectRgb(Rgb value, float r, float g, float b, float tolerance = 1e-6f) {
    expectNear({value.r, value.g, value.b}, {r, g, b}, tolerance);
}

// ---- the two scenes that come with the program

TEST(CornellScenes, PhongHasTheGeometryAndLobesOfFigureOne) {
    const Scene scene = loadScene(std::string(QUASILUX_SOURCE_DIR) + "/scenes/cornell_phong.xml");
    EXPECT_TRUE(scene.warnings.empty());
    ASSERT_EQ(scene.shapes.size(), 8u);
    EXPECT_EQ(scene.maxDepth, -1);
    EXPECT_EQ(scene.settings.bdd, 0u);
    EXPECT_EQ(scene.settings.variant, Variant::main);
    EXPECT_EQ(scene.sensor.width, 256u);
    EXPECT_EQ(scene.sensor.filter, FILTER_BOX);
    EXPECT_NEAR(scene.sensor.fovX, 39.3077 * degree, 1e-12);

    const ShapeDescription& light = scene.shapes.back();
    ASSERT_TRUE(light.emitter && light.rectangle);
    expectNear(light.rectangle->normal, {0, 1, 0});
    EXPECT_NEAR(light.mesh.positions[0].y, 0.99, 1e-6);
    EXPECT_TRUE(scene.bsdfs.at(static_cast<size_t>(light.bsdf)).isNull);

    const Bsdf& box = scene.bsdfs.at(static_cast<size_t>(scene.shapes[5].bsdf));
    ASSERT_EQ(box.front.size(), 2u);
    EXPECT_EQ(box.id, "box");
    EXPECT_EQ(box.front[1].device.type, unsigned(LOBE_PHONG));
    EXPECT_EQ(box.front[1].device.exponent, 1000.0f);
    EXPECT_THAT(box.front[1].quasiSpecular.lobes, testing::ElementsAre("specular"));
}

TEST(CornellScenes, GgxHasTheSameAlbedosThroughABlend) {
    const Scene scene = loadScene(std::string(QUASILUX_SOURCE_DIR) + "/scenes/cornell_ggx.xml");
    const Bsdf& box = scene.bsdfs.at(static_cast<size_t>(scene.shapes[5].bsdf));
    ASSERT_EQ(box.front.size(), 2u);
    expectRgb(box.front[0].device.reflectance, 0.5f, 0, 0);
    expectRgb(box.front[1].device.reflectance, 0.025f, 0.25f, 0.025f);
    EXPECT_EQ(box.front[1].device.type, unsigned(LOBE_GGX));
    EXPECT_FALSE(box.front[0].quasiSpecular.stated);
    EXPECT_EQ(box.front[1].quasiSpecular.kind, QuasiSpecularChoice::Kind::yes);
}

// ---- transforms

TEST(Transform, OperationsMultiplyFromTheLeft) {
    // (1,1,0) → scale 2 → (2,2,0) → rotate 90° about z → (-2,2,0) → translate → (-1,2,3)
    const ShapeDescription shape =
        loadShape(placed("rectangle", R"(<scale value="2"/><rotate z="1" angle="90"/><translate x="1" z="3"/>)"));
    expectNear(shape.mesh.positions[2], {-1, 2, 3});
}

TEST(Transform, FormsOfValues) {
    expectNear(loadShape(placed("rectangle", R"(<scale value="2,3,4"/><translate value="1 0 0"/>)")).mesh.positions[2],
               {3, 3, 0});
    expectNear(loadShape(placed("rectangle", R"(<scale y="3"/>)")).mesh.positions[2], {1, 3, 0});
    expectNear(loadShape(placed("rectangle", R"(<rotate value="0,0,2" angle="+90"/>)")).mesh.positions[2], {-1, 1, 0});
    expectNear(loadShape(placed("rectangle", R"(<rotate value="2" angle="120"/>)")).mesh.positions[2], {0, 1, 1});
}

TEST(Transform, MatrixIsWrittenByRows) {
    expectNear(
        loadShape(placed("rectangle", R"(<matrix value="2 0 0 5  0 3 0 6  0 0 1 7  0 0 0 1"/>)")).mesh.positions[2],
        {7, 9, 7});
    expectNear(loadShape(placed("rectangle", R"(<matrix value="0 2 0  3 0 0  0 0 1"/>)")).mesh.positions[1],
               {-2, 3, 0});
}

TEST(Transform, LookAtSendsZToTheTargetAndXToTheLeft) {
    const Sensor sensor =
        loadSensor(R"(<transform name="to_world"><lookat origin="1,2,3" target="1,2,-3" up="0,1,0"/></transform>)");
    expectNear(glm::vec3(sensor.toWorld[0]), {-1, 0, 0}); // looking along -z with y up, -x is left
    expectNear(glm::vec3(sensor.toWorld[1]), {0, 1, 0});
    expectNear(glm::vec3(sensor.toWorld[2]), {0, 0, -1});
    expectNear(glm::vec3(sensor.toWorld[3]), {1, 2, 3});
}

// The values are those of mi.ScalarTransform4f of Mitsuba 3.9.1, from a scene's <lookat>.
TEST(Transform, WithoutUpALookAtTakesMitsubasAxis) {
    const auto left = [](const std::string& target) {
        return glm::vec3(
            loadSensor("<transform name=\"to_world\"><lookat origin=\"0,0,0\" target=\"" + target + "\"/></transform>")
                .toWorld[0]);
    };
    expectNear(left("0,0,-1"), {0, 1, 0});
    expectNear(left("0,0,1"), {0, -1, 0});
    expectNear(left("0,-3,0"), {0, 0, -1});
    expectNear(left("1,2,-3"), {-0.07928651f, 0.84142697f, 0.5345225f});
}

// ---- emitters

TEST(PointEmitter, PositionOrTransform) {
    const Scene scene = loadBody(
        R"(<emitter type="point" id="lamp"><point name="position" value="1,2,3"/><rgb name="intensity" value="5,6,7"/></emitter>
        <emitter type="point"><transform name="to_world"><translate y="4"/></transform></emitter>)");
    ASSERT_EQ(scene.pointEmitters.size(), 3u);
    EXPECT_EQ(scene.pointEmitters[1].id, "lamp");
    expectNear(scene.pointEmitters[1].position, {1, 2, 3});
    expectRgb(scene.pointEmitters[1].intensity, 5, 6, 7);
    expectNear(scene.pointEmitters[2].position, {0, 4, 0});
}

TEST(DirectionalEmitter, DirectionOrTransform) {
    const Scene scene = loadBody(
        R"(<emitter type="directional" id="sun"><vector name="direction" value="0,3,-4"/><rgb name="irradiance" value="5,6,7"/></emitter>
        <emitter type="directional"><transform name="to_world"><scale value="9"/><rotate y="1" angle="90"/><translate y="4"/></transform></emitter>)");
    ASSERT_EQ(scene.directionalEmitters.size(), 2u);
    EXPECT_EQ(scene.directionalEmitters[0].id, "sun");
    expectNear(scene.directionalEmitters[0].direction, {0, 0.6, -0.8});
    expectRgb(scene.directionalEmitters[0].irradiance, 5, 6, 7);
    expectNear(scene.directionalEmitters[1].direction, {1, 0, 0});
    expectRgb(scene.directionalEmitters[1].irradiance, 9, 9, 9); // as Mitsuba multiplies by the scale
}

// ---- files, parameters, references, settings

TEST(References, MayPointForwardsAndAreReadOnce) {
    const Scene scene =
        loadBody(R"(<shape type="cube"><ref id="paint"/></shape><shape type="cube"><ref id="paint"/></shape>
        <bsdf type="twosided" id="paint"><ref id="inner"/></bsdf><bsdf type="diffuse" id="inner"/>)");
    ASSERT_EQ(scene.bsdfs.size(), 1u);
    EXPECT_EQ(scene.bsdfs[0].id, "paint");
    EXPECT_EQ(scene.shapes[1].bsdf, 0);
    EXPECT_TRUE(scene.warnings.empty());
}

TEST(References, UnusedBsdfsAreReportedAndLeftOut) {
    const Scene scene = loadBody(R"(<bsdf type="diffuse" id="spare"/>)");
    EXPECT_TRUE(scene.bsdfs.empty());
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_THAT(scene.warnings[0], testing::HasSubstr("scene.xml:4:1: bsdf 'spare' is used by no shape"));
}

TEST(Documents, IncludesShareParametersAndNamesOfFilesAreRelativeToTheFileThatMentionsThem) {
    SceneFiles files;
    std::filesystem::create_directories(files.path("parts"));
    files.write("parts/mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    files.write("parts/part.xml",
                R"(<scene version="3.0.0"><?quasilux seed="9"?><default name="size" value="5"/><shape type="obj">
        <string name="filename" value="mesh.obj"/><transform name="to_world"><scale value="$size"/></transform></shape></scene>)");
    files.write("parts/paint.xml", R"(<bsdf version="3.0.0" type="diffuse" id="paint"/>)");
    const std::string path =
        files.write("scene.xml", sceneWith(R"(<default name="size" value="2"/><default name="sizes" value="3"/>
        <include filename="parts/part.xml"/><include filename="parts/paint.xml"/><shape type="sphere"><ref id="paint"/><float name="radius" value="$sizes"/></shape>)"));
    const Scene scene = loadScene(path);
    ASSERT_EQ(scene.shapes.size(), 2u);
    expectNear(scene.shapes[0].mesh.positions[1], {2, 0, 0});
    EXPECT_EQ(scene.shapes[1].sphere->radius, 3);
    EXPECT_EQ(scene.settings.seed, 9u);
    EXPECT_THAT(scene.shapes[0].where.text(), testing::EndsWith("parts/part.xml:1:77"));
    EXPECT_EQ(loadScene(path, {{"size", "7"}}).shapes[0].mesh.positions[1].x, 7);
}

// As Mitsuba: the folders of <path>, the last one first, then that of the scene, in included files too.
TEST(Documents, FilesAreLookedForInTheFoldersOfPathsAndOfTheScene) {
    SceneFiles files;
    for (const char* folder : {"parts", "meshes", "better"}) std::filesystem::create_directories(files.path(folder));
    const auto mesh = [](const std::string& x) { return "v 0 0 0\nv " + x + " 0 0\nv 0 1 0\nf 1 2 3\n"; };
    files.write("of_scene.obj", mesh("1"));
    files.write("parts/of_scene.obj", mesh("9"));
    files.write("parts/of_part.obj", mesh("2"));
    files.write("meshes/a.obj", mesh("3"));
    files.write("meshes/b.obj", mesh("9"));
    files.write("better/b.obj", mesh("4"));
    std::string shapes;
    for (const char* name : {"of_scene", "of_part", "a", "b"})
        shapes += std::string("<shape type=\"obj\"><string name=\"filename\" value=\"") + name + ".obj\"/></shape>";
    files.write("parts/part.xml", "<scene version=\"3.0.0\"><path value=\"../better\"/>" + shapes + "</scene>");
    const Scene scene = loadScene(files.write(
        "scene.xml", sceneWith(R"(<path value="meshes"/><path value="parts"/><include filename="part.xml"/>)")));
    ASSERT_EQ(scene.shapes.size(), 4u);
    // "parts" is nearer than the scene's own folder: the last of the paths but "better".
    const std::vector<float> found = {9, 2, 3, 4};
    for (size_t k = 0; k < found.size(); ++k) EXPECT_EQ(scene.shapes[k].mesh.positions[1].x, found[k]) << k;
    EXPECT_THAT(test::errorOf(files.write("bad.xml", sceneWith(R"(<path value="nowhere"/>)"))),
                testing::HasSubstr("bad.xml:4:1: the folder 'nowhere' does not exist"));
    EXPECT_THAT(
        test::errorOf(files.write("bad.xml", sceneWith(R"(<shape type="cube"><path value="meshes"/></shape>)"))),
        testing::HasSubstr("bad.xml:4:20: <path> may not stand in <shape>; put it into <scene>"));
}

// What scripts/compare_mitsuba.sh renders by both.
TEST(Documents, ScenesOfTheComparisonWithMitsubaLoad) {
    size_t scenes = 0;
    for (const auto& entry : std::filesystem::directory_iterator(QUASILUX_SOURCE_DIR "/tests/scenes/compare")) {
        if (entry.path().extension() != ".xml") continue; // images and volumes of the scenes
        EXPECT_EQ(loadScene(entry.path().string()).warnings.size(), 0u) << entry.path();
        ++scenes;
    }
    EXPECT_GE(scenes, 20u);
}

TEST(Documents, AnAliasIsASecondId) {
    SceneFiles files;
    const Scene scene = loadScene(files.write("scene.xml", sceneWith(R"(<bsdf type="dielectric" id="glass"/>
        <alias id="glass" as="window"/><alias id="window" as="pane"/><shape type="sphere"><ref id="pane"/></shape>)")));
    EXPECT_EQ(scene.bsdfs.at(static_cast<size_t>(scene.shapes.at(0).bsdf)).id, "glass");
    EXPECT_EQ(scene.warnings.size(), 0u);
    EXPECT_THAT(test::errorOf(files.write(
                    "bad.xml", sceneWith(R"(<bsdf type="dielectric" id="glass"/><alias id="glas" as="pane"/>)"))),
                testing::HasSubstr("bad.xml:4:37: no object has the id 'glas'. Did you mean 'glass'?"));
    EXPECT_THAT(
        test::errorOf(files.write("bad.xml", sceneWith(R"(<bsdf type="dielectric" id="a"/><alias id="a" as="a"/>)"))),
        testing::HasSubstr("bad.xml:4:33: the id 'a' is already in use"));
}

TEST(Documents, NamesOfMitsuba0AreUpgraded) {
    SceneFiles files;
    files.write("part.xml",
                R"(<shape version="3.0.0" type="sphere"><boolean name="flip_normals" value="true"/></shape>)");
    const Scene scene = loadScene(files.write("scene.xml", R"(<scene version="0.6.0"><default name="aSize" value="2"/>
        <sensor type="perspective"><float name="nearClip" value="0.5"/><transform name="toWorld"><lookAt origin="0,0,5" target="0,0,0"/></transform></sensor>
        <emitter type="point"/><shape type="rectangle"><boolean name="flipNormals" value="true"/><transform name="toWorld"><scale value="$aSize"/></transform>
        <bsdf type="diffuse"><texture type="checkerboard" name="reflectance"><float name="uscale" value="4"/><float name="uoffset" value="0.125"/><float name="voffset" value="0.25"/></texture></bsdf></shape>
        <include filename="part.xml"/></scene>)"));
    EXPECT_EQ(scene.sensor.nearClip, 0.5);
    EXPECT_TRUE(scene.shapes.at(0).flipNormals);
    EXPECT_TRUE(scene.shapes.at(1).flipNormals) << "a file of today within one of then";
    const auto& texture = scene.textures.at(0).device;
    EXPECT_EQ(texture.toU[0], 4);
    EXPECT_EQ(texture.toU[2], 0.5f) << "the offset is scaled, as by Mitsuba 3";
    EXPECT_EQ(texture.toV[2], 0.25f);
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_THAT(scene.warnings[0], testing::HasSubstr("names of parameters are upgraded"));
    EXPECT_THAT(
        test::errorOf(files.write(
            "bad.xml",
            R"(<scene version="3.0.0"><shape type="cube"><boolean name="flipNormals" value="true"/></shape></scene>)")),
        testing::HasSubstr("flipNormals"))
        << "control: not of version 3";
}

TEST(Documents, ParametersOfFormerVersionsAreRead) {
    SceneFiles files;
    files.write("grey.pgm", "P2 1 1 255 128");
    const auto sceneOf = [&](const std::string& version, const std::string& bsdf) {
        return files.write("scene.xml",
                           "<scene version=\"" + version +
                               R"("><sensor type="perspective"/><emitter type="point"/><shape type="rectangle">)" +
                               bsdf + "</shape></scene>");
    };
    const auto load = [&](const std::string& bsdf) { return loadScene(sceneOf("0.6.0", bsdf)); };
    const auto reflectance = [&](const std::string& value) {
        return load("<bsdf type=\"diffuse\"><srgb name=\"reflectance\" value=\"" + value + "\"/></bsdf>")
            .bsdfs.at(0)
            .front.at(0)
            .device.reflectance;
    };
    EXPECT_NEAR(reflectance("0.5, 0.25 0").r, 0.21404f, 1e-5f);
    EXPECT_NEAR(reflectance("#804000").r, 0.21586f, 1e-5f);
    const std::string named = R"(<bsdf type="diffuse"><rgb name="diffuseReflectance" value="0.25"/></bsdf>)";
    EXPECT_FLOAT_EQ(load(named).bsdfs.at(0).front.at(0).device.reflectance.r, 0.25f);
    const auto textured = [](const std::string& filter, const std::string& gamma) {
        return R"(<bsdf type="diffuse"><texture name="reflectance" type="bitmap"><string name="filename" value="grey.pgm"/>)" +
               ("<string name=\"filterType\" value=\"" + filter + "\"/>" + gamma) + "</texture></bsdf>";
    };
    const std::string linear = R"(<float name="gamma" value="1.0"/>)",
                      automatic = R"(<float name="gamma" value="-1"/>)";
    const auto texel = [&](const std::string& bsdf) { return load(bsdf).textures.at(0).texels.at(0).r; };
    EXPECT_NEAR(texel(textured("ewa", linear)), 128 / 255.f, 1e-4f);
    EXPECT_NEAR(texel(textured("trilinear", automatic)), 0.21586f, 1e-4f);
    EXPECT_EQ(load(textured("nearest", "")).textures.at(0).device.filter, unsigned(TEXTURE_NEAREST));
    const std::string metal =
        R"(<bsdf type="conductor"><float name="extEta" value="1"/><rgb name="eta" value="2"/></bsdf>)";
    EXPECT_FLOAT_EQ(load(metal).bsdfs.at(0).front.at(0).device.eta.r, 2);

    const std::string denser = R"(<bsdf type="conductor"><float name="extEta" value="1.3"/></bsdf>)";
    EXPECT_THAT(test::errorOf(sceneOf("0.6.0", denser)), testing::HasSubstr("ext_eta")) << "it would say something";
    EXPECT_THAT(test::errorOf(sceneOf("0.6.0", textured("ewa", R"(<float name="gamma" value="1.8"/>)"))),
                testing::HasSubstr("gamma"));
    EXPECT_THAT(test::errorOf(sceneOf("3.0.0", textured("ewa", ""))), testing::HasSubstr("filter")) << "control";
    EXPECT_THAT(test::errorOf(sceneOf("3.0.0", named)), testing::HasSubstr("diffuseReflectance")) << "control";
    EXPECT_THAT(
        test::errorOf(sceneOf("3.0.0", R"(<bsdf type="diffuse"><srgb name="reflectance" value="0.5"/></bsdf>)")),
        testing::HasSubstr("unknown element <srgb>"))
        << "control";
}

// Mitsuba 3.9.1 takes each of these, of 0.5 to 1.0.
TEST(Documents, TheFormerNameOfReflectanceMayNameATextureOrAFile) {
    SceneFiles files;
    files.write("grey.pgm", "P2 1 1 255 128");
    files.write("grey.spd", "400 0.2\n700 0.2\n");
    const auto load = [&](const std::string& color) {
        return loadScene(files.write("scene.xml", R"(<scene version="0.6.0"><sensor type="perspective"/>
            <emitter type="point"/><texture id="t" type="bitmap"><string name="filename" value="grey.pgm"/></texture>
            <shape type="rectangle"><bsdf type="diffuse">)" +
                                                      color + "</bsdf></shape></scene>"));
    };
    const std::string texture = R"(<texture name="diffuseReflectance" type="bitmap">
        <string name="filename" value="grey.pgm"/></texture>)";
    for (const std::string& color : {texture, std::string(R"(<ref id="t" name="diffuseReflectance"/>)")})
        EXPECT_NEAR(load(color).textures.at(0).texels.at(0).r, 0.21586f, 1e-4f) << color;
    const Scene scene = load(R"(<spectrum name="diffuseReflectance" filename="grey.spd"/>)");
    EXPECT_NEAR(scene.bsdfs.at(0).front.at(0).device.reflectance.g, 0.2f, 2e-3f);
}

TEST(Documents, CommentsOtherInstructionsAndByteOrderMarkAreNoMatter) {
    SceneFiles files;
    const Scene scene = loadScene(
        files.write("scene.xml", "\xef\xbb\xbf<?xml version=\"1.0\"?>\n<?editor x?><!-- a --><!DOCTYPE scene>\n" +
                                     sceneWith("<?editor fold?><!-- b --><shape type=\"cube\"/>")));
    EXPECT_EQ(scene.shapes.at(0).where.line, 6);
    EXPECT_EQ(scene.shapes.at(0).where.column, 26);
}

TEST(Settings, OfTheScene) {
    const SceneSettings none = loadBody("").settings;
    EXPECT_FALSE(none.bdd || none.variant || none.quasiSpecular || none.direct || none.photons || none.seed);
    const SceneSettings all = loadBody("<?quasilux bdd=\"2\" variant='alternative' quasi-specular=\"a,b\"\n "
                                       "direct=\"photons\" map=\"camera\" photons=\"1000\"?>"
                                       "<?quasilux seed=\"18446744073709551615\"?>")
                                  .settings;
    EXPECT_EQ(all.bdd, 2u);
    EXPECT_EQ(all.variant, Variant::alternative);
    EXPECT_EQ(all.quasiSpecular, "a,b");
    EXPECT_EQ(all.direct, DirectLight::photons);
    EXPECT_EQ(all.map, MapOrder::camera);
    EXPECT_EQ(all.photons, 1000u);
    EXPECT_EQ(all.seed, UINT64_MAX);
}

} // namespace
} // namespace quasilux

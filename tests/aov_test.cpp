// Layers of integrator 'aov' and alpha, of scenes where each value is known; channels and meanings are Mitsuba 3.9's.
#include "render/aovs.h"

#include "aov_types.h"
#include "render/pass_params.h"
#include "render/renderer.h"
#include "support/scene_files.h"
#include "support/test_kernels.h"

#include <cmath>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <map>

namespace quasilux {
namespace {

const std::string allLayers = "a:albedo,dd:depth, p.q:position,gn:geo_normal,sn:sh_normal,pi:prim_index,si:shape_index";

/// 8 x 4 pixels over x in [-1, 1] and y in [-0.5, 0.5], seen from (x, 0, 5) towards -z; the near plane is at z = 4.5.
Scene sceneOf(const std::string& shapes, const std::string& light = "<emitter type=\"point\"/>", double x = 0) {
    test::SceneFiles files;
    const std::string place = std::to_string(x);
    return loadScene(files.write(
        "scene.xml", R"(<scene version="3.0.0"><integrator type="aov"><string name="aovs" value=")" + allLayers +
                         R"("/><integrator type="path"/></integrator><sensor type="orthographic">
        <float name="near_clip" value="0.5"/><transform name="to_world"><lookat origin=")" +
                         place + ",0,5\" target=\"" + place +
                         R"(,0,0" up="0,1,0"/></transform><film type="hdrfilm"><rfilter
        type="box"/><string name="pixel_format" value="rgba"/><integer name="width" value="8"/><integer name="height"
        value="4"/></film></sensor>)" +
                         shapes + light + "</scene>"));
}

/// Channels by name, one value for each pixel.
std::map<std::string, std::vector<float>> channelsOf(const Scene& scene, unsigned samples = 64) {
    std::map<std::string, std::vector<float>> channels;
    for (const AovImage& layer : renderAovs(testDevice(), scene, RenderSettings{}, samples))
        for (size_t k = 0; k < layer.values.size(); ++k)
            channels[layer.channels[k % layer.channels.size()]].push_back(layer.values[k]);
    return channels;
}

std::string rectangle(const std::string& transform, const std::string& bsdf) {
    return "<shape type=\"rectangle\"><transform name=\"to_world\">" + transform + "</transform>" + bsdf + "</shape>";
}

const std::string diffuse = R"(<bsdf type="diffuse"><rgb name="reflectance" value="0.1,0.2,0.3"/></bsdf>)";
// Left of x = -0.5 the one, right of x = 0 the other, which is further away and shows its back.
const std::string twoShapes = rectangle(R"(<scale x="0.25"/><translate x="-0.75"/>)", diffuse) +
                              rectangle(R"(<scale x="0.5"/><rotate y="1" angle="180"/><translate x="0.5" z="-2"/>)",
                                        "<bsdf type=\"twosided\"><bsdf type=\"plastic\"/></bsdf>");

TEST(Aovs, AreNamedAsInMitsuba) {
    std::vector<std::string> names;
    for (const auto& layer : renderAovs(testDevice(), sceneOf(twoShapes), RenderSettings{}, 1))
        names.insert(names.end(), layer.channels.begin(), layer.channels.end());
    EXPECT_THAT(names, testing::ElementsAre("A", "a.R", "a.G", "a.B", "dd.T", "p.q.X", "p.q.Y", "p.q.Z", "gn.X", "gn.Y",
                                            "gn.Z", "sn.X", "sn.Y", "sn.Z", "pi.I", "si.I"));
}

TEST(Aovs, SayWhatIsMetFirst) {
    const auto c = channelsOf(sceneOf(twoShapes));
    const auto expectAt = [&](size_t pixel, const std::map<std::string, float>& values) {
        for (const auto& [name, value] : values) EXPECT_NEAR(c.at(name).at(pixel), value, 1e-5) << name << pixel;
    };
    // Pixel 9: second row, x in [-0.75, -0.5].
    expectAt(9, {{"A", 1},
                 {"a.R", 0.1f},
                 {"a.G", 0.2f},
                 {"a.B", 0.3f},
                 {"dd.T", 4.5f},
                 {"p.q.Z", 0},
                 {"gn.X", 0},
                 {"gn.Z", 1},
                 {"sn.Z", 1},
                 {"si.I", 1}});
    expectAt(14, {{"A", 1}, {"a.R", 0.5f}, {"dd.T", 6.5f}, {"p.q.Z", -2}, {"gn.Z", -1}, {"sn.Z", -1}, {"si.I", 2}});
    for (const auto& [name, values] : c) EXPECT_EQ(values.at(11), 0) << name << ": nothing is there";
    EXPECT_NEAR(c.at("p.q.X").at(9), -0.625, 0.01); // means over 64 places
    EXPECT_NEAR(c.at("p.q.Y").at(9), 0.125, 0.01);
    for (const float index : c.at("pi.I")) EXPECT_TRUE(index >= 0 && index <= 1) << "two triangles";
}

// As Mitsuba 3.9.1 shows it, whatever the share of metal, coat, sheen or transmission of a thin sheet. A rough coat is
// known by its fit.
TEST(Aovs, AlbedoIsTheBaseColor) {
    const std::string color = R"(<rgb name="base_color" value="0.8,0.4,0.2"/>)";
    const std::vector<std::string> bsdfs{
        "<bsdf type=\"principled\">" + color +
            R"(<float name="metallic" value="1"/><float name="roughness" value="0.1"/></bsdf>)",
        "<bsdf type=\"principled\">" + color +
            R"(<float name="metallic" value="0.5"/><float name="clearcoat" value="1"/><float name="sheen" value="1"/></bsdf>)",
        "<bsdf type=\"principledthin\">" + color +
            R"(<float name="diff_trans" value="1.2"/><float name="spec_trans" value="0.3"/></bsdf>)",
        R"(<bsdf type="roughplastic"><rgb name="diffuse_reflectance" value="0.8,0.4,0.2"/></bsdf>)"};
    std::string shapes;
    for (size_t k = 0; k < bsdfs.size(); ++k)
        shapes += rectangle(fmt::format(R"(<scale x="0.25"/><translate x="{}"/>)", -0.75 + 0.5 * double(k)), bsdfs[k]);
    const auto channels = channelsOf(sceneOf(shapes), 4);
    for (size_t k = 0; k < bsdfs.size(); ++k) {
        const float tolerance = k == 3 ? 0.05f : 1e-5f;
        EXPECT_NEAR(channels.at("a.R")[2 * k], 0.8, 0.8 * tolerance) << bsdfs[k];
        EXPECT_NEAR(channels.at("a.G")[2 * k], 0.4, 0.4 * tolerance) << bsdfs[k];
        EXPECT_NEAR(channels.at("a.B")[2 * k], 0.2, 0.2 * tolerance) << bsdfs[k];
    }
}

TEST(Aovs, PixelsAtAnEdgeAreMeans) {
    const auto c = channelsOf(sceneOf(rectangle(R"(<scale x="0.5"/><translate x="-0.625"/>)", diffuse)), 256);
    // Its right edge lies at x = -0.125, in the middle of pixel 11.
    EXPECT_NEAR(c.at("A").at(11), 0.5, 0.01);
    EXPECT_NEAR(c.at("a.B").at(11), 0.15, 0.003);
    EXPECT_NEAR(c.at("dd.T").at(11), 2.25, 0.045);
    EXPECT_NEAR(c.at("p.q.X").at(11), 0.5 * -0.1875, 0.003);
}

/// Layers by texture coordinates of one shape, 8 x 8 pixels.
std::map<std::string, std::vector<float>> uvChannelsOf(const std::string& shape, const std::string& sensor) {
    test::SceneFiles files;
    files.write("plain.obj", "v -1 -1 0\nv 1 -1 0\nv 0 1 0\nf 1 2 3\n");
    files.write("uv.obj", "v -1 -1 0\nv 1 -1 0\nv 0 1 0\nvt 0 0\nvt 2 0\nvt 0 1\nf 1/1 2/2 3/3\n");
    return channelsOf(
        loadScene(files.write("scene.xml", R"(<scene version="3.0.0"><integrator type="aov"><string name="aovs"
        value="uv:uv,du:dp_du,dv:dp_dv,dx:duv_dx,dy:duv_dy"/><integrator type="path"/></integrator>)" +
                                               sensor +
                                               R"(<transform name="to_world"><lookat origin="0,0,4" target="0,0,0"
        up="0,1,0"/></transform><film type="hdrfilm"><rfilter type="box"/><integer name="width" value="8"/><integer
        name="height" value="8"/></film></sensor><emitter type="constant"/>)" +
                                               shape + "</scene>")),
        256);
}

TEST(Aovs, GoByTextureCoordinatesAsInMitsuba) {
    // Row 5, column 3: means of mitsuba 3.9.1 over 1024 samples, scalar_rgb; its duv_… times 32, the root of the
    // samples.
    const char *perspective = R"(<sensor type="perspective"><float name="fov" value="40"/>)",
               *orthographic = R"(<sensor type="orthographic">)";
    const struct {
        const char *shape, *sensor;
        double tolerance;
        float values[12];
    } cases[] = {
        {R"(<shape type="rectangle"/>)",
         perspective,
         0.01,
         {0.4074f, 0.2246f, 2, 0, 0, 0, 2, 0, 0.1815f, 0, 0, -0.1787f}},
        {R"(<shape type="rectangle"><boolean name="flip_normals" value="true"/></shape>)",
         orthographic,
         0.01,
         {0.4364f, 0.3108f, 2, 0, 0, 0, 2, 0, 0.125f, 0, 0, -0.125f}},
        {R"(<shape type="rectangle"><transform name="to_world"><scale x="2" y="1.5"/><rotate z="1" angle="90"/></transform></shape>)",
         orthographic,
         0.01,
         {0.4054f, 0.5424f, 0, 4, 0, -3, 0, 0, 0, -0.0833f, -0.0625f, 0}},
        {R"(<shape type="sphere"/>)",
         orthographic,
         0.02,
         {0.6984f, 0.1334f, 2.3774f, -0.7995f, 0, -0.8952f, -2.6678f, -1.2741f, 0.0946f, -0.0274f, 0.0316f, 0.0816f}},
        {R"(<shape type="cube"/>)", orthographic, 0.01, {0.3108f, 0.4364f, 0, 2, 0, 2, 0, 0, 0, 0.125f, -0.125f, 0}},
        {R"(<shape type="obj"><string name="filename" value="uv.obj"/></shape>)",
         orthographic,
         0.01,
         {0.562f, 0.6892f, 1, 0, 0, -1, -2, 0, 0.25f, 0, 0.125f, 0.125f}},
        {R"(<shape type="obj"><string name="filename" value="plain.obj"/></shape>)",
         orthographic,
         0.01,
         {0.281f, 0.3108f, 2, 0, 0, 1, 2, 0, 0.125f, 0, 0.0625f, -0.125f}}};
    const std::vector<std::string> names = {"uv.U", "uv.V", "du.X", "du.Y", "du.Z", "dv.X",
                                            "dv.Y", "dv.Z", "dx.U", "dx.V", "dy.U", "dy.V"};
    for (const auto& c : cases) {
        const auto channels = uvChannelsOf(c.shape, c.sensor);
        ASSERT_EQ(channels.size(), names.size());
        for (size_t k = 0; k < names.size(); ++k)
            EXPECT_NEAR(channels.at(names[k]).at(5 * 8 + 3), c.values[k], c.tolerance) << c.shape << names[k];
    }
}

TEST(Aovs, PlacesFarFromTheOriginAreThoseOfTheFile) {
    const auto c = channelsOf(sceneOf(rectangle(R"(<translate x="100000"/>)", diffuse),
                                      "<emitter type=\"point\"><point "
                                      "name=\"position\" value=\"100000,0,3\"/></emitter>",
                                      100000));
    EXPECT_NEAR(c.at("p.q.X").at(9), 100000 - 0.625, 0.02);
    EXPECT_NEAR(c.at("dd.T").at(9), 4.5, 1e-4);
}

TEST(Aovs, AlphaPassesNullSurfacesAndIsOneBeforeSurroundings) {
    const std::string null = rectangle(R"(<translate z="1"/>)", "<bsdf type=\"null\"/>");
    EXPECT_EQ(channelsOf(sceneOf(null)).at("A").at(9), 0);
    EXPECT_EQ(channelsOf(sceneOf(null)).at("si.I").at(9), 1) << "it is met all the same";
    EXPECT_EQ(channelsOf(sceneOf(null + twoShapes)).at("A").at(9), 1);
    EXPECT_EQ(channelsOf(sceneOf(null + twoShapes)).at("A").at(11), 0);
    EXPECT_EQ(channelsOf(sceneOf(twoShapes, "<emitter type=\"constant\"/>")).at("A").at(11), 1);
    EXPECT_EQ(channelsOf(sceneOf(rectangle("", "<bsdf type=\"conductor\"/>"))).at("a.R").at(9), 0)
        << "no diffuse light";
}

TEST(Aovs, AlphaPassesTheEmittersThatAreHidden) {
    const std::string light = rectangle(R"(<scale x="0.25"/><translate x="0.25" z="1"/>)", "<emitter type=\"area\"/>");
    for (const bool hide : {false, true}) {
        Scene scene = sceneOf(light + twoShapes, "<emitter type=\"constant\"/>");
        scene.hideEmitters = hide;
        const std::vector<float> alpha = channelsOf(scene).at("A");
        EXPECT_EQ(alpha.at(9), 1) << "a shape";
        EXPECT_EQ(alpha.at(11), hide ? 0 : 1) << "the surroundings";
        EXPECT_EQ(alpha.at(12), 1) << "the light, and a shape behind it";
        scene = sceneOf(light);
        scene.hideEmitters = hide;
        EXPECT_EQ(channelsOf(scene).at("A").at(12), hide ? 0 : 1) << "the light alone";
    }
}

/// Of the pixels in the middle; the light is a point's.
float alphaBehind(const std::string& shapes) { return channelsOf(sceneOf(shapes)).at("A").at(12); }

std::string squareAt(double z, const std::string& bsdf) {
    return fmt::format(
        R"(<shape type="rectangle"><transform name="to_world"><translate z="{}"/></transform>{}</shape>)", z, bsdf);
}

// As much as does not come straight through.
TEST(Aovs, AlphaOfWhatLetsLightPass) {
    const std::string mask = R"(<bsdf type="mask"><float name="opacity" value="0.25"/><bsdf type="diffuse"/></bsdf>)";
    EXPECT_NEAR(alphaBehind(squareAt(0, mask)), 0.25, 1e-6);
    EXPECT_NEAR(alphaBehind(squareAt(0, mask) + squareAt(-1, mask)), 1 - 0.75 * 0.75, 1e-6);
    EXPECT_EQ(alphaBehind(squareAt(0, mask) + squareAt(-1, "")), 1);
    const double fresnel = 0.04, pane = 2 * fresnel / (1 + fresnel);
    EXPECT_NEAR(alphaBehind(squareAt(0, R"(<bsdf type="thindielectric"><float name="int_ior" value="1.5"/>
        <float name="ext_ior" value="1"/></bsdf>)")),
                pane, 1e-5);
    EXPECT_EQ(alphaBehind(squareAt(0, R"(<bsdf type="null"/>)")), 0);
    const std::string fog = R"(<shape type="cube"><bsdf type="null"/><medium name="interior" type="homogeneous"><float
        name="sigma_t" value="SIGMA"/><float name="albedo" value="0.9"/></medium></shape>)";
    const auto ofExtinction = [&](const std::string& sigma) {
        return std::string(fog).replace(fog.find("SIGMA"), 5, sigma);
    };
    EXPECT_NEAR(alphaBehind(ofExtinction("1")), 1 - std::exp(-2), 1e-5);
    EXPECT_NEAR(alphaBehind(ofExtinction("1") + squareAt(-2, mask)), 1 - 0.75 * std::exp(-2), 1e-5);
}

// The near plane, at z = 4.5, lies in the fog.
TEST(Aovs, AlphaBeginsOnTheNearPlane) {
    EXPECT_NEAR(alphaBehind(R"(<shape type="cube"><transform name="to_world"><translate z="5"/></transform>
        <bsdf type="null"/><medium name="interior" type="homogeneous"><float name="sigma_t" value="1"/></medium></shape>)"),
                1 - std::exp(-0.5), 1e-5);
}

void resize(Sensor& sensor, unsigned width, unsigned height) {
    sensor.width = sensor.filmWidth = width;
    sensor.height = sensor.filmHeight = height;
}

/// 96 x 64 pixels; and what its layers take on a device.
struct Rendered {
    std::vector<AovImage> layers;
    std::map<std::string, uint64_t> buffers;
};
Rendered renderLarge(Device& device, uint64_t seed = 1) {
    Scene scene = sceneOf(twoShapes);
    resize(scene.sensor, 96, 64);
    scene.aovs.push_back({"uv", AovQuantity::uv});
    RenderSettings settings;
    settings.seed = seed;
    Rendered rendered;
    const AllocationNotes noting(device, rendered.buffers);
    rendered.layers = renderAovs(device, scene, settings, 16);
    EXPECT_EQ(rendered.buffers, planAovs(scene, flattenFor(scene, settings), device.info()));
    return rendered;
}

bool haveTheSameBits(const Rendered& a, const Rendered& b) {
    return std::equal(a.layers.begin(), a.layers.end(), b.layers.begin(), b.layers.end(),
                      [](const AovImage& x, const AovImage& y) { return x.values == y.values; });
}

TEST(Aovs, InTilesHaveTheSameBits) {
    Device small(-1, testDevice().workGroupSize(), 0, 0, 1'000'000);
    const Rendered whole = renderLarge(testDevice()), tiles = renderLarge(small);
    EXPECT_EQ(whole.buffers.at("aovs"), 96u * 64 * AOV_ALL_FLOATS * sizeof(float));
    EXPECT_LT(tiles.buffers.at("aovs"), 130'000u) << "no row ends where a tile does";
    ASSERT_EQ(whole.layers.size(), 9u);
    EXPECT_TRUE(haveTheSameBits(tiles, whole));
    EXPECT_FALSE(haveTheSameBits(renderLarge(small, 2), whole)) << "negative control: another seed";
}

/// Triangles one behind the other, the first ones densely: their tree is deep, and a ray leaves much of it behind.
void makeLayers(ShapeDescription& shape, unsigned triangles) {
    shape.mesh = {};
    for (unsigned k = 0; k < triangles; ++k) {
        const float z = 1 - 1e-3f * std::pow(1.0025f, static_cast<float>(k));
        for (const glm::vec2 corner : {glm::vec2(-3, -3), glm::vec2(3, -3), glm::vec2(0, 4)})
            shape.mesh.positions.emplace_back(corner, z);
        shape.mesh.triangles.emplace_back(3 * k, 3 * k + 1, 3 * k + 2);
    }
}

TEST(Aovs, OfARendererAreTheSame) {
    Scene scene = sceneOf(twoShapes);
    makeLayers(scene.shapes[0], 4000);
    RenderSettings settings;
    settings.photonsPerPass = 1000;
    EXPECT_GT(flattenFor(scene, settings).bvh.depth, 5u) << "32 entries of a stack are not enough";
    Renderer renderer(testDevice(), scene, settings);
    for (unsigned pass = 0; pass < 3; ++pass) renderer.renderPass(pass);
    const auto launches = [] {
        const auto timings = testDevice().timings();
        return timings.count("traceAovs") ? timings.at("traceAovs").launches : 0;
    };
    const auto before = launches();
    const Rendered ofRenderer{renderer.layers(scene), {}};
    EXPECT_EQ(launches(), before) << "they are no part of the passes";
    EXPECT_TRUE(haveTheSameBits(ofRenderer, {renderAovs(testDevice(), scene, settings, 3), {}}));
    EXPECT_FALSE(haveTheSameBits(ofRenderer, {renderAovs(testDevice(), scene, settings, 4), {}})) << "negative control";
}

/// One that allows 1 GiB in a buffer, and is no CPU.
DeviceInfo deviceOf(uint64_t memory) {
    DeviceInfo device;
    device.globalMemory = memory;
    device.maximumAllocation = 1u << 30;
    device.computeUnits = 2;
    return device;
}

// Film, image and alpha, with room for the process itself.
TEST(Aovs, AlphaOfALargeFilmFitsInEightGigabytes) {
    Scene scene = sceneOf(twoShapes);
    scene.aovs.clear();
    resize(scene.sensor, 8192, 8192);
    RenderSettings settings;
    settings.film = {false, false};
    settings.photonsPerPass = 1'000'000;
    const DeviceScene flat = flattenFor(scene, settings);
    const DeviceInfo device = deviceOf(8'000'000'000);
    const BufferSizes passes = planPass(flat, settings, 1'000'000, device), layers = planAovs(scene, flat, device);
    EXPECT_NO_THROW(checkFits(passes, device, flat, settings));
    EXPECT_NO_THROW(checkFits(layers, device, flat, settings));
    constexpr uint64_t pixels = uint64_t(8192) * 8192, ofAlpha = pixels * sizeof(float), ofProcess = 400'000'000;
    EXPECT_LT(ofProcess + sumOf(passes) + developBytes(flat, settings) + ofAlpha, 8'000'000'000u);
    EXPECT_LT(ofProcess + sumOf(layers) + imageBytes(flat, settings) + ofAlpha, 3'000'000'000u);
    settings.film = {};
    EXPECT_GT(sumOf(planPass(flat, settings, 1'000'000, device)), 8'000'000'000u) << "control";
}

// What they take on the host beside the image is forecast, and comes when the film is gone.
TEST(Aovs, ForecastHasTheLayers) {
    Scene scene = sceneOf(twoShapes);
    resize(scene.sensor, 2048, 2048);
    const RenderSettings settings;
    const DeviceScene flat = flattenFor(scene, settings);
    const DeviceInfo gpu = deviceOf(8'000'000'000);
    const auto bytes = [&] { return double(withLayers({1, 1}, scene, flat, settings, gpu).hostPeakBytes); };
    const double all = bytes();
    EXPECT_EQ(withLayers({1, 1}, scene, flat, settings, gpu).deviceBytes, sumOf(planAovs(scene, flat, gpu)));
    EXPECT_EQ(withLayers({uint64_t(1) << 40, 1}, scene, flat, settings, gpu).deviceBytes, uint64_t(1) << 40);
    scene.aovs.resize(1);                                 // albedo
    const double ofTwelveFloats = 12.0 * 4 * 2048 * 2048; // less: this process hardly changes between the two
    EXPECT_NEAR(all - bytes(), ofTwelveFloats, 0.05 * ofTwelveFloats);
}

// Depth and normals of a model that nothing lights.
TEST(Aovs, NeedNoLight) {
    const Scene dark = sceneOf(twoShapes, "");
    EXPECT_THAT(dark.warnings, testing::ElementsAre(testing::HasSubstr("the scene has no emitter")));
    EXPECT_EQ(channelsOf(dark), channelsOf(sceneOf(twoShapes)));
    EXPECT_NE(channelsOf(dark), channelsOf(sceneOf(twoShapes, "", 0.1))) << "control";
}

TEST(Aovs, AreNotTracedUnlessAskedFor) {
    test::SceneFiles files;
    const Scene scene = loadScene(files.write("scene.xml", test::sceneWith(diffuse)));
    EXPECT_TRUE(renderAovs(testDevice(), scene, RenderSettings{}, 1).empty());
}

} // namespace
} // namespace quasilux

// <bsdf type="principledthin">: its transmitting lobes against their formulas in double, their samplers against their
// densities, and sheets by photons as by emitter sampling. False-alarm rate of the tests of samplers 1e-4 together;
// renders are held to 4 standard errors of 10 batches (Student t: 0.3 % each) plus 0.5 %. Seeds are fixed.
#include "scene/bsdfs/bsdf_plugin.h"
#include "support/chi_squared.h"
#include "support/lobe_cases.h"
#include "support/lobe_coordinates.h"
#include "support/render_statistics.h"
#include "support/scene_files.h"

#include <cmath>
#include <gmock/gmock.h>
#include <numbers>
#include <random>

namespace quasilux {
namespace {

using glm::dvec3;
using std::numbers::pi;
using testing::HasSubstr;

constexpr int radiance = 0, flux = 1; // TRANSPORT_*
constexpr int statisticalTests = 8;
constexpr size_t sampleCount = 100000;

shared::Lobe sheet(float alphaU, float alphaV) {
    shared::Lobe lobe = makeLobe(LOBE_THINGGX);
    lobe.reflectance = {0, 0, 0};
    lobe.eta.r = 1.5f;
    lobe.alphaU = alphaU;
    lobe.alphaV = alphaV;
    return lobe;
}
shared::Lobe paper() {
    shared::Lobe lobe = makeLobe(LOBE_DIFFUSETRANSMISSION);
    lobe.reflectance = {0, 0, 0};
    return lobe;
}
dvec3 mirrored(const dvec3& v) { return {v.x, v.y, -v.z}; }

/// f of radiance from the light to the observer, in double.
double formula(shared::Lobe lobe, const dvec3& observer, const dvec3& light) {
    if (lobe.type == LOBE_DIFFUSETRANSMISSION) return light.z < 0 ? 1 / pi : 0;
    const dvec3 m = mirrored(light), h = glm::normalize(observer + m);
    if (light.z >= 0 || glm::dot(light, h) >= 0) return 0;
    lobe.type = LOBE_GGX;
    return (1 - dielectricReflectance(glm::dot(observer, h), double(lobe.eta.r))) * microfacetDistribution(lobe, h) *
           microfacetShadowing(lobe, observer) * microfacetShadowing(lobe, m) / (4 * observer.z * m.z);
}

std::vector<shared::Lobe> lobes() { return {paper(), sheet(0.3f, 0.3f), sheet(0.1f, 0.4f), sheet(0.9f, 0.9f)}; }

TEST(ThinLobes, AgreeWithTheirFormulasAndTransmitOnly) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> number(-1, 1);
    const auto direction = [&] {
        return dvec3(glm::vec3(glm::normalize(dvec3(number(random), number(random), number(random)))));
    };
    for (const shared::Lobe& lobe : lobes()) {
        std::vector<dvec3> wo, wi;
        for (int k = 0; k < 3000; ++k) {
            dvec3 o = direction();
            o.z = std::abs(o.z);
            wo.push_back(o);
            wi.push_back(direction());
        }
        const auto values = evaluateLobe(lobe, wo, wi);
        for (size_t k = 0; k < wo.size(); ++k) {
            if (std::min(wo[k].z, std::abs(wi[k].z)) < 1e-3) continue;
            const double exact = formula(lobe, wo[k], wi[k]);
            ASSERT_NEAR(values[k].f.y, exact, 2e-4 * exact + 1e-9) << k;
        }
    }
}

TEST(ThinLobes, SamplesFollowTheirDensity) {
    const SampleGrid grid{-1, 0, -pi, pi, 10, 12};
    const auto wrongOf = [](shared::Lobe lobe) {
        lobe.alphaU *= 1.1f;
        return lobe;
    };
    for (const shared::Lobe& lobe : {paper(), sheet(0.3f, 0.3f), sheet(0.2f, 0.5f)})
        for (const double cosine : {0.9, 0.5}) {
            const dvec3 wo = outgoing(cosine);
            std::vector<uint64_t> counts(grid.cells() + 1);
            for (const auto& s : sampleLobe(lobe, wo, uniformNumbers(3 * sampleCount, 41)))
                ++counts[s.valid ? grid.cell(s.wi.z, std::atan2(s.wi.y, s.wi.x)) : grid.cells()];
            const auto fit = [&](const shared::Lobe& tested) {
                std::vector<double> expected;
                const auto points = gridQuadrature(grid, 24);
                std::vector<dvec3> wi;
                for (const QuadraturePoint& p : points) {
                    const double sine = std::sqrt(1 - p.u * p.u);
                    wi.emplace_back(sine * std::cos(p.v), sine * std::sin(p.v), p.u);
                }
                const auto values = evaluateLobe(tested, std::vector(wi.size(), wo), wi);
                expected.assign(grid.cells(), 0);
                for (size_t k = 0; k < points.size(); ++k)
                    if (values[k].f.y > 0)
                        expected[grid.cell(points[k].u, points[k].v)] += values[k].pdf * points[k].weight;
                return chiSquaredPValue(counts, expected);
            };
            EXPECT_GT(fit(lobe), significanceLevel(statisticalTests)) << cosine;
            if (lobe.type == LOBE_THINGGX) {
                EXPECT_LT(fit(wrongOf(lobe)), significanceLevel(statisticalTests)) << "negative control";
            }
        }
}

TEST(ThinLobes, WeightsAreThoseOfRadianceAndOfFlux) {
    for (const shared::Lobe& lobe : lobes())
        for (const int transport : {radiance, flux}) {
            const dvec3 wo = outgoing(0.4);
            size_t valid = 0;
            for (const auto& s : sampleLobe(lobe, wo, uniformNumbers(3 * 2000, 42), transport)) {
                const double f =
                    transport == radiance ? formula(lobe, wo, s.wi) : formula(lobe, mirrored(s.wi), mirrored(wo));
                if (!s.valid || s.wi.z > -1e-3) continue;
                ++valid;
                ASSERT_LT(s.wi.z, 0);
                ASSERT_NEAR(s.weight.y * s.pdf, f * -s.wi.z, 1e-3 * f + 1e-6);
            }
            EXPECT_GT(valid, 300u); // rough sheets lose much, as in Mitsuba
        }
}

TEST(ThinLobes, EstimateTheirAlbedo) {
    for (const shared::Lobe& lobe : lobes())
        for (const double cosine : {1.0, 0.5, 0.1}) {
            const dvec3 wo = outgoing(cosine);
            double sum = 0;
            for (const auto& s : sampleLobe(lobe, wo, uniformNumbers(3 * 20000, 43))) sum += s.valid ? s.weight.y : 0;
            const double albedo = sum / 20000, estimate = lobeAlbedos(lobe, {wo})[0].y;
            EXPECT_LE(albedo, 1.001);
            EXPECT_GT(estimate, 0.5 * albedo) << cosine;
            EXPECT_LT(estimate, 5 * albedo) << cosine; // without what shadowing takes
        }
}

// --- reading ---

Bsdf thin(const std::string& parameters) {
    const Scene scene =
        test::loadBody("<shape type=\"rectangle\"><bsdf type=\"principledthin\">" + parameters + "</bsdf></shape>");
    return scene.bsdfs.at(0);
}
std::string number(const std::string& name, double value) {
    return "<float name=\"" + name + "\" value=\"" + std::to_string(value) + "\"/>";
}

TEST(PrincipledThin, IsTheSumOfItsLobesOnBothSides) {
    const Bsdf plain = thin("");
    ASSERT_EQ(plain.front.size(), 1u);
    EXPECT_EQ(plain.front[0].device.type, unsigned(LOBE_PRINCIPLEDDIFFUSE));
    EXPECT_FLOAT_EQ(plain.front[0].device.reflectance.g, 0.5f);
    const Bsdf all = thin(number("spec_trans", 0.25) + number("diff_trans", 0.8) + number("sheen", 0.5) +
                          number("spec_tint", 0.2) + number("eta", 1.6) + number("roughness", 0.6));
    ASSERT_EQ(all.front.size(), 6u);
    ASSERT_EQ(all.back.size(), 6u);
    const auto& f = all.front;
    EXPECT_FLOAT_EQ(f[0].device.reflectance.r, float(0.5 * 0.75 * 0.6));
    EXPECT_EQ(f[1].device.type, unsigned(LOBE_SHEEN));
    EXPECT_FLOAT_EQ(f[1].device.reflectance.r, float(0.5 * 0.75 * 0.6));
    EXPECT_EQ(f[2].device.type, unsigned(LOBE_DIFFUSETRANSMISSION));
    EXPECT_FLOAT_EQ(f[2].device.transmittance.r, float(0.5 * 0.75 * 0.4));
    EXPECT_EQ(f[3].device.type, unsigned(LOBE_GGX));
    EXPECT_FLOAT_EQ(f[3].device.reflectance.r, float(0.25 * 0.8));
    EXPECT_FLOAT_EQ(f[3].device.alphaU, 0.36f);
    EXPECT_EQ(f[4].device.type, unsigned(LOBE_GGXSCHLICK));
    EXPECT_FLOAT_EQ(f[4].device.k.r, float(0.25 * 0.2));
    EXPECT_EQ(f[5].device.type, unsigned(LOBE_THINGGX));
    EXPECT_FLOAT_EQ(f[5].device.transmittance.r, float(0.5 * 0.25));
    EXPECT_NEAR(f[5].device.alphaU, std::pow((0.65 * 1.6 - 0.35) * 0.6, 2), 1e-6);
    EXPECT_EQ(thin(number("spec_trans", 1) + number("eta", 1)).front.size(), 1u) << "no index, no reflection";
    EXPECT_EQ(thin(number("spec_trans", 1) + number("eta", 0.8)).front.size(), 2u) << "below 1 there is one again";
    const Bsdf ofColor = thin(number("spec_trans", 1) + "<rgb name=\"eta\" value=\"1,1.2,2\"/>");
    EXPECT_FLOAT_EQ(ofColor.front[0].device.eta.g, 1.4f) << "the mean, as in Mitsuba";
}

TEST(PrincipledThin, SaysWhatIsWrong) {
    test::SceneFiles files;
    const std::pair<std::string, const char*> bad[] = {
        {"\n<float name=\"diff_trans\" value=\"2.5\"/>", "scene.xml:5:1: parameter 'diff_trans' is 2.5; expected 0"},
        {"\n<float name=\"eta\" value=\"0\"/>",
         "scene.xml:5:1: parameter 'eta' of bsdf 'principledthin' is 0; it must be greater than 0"},
        {"\n<float name=\"metallic\" value=\"0.9\"/>",
         "scene.xml:5:1: unknown parameter 'metallic' of bsdf 'principledthin'"},
        {"<texture type=\"checkerboard\" name=\"eta\">\n<rgb name=\"color0\" value=\"1,-1,1\"/></texture>",
         "scene.xml:5:1: parameter 'color0'"},
        {"\n<texture type=\"checkerboard\" name=\"ETA\"/>",
         "scene.xml:5:1: bsdf 'principledthin' takes no texture as 'ETA'"}};
    for (const auto& [parameters, message] : bad)
        EXPECT_THAT(test::errorOf(files.write(
                        "scene.xml", test::sceneWith("<shape type=\"rectangle\"><bsdf type=\"principledthin\">" +
                                                     parameters + "</bsdf></shape>"))),
                    HasSubstr(message));
}

// --- renders ---

/// Mean of the image of a sheet under a lamp, seen from above or, by what it transmits, from below.
MeanAndError sheetSeen(bool fromBelow, DirectLight direct, const std::string& quasiSpecular) {
    test::SceneFiles files;
    const Scene scene = loadScene(files.write(
        "scene.xml",
        R"(<scene version="3.0.0"><integrator type="path"/><sensor type="perspective"><float name="fov" value="20"/><transform name="to_world">
        <lookat origin="1,-2,)" +
            std::string(fromBelow ? "-3" : "3") +
            R"(" target="0,0,0" up="0,1,0"/></transform><film type="hdrfilm"><rfilter type="box"/>
        <integer name="width" value="8"/><integer name="height" value="8"/></film></sensor>
        <shape type="rectangle"><transform name="to_world"><scale value="3"/></transform><bsdf type="principledthin"><rgb name="base_color"
        value="0.8"/><float name="roughness" value="0.7"/><float name="spec_trans" value="0.5"/><float name="diff_trans" value="0.9"/></bsdf></shape>
        <shape type="rectangle"><transform name="to_world"><scale value="0.7"/><rotate x="1" angle="180"/><translate x="-1" y="1" z="3"/></transform>
        <emitter type="area"><rgb name="radiance" value="4"/></emitter></shape></scene>)"));
    RenderSettings settings;
    settings.direct = direct;
    settings.quasiSpecular = quasiSpecular;
    settings.quasiSpecularOverridesScene = true;
    settings.photonsPerPass = 10000;
    return renderGroups(scene, settings, std::vector<int>(64, 0), 10, 4).front();
}

TEST(PrincipledThin, IsTheSameByPhotonsAsByEmitters) {
    const auto differ = [](const MeanAndError& a, double other, double otherError) {
        return std::abs(a.mean - other) > 4 * std::hypot(a.standardError, otherError) + 0.005 * other;
    };
    for (const bool fromBelow : {false, true})
        for (const char* split : {"none", "all"}) {
            const auto sampled = sheetSeen(fromBelow, DirectLight::emitters, split),
                       photons = sheetSeen(fromBelow, DirectLight::photons, split);
            EXPECT_GT(sampled.mean, 0.01);
            EXPECT_FALSE(differ(photons, sampled.mean, sampled.standardError))
                << fromBelow << split << " " << photons.mean << " " << sampled.mean;
            EXPECT_TRUE(differ(photons, 1.05 * sampled.mean, sampled.standardError)) << "negative control";
        }
}

} // namespace
} // namespace quasilux

#include "support/lobe_cases.h"

#include "bsdf/lobe_list.h"
#include "support/float_rounding.h"
#include "support/test_kernels.h"

#include <cmath>
#include <fmt/format.h>
#include <map>

namespace quasilux {

namespace {

Program& program(const std::string& options) {
    static std::map<std::string, Program> built;
    const auto found = built.find(options);
    return found != built.end() ? found->second
                                : built.emplace(options, testProgram("lobes.cl", options)).first->second;
}

std::vector<float> flat(const std::vector<glm::dvec3>& vectors) {
    std::vector<float> values;
    values.reserve(3 * vectors.size());
    for (const glm::dvec3& v : vectors) values.insert(values.end(), {float(v.x), float(v.y), float(v.z)});
    return values;
}

glm::dvec3 tripleAt(const std::vector<float>& values, size_t first) {
    return {values[first], values[first + 1], values[first + 2]};
}

} // namespace

shared::Lobe makeLobe(unsigned type) {
    shared::Lobe lobe{};
    lobe.type = type;
    lobe.reflectance = lobe.transmittance = {1, 1, 1};
    lobe.k = {1, 1, 1}; // with eta = 0 the Fresnel factor is 1
    lobe.alphaU = lobe.alphaV = 0.1f;
    return lobe;
}

/// The parts of `principled`.
static void addPrincipledCases(std::vector<LobeCase>& cases) {
    for (const float flatness : {0.0f, 0.7f}) {
        cases.push_back({fmt::format("principled diffuse {}", flatness), makeLobe(LOBE_PRINCIPLEDDIFFUSE)});
        cases.back().lobe.alphaU = 0.5f;
        cases.back().lobe.exponent = flatness;
    }
    cases.push_back({"sheen", makeLobe(LOBE_SHEEN)});
    cases.push_back({"ggx schlick", makeLobe(LOBE_GGXSCHLICK)});
    cases.back().lobe.eta = {0.6f, 0.6f, 0.6f};
    cases.back().lobe.k = {0.9f, 0.9f, 0.9f};
    cases.back().lobe.alphaU = cases.back().lobe.alphaV = 0.3f;
    for (const float alpha : {0.1f, 0.001f}) {
        cases.push_back({fmt::format("clearcoat {}", alpha), makeLobe(LOBE_CLEARCOAT)});
        cases.back().lobe.alphaU = alpha;
    }
}

std::vector<LobeCase> finiteLobes() {
    std::vector<LobeCase> cases{{"lambert", makeLobe(LOBE_LAMBERT)}, {"coated lambert", makeLobe(LOBE_COATEDLAMBERT)}};
    cases.back().lobe.eta.r = 1.5f;
    cases.back().lobe.exponent = 0.908f; // what a coat of this index lets in of diffuse light
    cases.push_back({"rough coated lambert", makeLobe(LOBE_ROUGHCOATEDLAMBERT)});
    shared::Lobe& coated = cases.back().lobe; // T = 0.3 + 0.9 x - 0.4 x^3 in x = cos / (cos + 0.2)
    coated.coat[0] = 0.3f;
    coated.coat[1] = 0.9f;
    coated.coat[3] = -0.4f;
    coated.alphaU = 0.2f;
    coated.alphaV = 0;
    coated.exponent = 0.796f;
    cases.push_back({"rough low coated lambert", cases.back().lobe});
    shared::Lobe& low = cases.back().lobe; // below a critical angle of 42 degrees nearly nothing, by the other variable
    low.eta = {2 / 3.0f, 1, 0};
    low.alphaV = 0.1f;
    for (float& factor : low.coat) factor = 0;
    low.coat[2] = 0.5f;
    low.coat[4] = 0.4f;
    low.exponent = 0.2645f;
    for (float exponent : {0.0f, 1.0f, 30.0f, 1000.0f, 1e5f}) {
        cases.push_back({fmt::format("phong {}", exponent), makeLobe(LOBE_PHONG)});
        cases.back().lobe.exponent = exponent;
    }
    const float roughness[][2] = {{1e-3f, 1e-3f}, {0.03f, 0.03f}, {0.3f, 0.3f}, {1.0f, 1.0f}, {0.05f, 0.4f}};
    for (unsigned type : {LOBE_GGX, LOBE_BECKMANN})
        for (const auto& alpha : roughness) {
            cases.push_back(
                {fmt::format("{} {} {}", type == LOBE_GGX ? "ggx" : "beckmann", alpha[0], alpha[1]), makeLobe(type)});
            cases.back().lobe.alphaU = alpha[0];
            cases.back().lobe.alphaV = alpha[1];
        }
    addPrincipledCases(cases);
    return cases;
}

glm::dvec3 outgoing(double cosine) {
    const double sine = std::sqrt(1 - cosine * cosine);
    return roundToFloat(glm::dvec3(sine * std::cos(0.7), sine * std::sin(0.7), cosine));
}

std::vector<double> outgoingCosines() { return {1.0, 0.9, 0.5, 0.1, 0.01}; }

std::vector<SampledDirection> sampleLobe(const shared::Lobe& lobe, glm::dvec3 wo, const std::vector<float>& numbers,
                                         int transport) {
    const size_t count = numbers.size() / 3;
    Buffer<shared::Lobe> lobes(testDevice(), std::vector{lobe}, "lobe");
    Buffer<float> in(testDevice(), numbers, "numbers"), out(testDevice(), 8 * count, "samples");
    program(allLobes)
        .kernel("sampleLobe")
        .launch(count, lobes, float(wo.x), float(wo.y), float(wo.z), cl_int(transport), in, out, cl_uint(count));
    const auto values = out.read();
    std::vector<SampledDirection> samples(count);
    for (size_t i = 0; i < count; ++i)
        samples[i] = {tripleAt(values, 8 * i), tripleAt(values, 8 * i + 3), values[8 * i + 6], values[8 * i + 7] != 0};
    return samples;
}

std::vector<EvaluatedDirection> evaluateLobe(const shared::Lobe& lobe, const std::vector<glm::dvec3>& wo,
                                             const std::vector<glm::dvec3>& wi, const std::string& options) {
    Buffer<shared::Lobe> lobes(testDevice(), std::vector{lobe}, "lobe");
    Buffer<float> os(testDevice(), flat(wo), "wo"), is(testDevice(), flat(wi), "wi"),
        out(testDevice(), 4 * wi.size(), "f");
    program(options).kernel("evaluateLobe").launch(wi.size(), lobes, os, is, out, cl_uint(wi.size()));
    const auto values = out.read();
    std::vector<EvaluatedDirection> result(wi.size());
    for (size_t i = 0; i < wi.size(); ++i) result[i] = {tripleAt(values, 4 * i), values[4 * i + 3]};
    return result;
}

std::vector<glm::dvec3> lobeAlbedos(const shared::Lobe& lobe, const std::vector<glm::dvec3>& wo) {
    Buffer<shared::Lobe> lobes(testDevice(), std::vector{lobe}, "lobe");
    Buffer<float> in(testDevice(), flat(wo), "wo"), out(testDevice(), 3 * wo.size(), "albedo");
    program(allLobes).kernel("lobeAlbedos").launch(wo.size(), lobes, in, out, cl_uint(wo.size()));
    const auto values = out.read();
    std::vector<glm::dvec3> result(wo.size());
    for (size_t i = 0; i < wo.size(); ++i) result[i] = tripleAt(values, 3 * i);
    return result;
}

} // namespace quasilux

#include "support/emitter_cases.h"

#include "support/test_kernels.h"

#include <numbers>

namespace quasilux {

namespace {

using glm::dvec3;

Program& program() {
    static Program built =
        testProgram("emitters.cl", "-DHAS_EMITTER_RECTANGLE -DHAS_EMITTER_TRIANGLES -DHAS_EMITTER_SPHERE "
                                   "-DHAS_EMITTER_POINT -DHAS_EMITTER_DIRECTIONAL -DHAS_EMITTER_CONSTANT "
                                   "-DHAS_EMITTER_ENVMAP -DHAS_EMITTER_SPOT");
    return built;
}

shared::Packed3 pack(dvec3 v) { return {float(v.x), float(v.y), float(v.z)}; }

std::vector<float> flat(const std::vector<dvec3>& vectors) {
    std::vector<float> values;
    values.reserve(3 * vectors.size());
    for (const dvec3& v : vectors) values.insert(values.end(), {float(v.x), float(v.y), float(v.z)});
    return values;
}

dvec3 tripleAt(const std::vector<float>& values, size_t first) {
    return {values[first], values[first + 1], values[first + 2]};
}

shared::Emitter makeEmitter(unsigned type, dvec3 origin) {
    shared::Emitter emitter{};
    emitter.type = type;
    emitter.radiance = {1, 1, 1};
    emitter.origin = pack(origin);
    emitter.normalSign = emitter.selectionProbability = emitter.selectionCdf = 1;
    return emitter;
}

/// Shines into the sphere from outside.
shared::Emitter makeDistant(unsigned type, dvec3 centre, double radius) {
    shared::Emitter emitter = makeEmitter(type, centre);
    emitter.radius = float(radius);
    emitter.area = float(std::numbers::pi * radius * radius);
    return emitter;
}

} // namespace

shared::Emitter makeRectangle(dvec3 corner, dvec3 edgeU, dvec3 edgeV) {
    shared::Emitter emitter = makeEmitter(EMITTER_RECTANGLE, corner);
    const dvec3 cross = glm::cross(edgeU, edgeV);
    emitter.edgeU = pack(edgeU);
    emitter.edgeV = pack(edgeV);
    emitter.normal = pack(glm::normalize(cross));
    emitter.area = float(glm::length(cross));
    return emitter;
}

shared::Emitter makeSphere(dvec3 centre, double radius, double normalSign) {
    shared::Emitter emitter = makeEmitter(EMITTER_SPHERE, centre);
    emitter.radius = float(radius);
    emitter.area = float(4 * std::numbers::pi * radius * radius);
    emitter.normalSign = float(normalSign);
    return emitter;
}

shared::Emitter makePoint(dvec3 position) { return makeEmitter(EMITTER_POINT, position); }

shared::Emitter makeSpot(dvec3 position, dvec3 axis, double beamAngle, double cutoffAngle) {
    shared::Emitter emitter = makeEmitter(EMITTER_SPOT, position);
    emitter.normal = pack(glm::normalize(axis));
    emitter.beamAngle = float(beamAngle);
    emitter.cutoffAngle = float(cutoffAngle);
    return emitter;
}

shared::Emitter makeDirectional(dvec3 direction, dvec3 centre, double radius) {
    shared::Emitter emitter = makeDistant(EMITTER_DIRECTIONAL, centre, radius);
    emitter.normal = pack(glm::normalize(direction));
    return emitter;
}

shared::Emitter makeConstant(dvec3 centre, double radius) { return makeDistant(EMITTER_CONSTANT, centre, radius); }

std::pair<shared::Emitter, std::vector<uint32_t>> makeEnvmap(const EnvironmentImage& image, dvec3 centre,
                                                             double radius) {
    shared::Emitter emitter = makeDistant(EMITTER_ENVMAP, centre, radius);
    EnvironmentTable table = makeEnvironmentTable(image);
    emitter.radiance = table.meanRadiance;
    emitter.edgeU = pack(image.axes[0]);
    emitter.edgeV = pack(image.axes[1]);
    emitter.normal = pack(image.axes[2]);
    return {emitter, std::move(table.words)};
}

std::pair<shared::Emitter, std::vector<shared::EmitterTriangle>> makeTriangles(const std::vector<TriangleSpec>& specs) {
    shared::Emitter emitter = makeEmitter(EMITTER_TRIANGLES, {});
    std::vector<shared::EmitterTriangle> triangles;
    double area = 0;
    for (const TriangleSpec& t : specs) {
        area += 0.5 * glm::length(glm::cross(t.e1, t.e2));
        triangles.push_back({pack(t.p0), pack(t.e1), pack(t.e2), float(area)});
    }
    for (shared::EmitterTriangle& t : triangles) t.areaCdf = float(t.areaCdf / area);
    emitter.area = float(area);
    emitter.triangleCount = unsigned(triangles.size());
    return {emitter, triangles};
}

void setSelection(std::vector<shared::Emitter>& emitters, const std::vector<double>& probabilities) {
    double sum = 0;
    for (size_t i = 0; i < emitters.size(); ++i) {
        emitters[i].selectionProbability = float(probabilities[i]);
        emitters[i].selectionCdf = float(sum += probabilities[i]);
    }
    emitters.back().selectionCdf = 1;
}

shared::Emitter testRectangle(int kind) {
    if (kind == 0) return makeRectangle({-0.25, -0.25, 1}, {0.5, 0, 0}, {0, 0.5, 0});
    const glm::dvec3 u = glm::normalize(glm::dvec3(1, 2, -0.5)),
                     v = glm::normalize(glm::cross(u, glm::dvec3(0.3, -1, 0.8)));
    return makeRectangle({10, -5, 3}, 0.5 * u, 0.02 * v);
}

EmitterMixture mixedEmitters() {
    auto [mesh, triangles] = makeTriangles({{{0, 0, 5}, {1, 0, 0}, {0, 1, 0}}, {{4, 0, 5}, {0, 2, 0}, {1, 0, 1}}});
    EmitterMixture m{{testRectangle(0), mesh, makeSphere({-3, 0, 2}, 0.5, 1), makePoint({0, 3, 2})}, triangles};
    setSelection(m.emitters, {0.1, 0.4, 0.3, 0.2});
    return m;
}

std::vector<SampledEmitter> sampleDirections(const std::vector<shared::Emitter>& emitters,
                                             const std::vector<shared::EmitterTriangle>& triangles, dvec3 from,
                                             const std::vector<float>& numbers,
                                             const std::vector<uint32_t>& environment) {
    const size_t count = numbers.size() / 3;
    Buffer<cl_uint> words(testDevice(), environment, "environment");
    Buffer<shared::Emitter> es(testDevice(), emitters, "emitters");
    Buffer<shared::EmitterTriangle> ts(testDevice(), triangles, "triangles");
    Buffer<float> in(testDevice(), numbers, "numbers"), out(testDevice(), 8 * count, "samples");
    program()
        .kernel("sampleDirections")
        .launch(count, es, ts, words, cl_uint(emitters.size()), float(from.x), float(from.y), float(from.z), in, out,
                cl_uint(count));
    const auto values = out.read();
    std::vector<SampledEmitter> samples(count);
    for (size_t i = 0; i < count; ++i)
        samples[i] = {tripleAt(values, 8 * i), tripleAt(values, 8 * i + 4), values[8 * i + 3], values[8 * i + 7],
                      values[8 * i + 3] >= 0};
    return samples;
}

std::vector<double> directionPdfs(const std::vector<shared::Emitter>& emitters, unsigned index, dvec3 from,
                                  const std::vector<dvec3>& points, const std::vector<dvec3>& normals,
                                  const std::vector<uint32_t>& environment) {
    Buffer<cl_uint> words(testDevice(), environment, "environment");
    Buffer<shared::Emitter> es(testDevice(), emitters, "emitters");
    Buffer<float> ps(testDevice(), flat(points), "points"), ns(testDevice(), flat(normals), "normals");
    Buffer<float> out(testDevice(), points.size(), "pdfs");
    program()
        .kernel("directionPdfs")
        .launch(points.size(), es, words, cl_uint(index), float(from.x), float(from.y), float(from.z), ps, ns, out,
                cl_uint(points.size()));
    const auto values = out.read();
    return {values.begin(), values.end()};
}

std::vector<EmittedParticle> samplePhotons(const std::vector<shared::Emitter>& emitters,
                                           const std::vector<shared::EmitterTriangle>& triangles,
                                           const std::vector<float>& numbers,
                                           const std::vector<uint32_t>& environment) {
    const size_t count = numbers.size() / 5;
    Buffer<cl_uint> words(testDevice(), environment, "environment");
    Buffer<shared::Emitter> es(testDevice(), emitters, "emitters");
    Buffer<shared::EmitterTriangle> ts(testDevice(), triangles, "triangles");
    Buffer<float> in(testDevice(), numbers, "numbers"), out(testDevice(), 12 * count, "photons");
    Buffer<cl_uint> chosen(testDevice(), count, "emitter of each photon");
    program()
        .kernel("samplePhotons")
        .launch(count, es, ts, words, cl_uint(emitters.size()), in, out, chosen, cl_uint(count));
    const auto values = out.read();
    const auto indices = chosen.read();
    std::vector<EmittedParticle> photons(count);
    for (size_t i = 0; i < count; ++i)
        photons[i] = {tripleAt(values, 12 * i), tripleAt(values, 12 * i + 3), tripleAt(values, 12 * i + 6),
                      tripleAt(values, 12 * i + 9), indices[i]};
    return photons;
}

std::vector<dvec3> radiances(const shared::Emitter& emitter, const std::vector<dvec3>& directions,
                             const std::vector<uint32_t>& environment) {
    Buffer<shared::Emitter> es(testDevice(), {emitter}, "emitter");
    Buffer<cl_uint> words(testDevice(), environment, "environment");
    Buffer<float> in(testDevice(), flat(directions), "directions"),
        out(testDevice(), 3 * directions.size(), "radiances");
    program().kernel("radiances").launch(directions.size(), es, words, in, out, cl_uint(directions.size()));
    const auto values = out.read();
    std::vector<dvec3> result;
    for (size_t i = 0; i < directions.size(); ++i) result.push_back(tripleAt(values, 3 * i));
    return result;
}

std::vector<float> invertedNumbers(const shared::Emitter& emitter, const std::vector<float>& numbers,
                                   const std::vector<uint32_t>& environment) {
    const size_t count = numbers.size() / 5;
    Buffer<shared::Emitter> es(testDevice(), {emitter}, "emitter");
    Buffer<shared::EmitterTriangle> ts(testDevice(), 1, "triangles");
    Buffer<cl_uint> words(testDevice(), environment, "environment");
    Buffer<float> in(testDevice(), numbers, "numbers"), out(testDevice(), numbers.size(), "inverted");
    program().kernel("invertPhotons").launch(count, es, ts, words, in, out, cl_uint(count));
    return out.read();
}

} // namespace quasilux

#include "bench/micro/sampler_subjects.h"

#include "bsdf/lobe_list.h"
#include "prepare/environment.h"
#include "prepare/goniogram_table.h"

#include <algorithm>
#include <numbers>

namespace quasilux {

namespace {

std::string lowerCase(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; });
    return text;
}

shared::Lobe makeLobe(unsigned type) {
    shared::Lobe lobe{};
    lobe.type = type;
    lobe.reflectance = lobe.transmittance = {0.7f, 0.7f, 0.7f};
    lobe.eta = {1.5f, 1.5f, 1.5f};
    lobe.k = {1, 1, 1};
    lobe.alphaU = lobe.alphaV = 0.2f;
    lobe.exponent = 50;
    lobe.coat[0] = 0.9f;
    return lobe;
}

bool isDelta(unsigned type) {
    return type == LOBE_CONDUCTOR || type == LOBE_DIELECTRIC || type == LOBE_THINDIELECTRIC || LOBE_PASSES(type);
}

shared::Emitter makeEmitter(unsigned type) {
    constexpr float pi = std::numbers::pi_v<float>, radius = 2;
    shared::Emitter emitter{};
    emitter.type = type;
    emitter.radiance = {1, 1, 1};
    emitter.radius = radius;
    emitter.normalSign = emitter.selectionProbability = emitter.selectionCdf = 1;
    emitter.normal = {0, 0, -1};
    emitter.beamAngle = 0.3f;
    emitter.cutoffAngle = 0.4f;
    if (type == EMITTER_RECTANGLE) {
        emitter.origin = {-0.5f, -0.5f, 1};
        emitter.edgeU = {0, 1, 0};
        emitter.edgeV = {1, 0, 0};
        emitter.area = 1;
    } else if (type == EMITTER_TRIANGLES || type == EMITTER_DIRECTIONALAREA) {
        emitter.area = 0.5f;
        emitter.triangleCount = 1;
    } else {
        if (type == EMITTER_ENVMAP || type == EMITTER_PROJECTOR || type == EMITTER_GONIOGRAM) {
            emitter.edgeU = {1, 0, 0};
            emitter.edgeV = {0, 1, 0};
        }
        if (type == EMITTER_ENVMAP) emitter.normal = {0, 0, 1};
        emitter.origin = {0, 0, 4};
        emitter.area = type == EMITTER_SPHERE ? 4 * pi * radius * radius : pi * radius * radius;
    }
    return emitter;
}

std::vector<uint32_t> speckledSky() {
    EnvironmentImage image{1024, 512, {}, glm::dmat3(1)};
    for (unsigned k = 0; k < image.width * image.height; ++k)
        image.pixels.push_back(k % 101 == 0 ? shared::Rgb{100, 100, 100} : shared::Rgb{1, 1, 1});
    return makeEnvironmentTable(image).words;
}

/// Every 5 degrees from the pole, every 15 about it.
std::vector<uint32_t> lobedLuminaire() {
    LuminaireType type;
    Goniogram& goniogram = type.goniogram;
    for (int k = 0; k <= 36; ++k) goniogram.polar.push_back(5 * k);
    for (int k = 0; k <= 24; ++k) goniogram.azimuth.push_back(15 * k);
    for (int column = 0; column <= 24; ++column)
        for (int row = 0; row <= 36; ++row) goniogram.candela.push_back(1 + (row * (column % 24)) % 7);
    goniogram.shape = {LuminousShape::Kind::box, 0.6, 0.6, 0};
    std::vector<uint32_t> words;
    addGoniogram(type, words);
    return words;
}

} // namespace

std::vector<SamplerSubject<shared::Lobe>> lobeSubjects() {
    std::vector<SamplerSubject<shared::Lobe>> subjects;
#define ADD_LOBE(ID, argument)                                                                                         \
    subjects.push_back({"lobe " + lowerCase(#ID), "-DHAS_LOBE_" #ID, makeLobe(LOBE_##ID), !isDelta(LOBE_##ID)});
    LOBE_LIST(ADD_LOBE, )
#undef ADD_LOBE
    return subjects;
}

std::vector<SamplerSubject<shared::Emitter>> emitterSubjects() {
    return {{"emitter rectangle", "-DHAS_EMITTER_RECTANGLE", makeEmitter(EMITTER_RECTANGLE)},
            {"emitter triangles", "-DHAS_EMITTER_TRIANGLES", makeEmitter(EMITTER_TRIANGLES)},
            {"emitter sphere", "-DHAS_EMITTER_SPHERE", makeEmitter(EMITTER_SPHERE)},
            {"emitter point", "-DHAS_EMITTER_POINT", makeEmitter(EMITTER_POINT)},
            {"emitter directional", "-DHAS_EMITTER_DIRECTIONAL", makeEmitter(EMITTER_DIRECTIONAL)},
            {"emitter directionalarea", "-DHAS_EMITTER_DIRECTIONALAREA", makeEmitter(EMITTER_DIRECTIONALAREA)},
            {"emitter constant", "-DHAS_EMITTER_CONSTANT", makeEmitter(EMITTER_CONSTANT)},
            {"emitter spot", "-DHAS_EMITTER_SPOT", makeEmitter(EMITTER_SPOT)},
            {"emitter projector", "-DHAS_EMITTER_PROJECTOR", makeEmitter(EMITTER_PROJECTOR)},
            {"emitter goniogram", "-DHAS_EMITTER_GONIOGRAM", makeEmitter(EMITTER_GONIOGRAM)},
            {"emitter envmap", "-DHAS_EMITTER_ENVMAP", makeEmitter(EMITTER_ENVMAP)}};
}

shared::EmitterTriangle emitterTriangle() { return {{0, 0, 1}, {0, 1, 0}, {1, 0, 0}, 1}; }

std::vector<uint32_t> emitterTables(unsigned type) {
    if (type == EMITTER_ENVMAP) return speckledSky();
    if (type == EMITTER_GONIOGRAM) return lobedLuminaire();
    return {0};
}

std::vector<SamplerSubject<shared::Medium>> phaseSubjects() {
    std::vector<SamplerSubject<shared::Medium>> subjects{{"phase isotropic", "-DHAS_PHASE_ISOTROPIC", {}},
                                                         {"phase hg", "-DHAS_PHASE_HG", {}},
                                                         {"phase rayleigh", "-DHAS_PHASE_RAYLEIGH", {}}};
    const unsigned phases[] = {PHASE_ISOTROPIC, PHASE_HG, PHASE_RAYLEIGH};
    for (size_t k = 0; k < subjects.size(); ++k) {
        subjects[k].options += " -DHAS_MEDIA";
        subjects[k].value.phase = phases[k];
        subjects[k].value.g = 0.8f;
    }
    return subjects;
}

} // namespace quasilux

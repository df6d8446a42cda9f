#include "bench/bench_method.h"

#include "scene/quasi_specular.h"
#include "util/error.h"

#include <charconv>
#include <fmt/format.h>
#include <sstream>

namespace quasilux {

namespace {

constexpr const char* expected =
    "expected scene, standard, main or alternative, then, each after a colon, a BDD, photons, "
    "camera, generic or level=X, such as main:1:photons";

std::vector<std::string> splitAtColons(const std::string& text) {
    std::vector<std::string> parts;
    std::istringstream stream(text);
    for (std::string part; std::getline(stream, part, ':');) parts.push_back(part);
    return parts;
}

[[noreturn]] void refuse(const std::string& method, const std::string& part) {
    throw InputError(fmt::format("--method {}: '{}' is not known, {}", method, part, expected));
}

void applyKind(const std::string& method, const std::string& kind, RenderSettings& settings) {
    if (kind == "scene") return;
    if (kind == "standard") {
        settings.quasiSpecular = "none";
        settings.quasiSpecularOverridesScene = true;
    } else if (kind == "main" || kind == "alternative")
        settings.variant = parseChoice<Variant>(kind);
    else
        refuse(method, kind);
}

void applyPart(const std::string& method, const std::string& part, RenderSettings& settings) {
    const auto* end = part.data() + part.size();
    unsigned bdd = 0;
    if (const auto [stop, error] = std::from_chars(part.data(), end, bdd); error == std::errc() && stop == end)
        settings.bdd = bdd;
    else if (part == "photons")
        settings.direct = DirectLight::photons;
    else if (part == "camera")
        settings.map = MapOrder::camera;
    else if (part == "generic")
        settings.genericKernels = true;
    else if (part.rfind("level=", 0) == 0 && part.size() > 6) {
        settings.quasiSpecular = "level:" + part.substr(6);
        parsePhaseLevel(settings.quasiSpecular, {}); // refuses what is no number before anything is rendered
        settings.quasiSpecularOverridesScene = true;
    } else
        refuse(method, part);
}

} // namespace

void BenchMethod::apply(RenderSettings& settings) const {
    const auto parts = splitAtColons(name);
    if (parts.empty()) refuse(name, name);
    applyKind(name, parts.front(), settings);
    for (size_t k = 1; k < parts.size(); ++k) applyPart(name, parts[k], settings);
}

BenchMethod parseBenchMethod(const std::string& text) {
    BenchMethod method{text};
    RenderSettings settings;
    method.apply(settings);
    return method;
}

std::vector<BenchMethod> defaultBenchMethods() {
    return {{"scene"}, {"standard:0"}, {"standard:1"}, {"main:0"}, {"main:1"}, {"alternative:0"}};
}

} // namespace quasilux

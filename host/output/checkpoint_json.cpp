#include "output/checkpoint_json.h"

#include "output/json_number.h"

#include <cmath>
#include <concepts>

namespace quasilux {

using Json = nlohmann::json;

namespace {

/// Visits the same fields for writing and for reading, so that none is left out of one of them.
struct Writer {
    Json out = Json::object();

    template <typename T>
    void operator()(const char* key, const T& value) {
        out[key] = value;
    }
    void operator()(const char* key, const double& value) {
        out[key] = std::isfinite(value) ? Json(value) : Json(nullptr); // JSON knows no infinity
    }
    template <typename T>
    void operator()(const char* key, const std::optional<T>& value) {
        out[key] = value ? Json(*value) : Json(nullptr);
    }
};

struct Reader {
    const Json& in;

    template <typename T>
    void operator()(const char* key, T& value) const {
        value = valueOf<T>(in.at(key));
    }
    void operator()(const char* key, double& value) const {
        value = in.at(key).is_null() ? INFINITY : in.at(key).get<double>();
    }
    template <typename T>
    void operator()(const char* key, std::optional<T>& value) const {
        if (in.at(key).is_null())
            value.reset();
        else
            value = valueOf<T>(in.at(key));
    }

private:
    template <typename T>
    static T valueOf(const Json& json) {
        if constexpr (std::unsigned_integral<T> && !std::same_as<T, bool>)
            return wholeNumber<T>(json);
        else
            return json.get<T>();
    }
};

template <typename Visit, typename Settings>
void visitSettings(Visit& visit, Settings& s) {
    visit("bdd", s.bdd);
    visit("quasiSpecular", s.quasiSpecular);
    visit("quasiSpecularOverridesScene", s.quasiSpecularOverridesScene);
    visit("photonsPerPass", s.photonsPerPass);
    visit("cameraPaths", s.cameraPaths);
    visit("seed", s.seed);
    visit("radiusScale", s.radiusScale);
    visit("photometric", s.photometric);
    visit("genericKernels", s.genericKernels);
    visit("furtherClasses", s.furtherClasses);
    visit("estimateBias", s.estimateBias);
    visit("keepsBias", s.film.bias);
    visit("keepsComponents", s.film.components);
    visit("energyBalance", s.energyBalance);
}

template <typename Visit, typename Stop>
void visitStop(Visit& visit, Stop& s) {
    visit("seconds", s.seconds);
    visit("passes", s.passes);
    visit("firstPass", s.firstPass);
    visit("relativeError", s.relativeError);
}

template <typename Visit, typename Counters>
void visitCounters(Visit& visit, Counters& c) {
    visit("passes", c.passes);
    visit("photonsEmitted", c.photonsEmitted);
    visit("photonsStored", c.photonsStored);
    visit("cameraPointsStored", c.cameraPointsStored);
    visit("storedPoints", c.storedPoints);
    visit("storedBytes", c.storedBytes);
    visit("cameraPaths", c.cameraPaths);
    visit("nonFinite", c.nonFinite);
    visit("cutPaths", c.cutPaths);
    visit("overflows", c.overflows);
    visit("clipped", c.clipped);
    visit("meterCaustics", c.meterCaustics);
    visit("fluxEmitted", c.fluxEmitted);
    visit("fluxCut", c.fluxCut);
    visit("throughputCut", c.throughputCut);
    visit("prepareSeconds", c.prepareSeconds);
    visit("compileSeconds", c.compileSeconds);
    visit("firstPassSeconds", c.firstPassSeconds);
    visit("renderSeconds", c.renderSeconds);
    visit("radiusSeconds", c.radiusSeconds);
    visit("radiusPaths", c.radiusPaths);
}

template <typename Visit, typename Energy>
void visitEnergy(Visit& visit, Energy& e) {
    visit("emitted", e.emitted);
    visit("absorbed", e.absorbed);
    visit("escaped", e.escaped);
    visit("beyondDepth", e.beyondDepth);
    visit("cut", e.cut);
    visit("lost", e.lost);
    visit("gained", e.gained);
}

template <typename Visit, typename Row>
void visitRow(Visit& visit, Row& r) {
    visit("photonsPerPass", r.photonsPerPass);
    visit("passes", r.passes);
    visit("secondsPerPass", r.secondsPerPass);
    visit("openingSeconds", r.openingSeconds);
    visit("predictedError", r.predictedError);
    visit("outcome", r.outcome);
}

template <typename Visit, typename Search>
void visitSearch(Visit& visit, Search& s) {
    visit("bdd", s.freedom.bdd);
    visit("split", s.freedom.split);
    visit("variant", s.freedom.variant);
    visit("photons", s.freedom.photons);
    visit("radius", s.freedom.radius);
    visit("cameraPaths", s.freedom.cameraPaths);
    visit("caustics", s.freedom.caustics);
    visit("cameraSampling", s.freedom.cameraSampling);
    visit("notSearched", s.notSearched);
    visit("chosen", s.chosen);
    visit("passes", s.passes);
    visit("seconds", s.seconds);
    visit("horizon", s.horizon);
    visit("outOfTime", s.outOfTime);
}

template <typename Visit, typename Device>
void visitDevice(Visit& visit, Device& d) {
    visit("name", d.name);
    visit("platform", d.platform);
    visit("version", d.version);
    visit("driver", d.driver);
    visit("computeUnits", d.computeUnits);
    visit("globalMemory", d.globalMemory);
    visit("maximumAllocation", d.maximumAllocation);
    visit("isCpu", d.isCpu);
}

} // namespace

Json toJson(const RenderSettings& settings) {
    Writer writer;
    visitSettings(writer, settings);
    writer.out["variant"] = name(settings.variant);
    writer.out["direct"] = name(settings.direct);
    writer.out["caustics"] = name(settings.caustics);
    writer.out["cameraSampling"] = name(settings.cameraSampling);
    writer.out["map"] = name(settings.map);
    writer.out["emission"] = name(settings.emission);
    writer.out["radius"] = name(settings.radius);
    return writer.out;
}

void fromJson(const Json& from, RenderSettings& settings) {
    const Reader reader{from};
    visitSettings(reader, settings);
    settings.variant = parseChoice<Variant>(from.at("variant"));
    settings.direct = parseChoice<DirectLight>(from.at("direct"));
    settings.caustics = parseChoice<CausticLight>(from.at("caustics"));
    settings.cameraSampling = parseChoice<CameraSampling>(from.at("cameraSampling"));
    settings.map = parseChoice<MapOrder>(from.at("map"));
    settings.emission = parseChoice<Emission>(from.at("emission"));
    settings.radius = parseChoice<RadiusChoice>(from.at("radius"));
}

Json toJson(const StopRule& stop) {
    Writer writer;
    visitStop(writer, stop);
    return writer.out;
}

void fromJson(const Json& from, StopRule& stop) {
    const Reader reader{from};
    visitStop(reader, stop);
}

Json toJson(const RenderCounters& counters) {
    Writer writer;
    visitCounters(writer, counters);
    Writer energy;
    if (counters.energy) visitEnergy(energy, *counters.energy);
    writer.out["energy"] = counters.energy ? energy.out : Json(nullptr);
    return writer.out;
}

void fromJson(const Json& from, RenderCounters& counters) {
    const Reader reader{from};
    visitCounters(reader, counters);
    counters.energy.reset();
    if (from.at("energy").is_null()) return;
    const Reader energy{from.at("energy")};
    visitEnergy(energy, counters.energy.emplace());
}

Json toJson(const SearchReport& search) {
    Writer writer;
    visitSearch(writer, search);
    Json rows = Json::array();
    for (const PilotRow& row : search.rows) {
        Writer each;
        visitRow(each, row);
        each.out["settings"] = toJson(row.settings);
        rows.push_back(each.out);
    }
    writer.out["rows"] = rows;
    return writer.out;
}

void fromJson(const Json& from, SearchReport& search) {
    const Reader reader{from};
    visitSearch(reader, search);
    search.rows.clear();
    for (const Json& row : from.at("rows")) {
        const Reader each{row};
        visitRow(each, search.rows.emplace_back());
        fromJson(row.at("settings"), search.rows.back().settings);
    }
}

Json toJson(const DeviceInfo& device) {
    Writer writer;
    visitDevice(writer, device);
    return writer.out;
}

void fromJson(const Json& from, DeviceInfo& device) {
    const Reader reader{from};
    visitDevice(reader, device);
}

Json toJson(const std::map<std::string, KernelTiming>& timings) {
    Json out = Json::object();
    for (const auto& [kernel, timing] : timings) out[kernel] = {timing.launches, timing.seconds, timing.privateBytes};
    return out;
}

void fromJson(const Json& from, std::map<std::string, KernelTiming>& timings) {
    timings.clear();
    for (const auto& [kernel, row] : from.items())
        timings[kernel] = {wholeNumber<uint64_t>(row.at(0)), row.at(1).get<double>(), wholeNumber<uint64_t>(row.at(2))};
}

} // namespace quasilux

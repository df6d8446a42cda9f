#include "output/render_checkpoint.h"

#include "device/kernel_sources.h"
#include "learn/learned_state.h"
#include "output/checkpoint_json.h"
#include "output/json_number.h"
#include "render/scene_report.h"

#include <fmt/format.h>

namespace quasilux {

using Json = nlohmann::json;

namespace {

/// The first key whose values differ: "bdd is 1 there, 0 here".
std::string firstDifference(const Json& there, const Json& here) {
    for (const auto& [key, value] : there.items()) {
        const Json other = here.contains(key) ? here.at(key) : Json();
        if (value != other) return fmt::format("{} is {} there, {} here", key, value.dump(), other.dump());
    }
    return {};
}

} // namespace

std::string kernelChecksum() {
    Checksum checksum;
    for (const auto& [file, source] : kernelSources()) {
        checksum.add(file.data(), file.size());
        checksum.add(source.data(), source.size());
    }
    return checksum.text();
}

Json describe(const Checkpoint& c) {
    Json ranges = Json::array();
    for (const PassRange& range : c.passes) ranges.push_back({range.first, range.end});
    return {{"version", c.version},
            {"kernels", c.kernels},
            {"wanted", toJson(c.wanted)},
            {"freedom", c.freedom},
            {"settings", toJson(c.settings)},
            {"sceneChecksums", c.sceneChecksums},
            {"width", c.width},
            {"height", c.height},
            {"film", {{"bias", c.film.bias}, {"components", c.film.components}}},
            {"meter", static_cast<unsigned>(c.meter)},
            {"passes", ranges},
            {"stop", toJson(c.stop)},
            {"seconds", c.seconds},
            {"counters", toJson(c.counters)},
            {"scene", c.scene},
            {"layersOfScene", c.layersOfScene},
            {"isPerNanometre", c.isPerNanometre},
            {"view", c.view ? Json{{"projection", c.view->projection}, {"degrees", c.view->degrees}} : Json()},
            {"photonsPerPass", c.photonsPerPass},
            {"search", toJson(c.search)},
            {"device", toJson(c.device)},
            {"timings", toJson(c.timings)}};
}

Checkpoint checkpointOf(const CheckpointReader& reader) {
    const Json& from = reader.description();
    Checkpoint c;
    try {
        c.version = from.at("version");
        c.kernels = from.at("kernels");
        if (c.version != QUASILUX_VERSION || c.kernels != kernelChecksum())
            throw InputError(fmt::format("checkpoint {}: of another version of quasilux ({}, kernels {}), expected {}, "
                                         "kernels {}: use the version that made it",
                                         reader.path(), c.version, c.kernels, QUASILUX_VERSION, kernelChecksum()));
        c.wanted = parsed<RenderSettings>(from.at("wanted"));
        c.freedom = from.at("freedom");
        c.settings = parsed<RenderSettings>(from.at("settings"));
        from.at("sceneChecksums").get_to(c.sceneChecksums);
        c.width = wholeNumber<unsigned>(from.at("width"));
        c.height = wholeNumber<unsigned>(from.at("height"));
        c.film = {from.at("film").at("bias"), from.at("film").at("components")};
        c.meter = static_cast<MeterKind>(wholeNumber<unsigned>(from.at("meter")));
        for (const auto& range : from.at("passes"))
            c.passes.push_back({wholeNumber<unsigned>(range.at(0)), wholeNumber<unsigned>(range.at(1))});
        c.stop = parsed<StopRule>(from.at("stop"));
        c.seconds = from.at("seconds");
        c.counters = parsed<RenderCounters>(from.at("counters"));
        c.scene = from.at("scene");
        c.layersOfScene = from.value("layersOfScene", "");
        c.isPerNanometre = from.value("isPerNanometre", false);
        if (const auto view = from.find("view"); view != from.end() && !view->is_null())
            c.view = ImageView{view->at("projection").get<std::string>(), view->at("degrees").get<double>()};
        c.photonsPerPass = wholeNumber<decltype(c.photonsPerPass)>(from.at("photonsPerPass"));
        c.search = parsed<SearchReport>(from.at("search"));
        c.device = parsed<DeviceInfo>(from.at("device"));
        c.timings = parsed<std::map<std::string, KernelTiming>>(from.at("timings"));
    } catch (const Json::exception& error) {
        throw InputError(
            fmt::format("checkpoint {}: of another version of quasilux ({})", reader.path(), error.what()));
    }
    return c;
}

void writeCheckpoint(const std::string& path, const Checkpoint& checkpoint,
                     const std::function<void(StateSink&)>& save) {
    CheckpointWriter writer(path);
    save(writer);
    writer.finish(describe(checkpoint));
}

void writeCheckpoint(const std::string& path, const Checkpoint& checkpoint, const Renderer& renderer) {
    writeCheckpoint(path, checkpoint, [&](StateSink& sink) {
        saveLearned(sink, *renderer.learned());
        renderer.saveState(sink);
    });
}

std::string differenceOfWanted(const Checkpoint& there, const Checkpoint& here) {
    if (auto settings = firstDifference(toJson(there.wanted), toJson(here.wanted)); !settings.empty()) return settings;
    if (there.freedom != here.freedom)
        return fmt::format("left to a search is {} there, {} here", there.freedom, here.freedom);
    return {};
}

std::string differenceOfImage(const Checkpoint& there, const Checkpoint& here) {
    if (auto wanted = differenceOfWanted(there, here); !wanted.empty()) return wanted;
    if (there.width != here.width || there.height != here.height)
        return fmt::format("the film has {} x {} pixels there, {} x {} here", there.width, there.height, here.width,
                           here.height);
    if (const auto chosen = firstDifference(toJson(there.settings), toJson(here.settings)); !chosen.empty())
        return "by the search " + chosen;
    if (const auto scene = refusal([&] { requireSame(there.sceneChecksums, here.sceneChecksums); })) return *scene;
    if (!(there.film == here.film) || there.meter != here.meter) return "the sensor is another one";
    return {};
}

std::string text(const std::vector<PassRange>& passes) {
    std::string out;
    for (const PassRange& range : passes)
        out += fmt::format("{}{} to {}", out.empty() ? "" : ", ", range.first, range.end - 1);
    return out.empty() ? "none" : out;
}

std::vector<PassRange> joined(std::vector<PassRange> ranges) {
    std::sort(ranges.begin(), ranges.end(), [](const PassRange& a, const PassRange& b) { return a.first < b.first; });
    std::vector<PassRange> all;
    for (const PassRange& range : ranges) {
        if (!all.empty() && all.back().end == range.first)
            all.back().end = range.end;
        else if (range.first < range.end)
            all.push_back(range);
    }
    return all;
}

} // namespace quasilux

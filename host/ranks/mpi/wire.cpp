#include "ranks/mpi/wire.h"

#include "output/checkpoint_json.h"

namespace quasilux {

using Json = nlohmann::json;

Json toJson(const RankPlan& plan) {
    return {{"sensor", plan.sensor},
            {"settings", toJson(plan.settings)},
            {"checksums", plan.checksums},
            {"width", plan.shape.width},
            {"height", plan.shape.height},
            {"bias", plan.shape.layout.bias},
            {"components", plan.shape.layout.components}};
}

RankPlan planOf(const Json& json) {
    RankPlan plan;
    plan.sensor = json.at("sensor");
    plan.settings = parsed<RenderSettings>(json.at("settings"));
    json.at("checksums").get_to(plan.checksums);
    plan.shape = {json.at("width"), json.at("height"), {json.at("bias"), json.at("components")}};
    return plan;
}

Message toMessage(const WorkerEvent& event) {
    Message message;
    message.head = {{"is", "event"},
                    {"kind", static_cast<int>(event.kind)},
                    {"worker", event.worker},
                    {"name", event.name},
                    {"why", event.why},
                    {"first", event.passes.first},
                    {"end", event.passes.end},
                    {"seconds", event.seconds},
                    {"squaredSeconds", event.squaredSeconds},
                    {"photons", event.photons},
                    {"paths", event.paths},
                    {"hasRadii", event.radii != nullptr},
                    {"radiiAreChosen", event.radii && event.radii->areChosen}};
    if (event.radii) message.body = event.radii->state.packed();
    return message;
}

WorkerEvent eventOf(const Message& message) {
    const Json& head = message.head;
    WorkerEvent event;
    event.kind = static_cast<WorkerEvent::Kind>(head.at("kind").get<int>());
    event.worker = head.at("worker");
    event.name = head.at("name");
    event.why = head.at("why");
    event.passes = {head.at("first"), head.at("end")};
    event.seconds = head.at("seconds");
    event.squaredSeconds = head.at("squaredSeconds");
    event.photons = head.at("photons");
    event.paths = head.at("paths");
    if (!head.at("hasRadii").get<bool>()) return event;
    auto radii = std::make_shared<RadiiState>();
    radii->areChosen = head.at("radiiAreChosen");
    radii->state = MemoryState::unpacked(message.body);
    event.radii = std::move(radii);
    return event;
}

Json toJson(const PassSums& sums) {
    const FilmCounts& n = sums.counts;
    return {{"counts", {n.batches, n.openPasses, n.biasPasses, n.openBiasPasses, n.biasSquares}},
            {"counters", toJson(sums.counters)},
            {"timings", toJson(sums.timings)}};
}

PassSums sumsOf(const Json& json) {
    PassSums sums;
    const Json& n = json.at("counts");
    sums.counts = {n.at(0), n.at(1), n.at(2), n.at(3), n.at(4)};
    sums.counters = parsed<RenderCounters>(json.at("counters"));
    sums.timings = parsed<std::map<std::string, KernelTiming>>(json.at("timings"));
    return sums;
}

} // namespace quasilux

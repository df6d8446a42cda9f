#include "view/live_state.h"

namespace quasilux {

namespace {

constexpr size_t mostChartPoints = 512;

nlohmann::json orNull(double value) { return value < 0 ? nlohmann::json() : nlohmann::json(value); }

nlohmann::json limitsOf(const PitchRange& pitches) {
    return {{"pitch", {pitches.lowest, pitches.highest}}, {"nearer", {-mostNearer, mostNearer}}};
}

} // namespace

void LiveState::setEditable(Editable editable) {
    const std::lock_guard lock(mutex_);
    editable_ = std::move(editable);
    change();
}

void LiveState::begin(const Render& render) {
    const std::lock_guard lock(mutex_);
    ++renders_;
    render_ = render;
    progress_ = {};
    errors_.clear();
    phase_ = "preparing";
    change();
}

void LiveState::setSettings(const RenderSettings& settings) {
    const std::lock_guard lock(mutex_);
    settings_ = {{"bdd", settings.bdd},
                 {"variant", name(settings.variant)},
                 {"direct", name(settings.direct)},
                 {"map", name(settings.map)},
                 {"quasiSpecular", settings.quasiSpecular},
                 {"cameraPaths", settings.cameraPaths},
                 {"cameraSampling", name(settings.cameraSampling)},
                 {"seed", settings.seed}};
    change();
}

void LiveState::setLayers(std::vector<std::string> layers) {
    const std::lock_guard lock(mutex_);
    layers_ = std::move(layers);
    change();
}

void LiveState::setProgress(const Progress& progress) {
    const std::lock_guard lock(mutex_);
    const bool isNewError = progress.relativeError >= 0 && progress.relativeError != progress_.relativeError;
    progress_ = progress;
    phase_ = progress.phase;
    if (isNewError) errors_.emplace_back(progress.seconds, progress.relativeError);
    // Every second one of the older half goes: later the curve changes more slowly.
    if (errors_.size() > mostChartPoints)
        for (size_t k = mostChartPoints / 2; k > 0; k -= 2)
            errors_.erase(errors_.begin() + static_cast<std::ptrdiff_t>(k - 1));
    change();
}

void LiveState::setPasses(unsigned passes, double seconds) {
    const std::lock_guard lock(mutex_);
    progress_.passes = passes;
    progress_.seconds = seconds;
    change();
}

void LiveState::setPhase(const std::string& phase) {
    const std::lock_guard lock(mutex_);
    phase_ = phase;
    change();
}

void LiveState::setProblem(const std::string& message) {
    const std::lock_guard lock(mutex_);
    if (problem_ == message) return;
    problem_ = message;
    change();
}

void LiveState::close() {
    const std::lock_guard lock(mutex_);
    isClosed_ = true;
    phase_ = "ended";
    change();
}

nlohmann::json LiveState::wait(uint64_t seen, std::chrono::milliseconds patience) const {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, patience, [&] { return version_ != seen || isClosed_; });
    return json();
}

nlohmann::json LiveState::origin() const {
    const std::lock_guard lock(mutex_);
    return {{"render", renders_},
            {"settings", settings_},
            {"seconds", progress_.seconds},
            {"relativeError", orNull(progress_.relativeError)}};
}

nlohmann::json LiveState::json() const {
    nlohmann::json state{{"version", version_},
                         {"render", renders_},
                         {"scene", render_.scene},
                         {"width", render_.width},
                         {"height", render_.height},
                         {"layers", layers_},
                         {"quantity", render_.isMeter ? "irradiance" : "radiance"},
                         {"phase", phase_},
                         {"problem", problem_},
                         {"passes", progress_.passes},
                         {"seconds", progress_.seconds},
                         {"secondsLeft", render_.isEndless ? nlohmann::json() : orNull(progress_.secondsLeft)},
                         {"relativeError", orNull(progress_.relativeError)},
                         {"photonsPerSecond", progress_.photonsPerSecond},
                         {"pathsPerSecond", progress_.pathsPerSecond},
                         {"errors", errors_},
                         {"settings", settings_},
                         {"isEditable", editable_.has_value()},
                         {"cameraLimits", nullptr},
                         {"edits", nullptr},
                         {"lamps", nlohmann::json::array()}};
    if (!editable_) return state;
    if (editable_->pitches) state["cameraLimits"] = limitsOf(*editable_->pitches);
    state["edits"] = toJson(editable_->edits);
    for (const auto& lamp : editable_->lamps) state["lamps"].push_back({{"id", lamp.id}, {"kind", lamp.kind}});
    return state;
}

} // namespace quasilux

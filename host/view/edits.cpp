#include "view/edits.h"

#include "scene/box.h"
#include "scene/color.h"
#include "scene/origin.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <vector>

namespace quasilux {

namespace {

constexpr double steepest = 1.55; // radians above the horizon: short of straight up, where left and right are lost

double number(const nlohmann::json& json, const char* key, double least, double most) {
    const auto found = json.find(key);
    if (found == json.end() || found->is_null()) return 0;
    const double value = found->is_number() ? found->get<double>() : std::numeric_limits<double>::quiet_NaN();
    if (!(value >= least && value <= most))
        throw InputError(fmt::format("{} is {}, expected a number from {} to {}", key, found->dump(), least, most));
    return value;
}

std::optional<std::string> text(const nlohmann::json& json, const char* key) {
    const auto found = json.find(key);
    if (found == json.end() || found->is_null()) return std::nullopt;
    if (!found->is_string()) throw InputError(fmt::format("{} is {}, expected text", key, found->dump()));
    return found->get<std::string>();
}

CameraMove parseMove(const nlohmann::json& json) {
    constexpr double far = 1e3;
    if (!json.is_object()) throw InputError("camera is " + json.dump() + ", expected an object");
    return {number(json, "yaw", -far, far), number(json, "pitch", -far, far),
            number(json, "nearer", -mostNearer, mostNearer), number(json, "right", -far, far),
            number(json, "up", -far, far)};
}

std::vector<double> parseLamps(const nlohmann::json& json) {
    std::vector<double> factors;
    if (!json.is_array()) throw InputError("lamps is " + json.dump() + ", expected a list of factors");
    for (const auto& factor : json) factors.push_back(number({{"lamp", factor}}, "lamp", 0, 1e6));
    return factors;
}

// Of the world's axes, and the opposite ones, the one that points most to where the camera has its up.
glm::dvec3 uprightAxis(const glm::dvec3& up) {
    int axis = 0;
    for (int k = 1; k < 3; ++k)
        if (std::abs(up[k]) > std::abs(up[axis])) axis = k;
    glm::dvec3 upright(0);
    upright[axis] = up[axis] < 0 ? -1 : 1;
    return upright;
}

glm::dmat3 rotation(double angle, const glm::dvec3& axis) {
    return glm::dmat3(glm::rotate(glm::dmat4(1), angle, axis));
}

} // namespace

ViewEdits parseEdits(const nlohmann::json& json) {
    if (!json.is_object()) throw InputError("expected an object of changes, found " + json.dump());
    ViewEdits edits;
    if (json.contains("camera")) edits.camera = parseMove(json["camera"]);
    if (json.contains("lamps")) edits.lamps = parseLamps(json["lamps"]);
    if (json.contains("bdd") && !json["bdd"].is_null()) {
        if (!json["bdd"].is_number_unsigned() || json["bdd"].get<uint64_t>() > bddLimit)
            throw InputError("bdd is " + json["bdd"].dump() + ", expected a whole number from 0 to " +
                             std::to_string(bddLimit));
        edits.bdd = json["bdd"].get<unsigned>();
    }
    edits.variant = text(json, "variant");
    edits.direct = text(json, "direct");
    edits.map = text(json, "map");
    edits.quasiSpecular = text(json, "quasiSpecular");
    edits.isDraft = json.value("isDraft", nlohmann::json(false)) == true;
    if (edits.variant) parseChoice<Variant>(*edits.variant);
    if (edits.direct) parseChoice<DirectLight>(*edits.direct);
    if (edits.map) parseChoice<MapOrder>(*edits.map);
    return edits;
}

ViewEdits parseEdits(const std::string& text) {
    // Who writes it out recurses, so a message that quotes it could take more of the stack than a thread has.
    constexpr int mostNested = 8;
    bool isFlat = true;
    const auto check = [&](int depth, nlohmann::json::parse_event_t, const nlohmann::json&) {
        return isFlat = isFlat && depth <= mostNested;
    };
    const auto json = nlohmann::json::parse(text, check, false);
    if (!isFlat) throw InputError(fmt::format("expected JSON of at most {} levels", mostNested));
    if (json.is_discarded()) throw InputError("expected JSON");
    return parseEdits(json);
}

nlohmann::json toJson(const ViewEdits& edits) {
    const auto orNull = [](const auto& value) { return value ? nlohmann::json(*value) : nlohmann::json(); };
    const CameraMove& move = edits.camera;
    const nlohmann::json camera{
        {"yaw", move.yaw}, {"pitch", move.pitch}, {"nearer", move.nearer}, {"right", move.right}, {"up", move.up}};
    return {{"camera", camera},
            {"lamps", edits.lamps},
            {"bdd", orNull(edits.bdd)},
            {"variant", orNull(edits.variant)},
            {"direct", orNull(edits.direct)},
            {"map", orNull(edits.map)},
            {"quasiSpecular", orNull(edits.quasiSpecular)},
            {"isDraft", edits.isDraft},
            {"number", edits.number}};
}

EditedScene::EditedScene(Scene scene) : scene_(std::move(scene)), pivotDistance_(distanceToMiddle()) {
    original_.view = scene_.sensor.toWorld;
    for (const auto& shape : scene_.shapes) original_.byShape.push_back(shape.emitter);
    original_.points = scene_.pointEmitters;
    original_.beams = scene_.directionalEmitters;
    original_.surroundings = scene_.surroundings;
}

std::vector<EditedScene::Lamp> EditedScene::lamps() const {
    std::vector<Lamp> all;
    for (size_t k = 0; k < original_.byShape.size(); ++k)
        if (original_.byShape[k]) all.push_back({scene_.shapes[k].id, "area"});
    for (const auto& point : original_.points)
        all.push_back({point.id, point.luminaire   ? "luminaire"
                                 : point.projector ? "projector"
                                 : point.spot      ? "spot"
                                                   : "point"});
    for (const auto& beam : original_.beams) all.push_back({beam.id, "directional"});
    if (original_.surroundings) all.push_back({original_.surroundings->id, original_.surroundings->plugin});
    return all;
}

std::optional<PitchRange> EditedScene::pitches() const {
    return hasCamera() ? std::optional(pitchRange(original_.view)) : std::nullopt;
}

// In the order of lamps().
void EditedScene::apply(const ViewEdits& edits) {
    size_t next = 0;
    const auto factor = [&] { // of the lamp that follows
        const double given = next < edits.lamps.size() ? edits.lamps[next] : 1;
        ++next;
        return static_cast<float>(given);
    };
    size_t lit = 0;
    for (size_t k = 0; k < scene_.shapes.size(); ++k) {
        if (!original_.byShape[k]) continue;
        auto& emitter = scene_.shapes[k].emitter = original_.byShape[k];
        emitter->radiance = emitter->radiance * factor();
        if (isBlack(emitter->radiance)) emitter.reset();
        scene_.shapes[k].emitterIsOff = !emitter.has_value();
        lit += emitter.has_value();
    }
    scene_.pointEmitters = original_.points;
    for (auto& point : scene_.pointEmitters) point.intensity = point.intensity * factor();
    std::erase_if(scene_.pointEmitters, [](const auto& point) { return isBlack(point.intensity); });
    scene_.directionalEmitters = original_.beams;
    for (auto& beam : scene_.directionalEmitters) beam.irradiance = beam.irradiance * factor();
    std::erase_if(scene_.directionalEmitters, [](const auto& beam) { return isBlack(beam.irradiance); });
    lit += scene_.pointEmitters.size() + scene_.directionalEmitters.size();
    if (original_.surroundings) lit += setSurroundings(factor());
    if (lit == 0 && next > 0)
        throw InputError("all lamps are off, so that there is no light to render; raise the power of one of them");
    if (hasCamera())
        scene_.sensor.toWorld = moved(original_.view, edits.camera, pivotDistance_, scene_.sensor.orthographic);
}

bool EditedScene::setSurroundings(float factor) {
    scene_.surroundings.reset();
    if (factor == 0) return false;
    auto& surroundings = scene_.surroundings = original_.surroundings;
    surroundings->radiance = surroundings->radiance * factor;
    if (surroundings->image)
        for (Rgb& pixel : surroundings->image->pixels) pixel = pixel * factor;
    return true;
}

// The camera turns about the point before it that is as deep as the middle of the scene.
double EditedScene::distanceToMiddle() const {
    const Box box = boxOf(scene_);
    if (box.lower.x > box.upper.x) return 1; // nothing
    const glm::dvec3 forward = glm::normalize(glm::dvec3(scene_.sensor.toWorld[2]));
    const double depth = glm::dot(box.center() - glm::dvec3(scene_.sensor.toWorld[3]), forward);
    return std::max(depth, 0.05 * box.diagonal());
}

PitchRange pitchRange(const glm::dmat4& toWorld) {
    const glm::dvec3 forward = glm::normalize(glm::dvec3(toWorld[2])), upright = uprightAxis(glm::dvec3(toWorld[1]));
    const double before = std::asin(std::clamp(-glm::dot(forward, upright), -1.0, 1.0));
    return {std::min(before, -steepest) - before, std::max(before, steepest) - before};
}

glm::dmat4 moved(const glm::dmat4& toWorld, const CameraMove& move, double distance, bool isOrthographic) {
    const glm::dmat3 axes(toWorld);
    const glm::dvec3 eye(toWorld[3]), forward = glm::normalize(axes[2]), up = glm::normalize(axes[1]);
    const glm::dvec3 upright = uprightAxis(up), pivot = eye + distance * forward;
    // The left of the picture is axes[0], which a mirrored camera has to its right: it rises as others do, but turns the
    // other way about, so that the picture follows the hand.
    const glm::dvec3 left = glm::cross(up, forward);
    const double yaw = glm::dot(left, axes[0]) < 0 ? -move.yaw : move.yaw;
    const PitchRange pitches = pitchRange(toWorld);
    const double pitch = std::clamp(move.pitch, pitches.lowest, pitches.highest); // seen from the point
    const glm::dmat3 turn = rotation(yaw, upright) * rotation(pitch, left);
    const double closeness = std::exp2(-move.nearer);
    glm::dmat3 turned = turn * axes;
    const glm::dvec3 shift =
        distance * closeness * (move.up * glm::normalize(turned[1]) - move.right * glm::normalize(turned[0]));
    const double eyeDistance = isOrthographic ? distance : distance * closeness;
    const glm::dvec3 newEye = pivot - eyeDistance * glm::normalize(turned[2]) + shift;
    if (isOrthographic) { // the picture grows with what it shows, not with the distance
        turned[0] *= closeness;
        turned[1] *= closeness;
    }
    glm::dmat4 result(turned);
    result[3] = glm::dvec4(newEye, 1);
    return result;
}

} // namespace quasilux

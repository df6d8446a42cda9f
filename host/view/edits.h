// What the page changes of a render: the camera, lamps, the method. All of it relative to the scene as its file has it.
#pragma once

#include "render/settings.h"

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace quasilux {

/// Of a camera about a point before it.
struct CameraMove {
    double yaw = 0, pitch = 0; ///< radians, about the upright axis next to the camera's, and up or down
    double nearer = 0;         ///< doublings: 1 halves the distance to the point
    double right = 0, up = 0;  ///< shifts, in distances to the point

    bool operator==(const CameraMove&) const = default;
};

/// How large CameraMove::nearer may be, either way.
inline constexpr double mostNearer = 30;

/// Of CameraMove::pitch. Beyond it the camera stays where it is, as left and right are lost over the top.
struct PitchRange {
    double lowest = 0, highest = 0;
};
/// `toWorld`: of the camera before it is moved.
PitchRange pitchRange(const glm::dmat4& toWorld);

struct ViewEdits {
    CameraMove camera;
    std::vector<double> lamps; ///< factor on the power of each lamp, at least 0; those that are missing: 1
    // Instead of the command line's and the scene's; not set: those.
    std::optional<unsigned> bdd;
    std::optional<std::string> variant, direct, map, quasiSpecular;
    bool isDraft = false; ///< others follow at once, as while the camera is dragged
    uint64_t number = 0;  ///< how many changes had come with this one

    /// Whether what was learned for the others serves this render as well.
    bool learnsAs(const ViewEdits& others) const {
        return (camera == others.camera || isDraft) && lamps == others.lamps && direct == others.direct &&
               map == others.map;
    }
};

/// From what the page sends; keys as the members, what is missing or null is not set. Throws InputError.
ViewEdits parseEdits(const nlohmann::json& json);
/// The same of its text.
ViewEdits parseEdits(const std::string& text);
/// As the page sends them, and their number.
nlohmann::json toJson(const ViewEdits& edits);

/// A scene whose camera and lamps can be changed again and again.
class EditedScene {
public:
    explicit EditedScene(Scene scene);

    const Scene& scene() const { return scene_; }
    /// The scene is as if these were the only ones ever made; lamps with a factor of 0 are no part of it. Throws
    /// InputError where none is left.
    void apply(const ViewEdits& edits);

    struct Lamp {
        std::string id, kind;
        bool operator==(const Lamp&) const = default;
    };
    std::vector<Lamp> lamps() const;
    /// Whether the sensor is one that can be moved.
    bool hasCamera() const { return scene_.sensor.meter == MeterKind::none; }
    /// How far it can be raised; not set where there is no such camera.
    std::optional<PitchRange> pitches() const;

private:
    /// As the file has them.
    struct Original {
        glm::dmat4 view{1};
        std::vector<std::optional<AreaEmitter>> byShape;
        std::vector<PointEmitter> points;
        std::vector<DirectionalEmitter> beams;
        std::optional<Surroundings> surroundings;
    };
    double distanceToMiddle() const;
    bool setSurroundings(float factor);

    Scene scene_;
    Original original_;
    double pivotDistance_;
};

/// The camera's frame after the move; `distance`: to the point before it.
glm::dmat4 moved(const glm::dmat4& toWorld, const CameraMove& move, double distance, bool isOrthographic);

} // namespace quasilux

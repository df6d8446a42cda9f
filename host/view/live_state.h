// What the page says beside the picture: how far the render is, its error over time, messages, what can be changed.
#pragma once

#include "render/renderer.h"
#include "view/edits.h"

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <nlohmann/json.hpp>
#include <utility>

namespace quasilux {

class LiveState {
public:
    /// What a render is, while it does not change.
    struct Render {
        std::string scene; ///< file name
        unsigned width = 0, height = 0;
        bool isEndless = false; ///< then no time is left to tell
        bool isMeter = false;
    };
    /// What can be changed, and how it is changed now. Not called: the render is only looked at.
    struct Editable {
        std::vector<EditedScene::Lamp> lamps;
        std::optional<PitchRange> pitches; ///< not set: the camera cannot be moved
        ViewEdits edits;
    };
    void setEditable(Editable editable);
    /// Another render begins; its chart is empty.
    void begin(const Render& render);
    void setSettings(const RenderSettings& settings);
    /// What its film can show.
    void setLayers(std::vector<std::string> layers);
    void setProgress(const Progress& progress);
    void setPasses(unsigned passes, double seconds);
    void setPhase(const std::string& phase);
    /// What is wrong with the scene or a change, with file, line and column; empty: nothing any more.
    void setProblem(const std::string& message);
    /// Nothing follows.
    void close();

    /// As JSON, once it is newer than `seen`, or after `patience`; key `version` is what to give as `seen` next.
    nlohmann::json wait(uint64_t seen, std::chrono::milliseconds patience) const;
    /// The part of it that says what a picture of this moment is of: render, settings, seconds, error.
    nlohmann::json origin() const;

private:
    void change() {
        ++version_;
        changed_.notify_all();
    }
    nlohmann::json json() const;

    mutable std::mutex mutex_;
    mutable std::condition_variable changed_;
    uint64_t version_ = 1, renders_ = 0;
    Render render_;
    std::vector<std::string> layers_;
    bool isClosed_ = false;
    std::optional<Editable> editable_;
    std::string phase_ = "loading", problem_;
    nlohmann::json settings_;
    Progress progress_;
    std::vector<std::pair<double, double>> errors_; ///< by seconds
};

} // namespace quasilux

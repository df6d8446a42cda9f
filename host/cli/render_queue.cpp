#include "cli/render_queue.h"

#include "cli/command_end.h"
#include "cli/interrupt.h"
#include "cli/render_command.h"
#include "cli/render_processes.h"
#include "ranks/job.h"
#include "scene/xml/read_files.h"
#include "util/error.h"
#include "util/messages.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fmt/format.h>
#include <map>
#include <thread>

namespace quasilux {

namespace {

constexpr std::chrono::milliseconds betweenLooks{100};

const char* adviceOf(const std::string& first, const std::string& second) {
    const auto stem = [](const std::string& scene) { return std::filesystem::path(scene).stem(); };
    return stem(first) == stem(second) ? "" : "write {scene} into the name, or ";
}

// Each scene with the names of its files. All are checked before the first is rendered, and no two may write the same
// file.
std::vector<RenderOptions> optionsByScene(const RenderOptions& options) {
    std::vector<RenderOptions> all;
    std::map<std::string, std::string> sceneOfFile;
    if (options.scenes.size() > 1 && !options.resume.empty())
        throw InputError(fmt::format("--resume {}: a checkpoint is of one scene, and {} are given", options.resume,
                                     options.scenes.size()));
    for (const std::string& scene : options.scenes) {
        all.push_back(options.forScene(scene));
        std::vector<std::string> files = all.back().fileNames();
        if (!all.back().checkpoint.empty()) files.push_back(all.back().checkpoint);
        for (const std::string& file : files) {
            const auto name = std::filesystem::path(file).lexically_normal().string();
            const auto [other, isNew] = sceneOfFile.emplace(name, scene);
            if (!isNew && options.scenes.size() > 1)
                throw InputError(fmt::format("{} and {} would both be written to {}: {}render them one by one",
                                             other->second, scene, file, adviceOf(other->second, scene)));
        }
    }
    if (all.size() > 1)
        for (const RenderOptions& one : all) {
            checkOutputs(one);
            std::error_code unknown;
            if (!options.watch && !std::filesystem::exists(one.scene, unknown))
                throw InputError(fmt::format("cannot read the scene file '{}': there is no such file.", one.scene));
        }
    return all;
}

RenderSurroundings surroundingsOf(const std::vector<RenderOptions>& all, size_t index) {
    RenderSurroundings around;
    if (all.size() > 1)
        around.label = fmt::format("{} ({} of {}): ", std::filesystem::path(all[index].scene).filename().string(),
                                   index + 1, all.size());
    return around;
}

std::vector<CommandEnd> renderInTurn(const std::vector<RenderOptions>& all) {
    std::vector<CommandEnd> ends;
    for (size_t k = 0; k < all.size() && !interruptFlag(); ++k) {
        ends.push_back(endOf([&] { return withResultsOut(renderCommand(all[k], surroundingsOf(all, k))); }));
        if (!ends.back().error.empty()) printError(ends.back().error);
    }
    return ends;
}

// Of a signal, else of a device or program that failed, else of bad input.
int worstOf(const std::vector<CommandEnd>& ends) {
    const auto rank = [](int code) { return code > exitBadInput ? 3 : code == exitFailed ? 2 : code != 0 ? 1 : 0; };
    int worst = 0;
    for (const CommandEnd& end : ends)
        if (rank(end.exitCode) > rank(worst)) worst = end.exitCode;
    return worst;
}

int summarise(const std::vector<RenderOptions>& all, const std::vector<CommandEnd>& ends) {
    size_t failed = 0;
    std::string list;
    for (size_t k = 0; k < ends.size(); ++k)
        if (!ends[k].error.empty()) {
            ++failed;
            list += fmt::format("\n  {}: {}", all[k].scene, ends[k].error);
        }
    if (failed > 0) printError(fmt::format("{} of {} scenes failed:{}", failed, all.size(), list));
    return worstOf(ends);
}

// A scene that is watched, with the files that it was read from the last time.
struct Watched {
    const RenderOptions& options;
    RenderSurroundings around;
    ReadFiles files;
    bool isDue = true;

    CommandEnd render() {
        isDue = false;
        files = {};
        const ReadFilesNoted noted(files);
        CommandEnd end = endOf([&] { return renderCommand(options, around); });
        std::fflush(stdout); // who reads a log is to see it now
        return end;
    }
};

// Until a signal ends it. A scene that is wrong is said so, and rendered when it has been mended.
int renderOnChange(const std::vector<RenderOptions>& all) {
    std::vector<Watched> scenes;
    scenes.reserve(all.size());
    for (size_t k = 0; k < all.size(); ++k) {
        scenes.push_back({all[k], surroundingsOf(all, k), {}, true});
        scenes.back().around.isOutdated = [&scene = scenes.back()] { return scene.files.haveChanged(); };
    }
    for (;;) {
        for (Watched& scene : scenes) {
            if (!scene.isDue) continue;
            const CommandEnd end = scene.render();
            if (!end.error.empty()) printError(end.error);
            scene.isDue = end.exitCode == exitCodeOutdated;
            if (interruptFlag()) return end.exitCode;
        }
        catchInterrupt();
        const auto isAnyDue = [&] {
            return std::any_of(scenes.begin(), scenes.end(), [](auto& s) { return s.isDue; });
        };
        while (!isAnyDue() && !interruptFlag()) {
            std::this_thread::sleep_for(betweenLooks);
            for (Watched& scene : scenes) scene.isDue = scene.files.haveChanged();
        }
        if (interruptFlag()) return exitCodeWhenWritten();
    }
}

} // namespace

int renderScenes(const RenderOptions& options) {
    const auto all = optionsByScene(options);
    if (launchedAs().size > 1 && (all.size() > 1 || options.watch))
        throw InputError("ranks of an MPI job share the passes of one render: give one scene, without --watch");
    if (options.watch) return renderOnChange(all);
    if (all.size() == 1) return renderCommand(all.front());
    return summarise(all, options.jobs > 1 ? renderAtOnce(all, options.jobs) : renderInTurn(all));
}

} // namespace quasilux

#include "cli/render_processes.h"

#include "cli/command_end.h"
#include "cli/interrupt.h"
#include "cli/render_command.h"
#include "output/progress_line.h"
#include "util/messages.h"
#include "util/nameless_file.h"

#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fmt/format.h>
#include <list>
#include <memory>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <system_error>
#include <thread>
#include <unistd.h>

namespace quasilux {

namespace {

constexpr std::chrono::milliseconds betweenQuestions{20};

struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

/// In the folder that TMPDIR names; tmpfile() knows no other folder than /tmp.
File temporaryFile() {
    std::error_code status;
    const std::string folder = std::filesystem::temp_directory_path(status).string();
    if (status) throw std::system_error(status, "no temporary file can be made: TMPDIR names no folder");
    const int descriptor = openNamelessFile(folder);
    if (descriptor < 0)
        throw std::system_error(errno, std::generic_category(),
                                fmt::format("no temporary file can be made in {}, name a folder by TMPDIR", folder));
    File file(fdopen(descriptor, "w+"));
    if (file) return file;
    const int why = errno;
    close(descriptor);
    throw std::system_error(why, std::generic_category(), "no temporary file can be opened");
}

std::string contentOf(std::FILE* file) {
    std::string content;
    std::rewind(file);
    for (int c = std::fgetc(file); c != EOF; c = std::fgetc(file)) content += static_cast<char>(c);
    return content;
}

class RenderProcess {
public:
    RenderProcess(const RenderOptions& options, size_t index) : index_(index) {
        std::fflush(nullptr);
        process_ = fork();
        if (process_ < 0) throw std::system_error(errno, std::generic_category(), "no process can be started");
        if (process_ == 0) render(options);
    }

    size_t index() const { return index_; }
    void hand(int signal) {
        handed_ = signal;
        kill(process_, signal);
    }

    /// Its end, once it has come; its texts are printed then.
    std::optional<CommandEnd> end() {
        int status = 0;
        if (waitpid(process_, &status, WNOHANG) != process_) return std::nullopt;
        std::fputs(contentOf(output_.get()).c_str(), stdout);
        std::fflush(stdout);
        std::fputs(contentOf(errors_.get()).c_str(), stderr);
        CommandEnd end{WIFEXITED(status) ? WEXITSTATUS(status) : exitFailed, contentOf(failure_.get())};
        if (WIFSIGNALED(status)) {
            end.error = fmt::format("its process was ended by signal {}", WTERMSIG(status));
            printError(end.error);
            if (WTERMSIG(status) == handed_) end.exitCode = exitCodeWithoutResult(); // while it knew no handler
        }
        return end;
    }

private:
    // In the new process. A terminal's Ctrl-C comes to the one that hands it on, and to this one once.
    [[noreturn]] void render(const RenderOptions& options) {
        setpgid(0, 0);
        prctl(PR_SET_PDEATHSIG, SIGKILL);
        dup2(fileno(output_.get()), STDOUT_FILENO);
        dup2(fileno(errors_.get()), STDERR_FILENO);
        RenderSurroundings around;
        around.drawsProgress = false;
        const CommandEnd end = endOf([&] { return withResultsOut(renderCommand(options, around)); });
        if (!end.error.empty()) printError(end.error);
        std::fputs(end.error.c_str(), failure_.get());
        std::fflush(nullptr);
        _exit(end.exitCode);
    }

    size_t index_;
    int handed_ = 0; ///< the signal that it was handed; 0: none
    File output_ = temporaryFile(), errors_ = temporaryFile(), failure_ = temporaryFile();
    pid_t process_ = -1;
};

} // namespace

std::vector<CommandEnd> renderAtOnce(const std::vector<RenderOptions>& all, unsigned jobs) {
    std::vector<CommandEnd> ends;
    std::list<RenderProcess> running;
    ProgressLine progress(stderr, !all.front().quiet);
    catchInterrupt();
    size_t done = 0;
    bool wasHanded = false;
    while (!running.empty() || (ends.size() < all.size() && !interruptFlag())) {
        while (running.size() < jobs && ends.size() < all.size() && !interruptFlag()) {
            running.emplace_back(all[ends.size()], ends.size());
            ends.emplace_back();
        }
        if (interruptFlag() && !std::exchange(wasHanded, true))
            for (RenderProcess& process : running) process.hand(signalThatCame());
        running.remove_if([&](RenderProcess& process) {
            const auto end = process.end();
            if (!end) return false;
            progress.clear();
            ends[process.index()] = *end;
            ++done;
            return true;
        });
        progress.update({.phase = fmt::format("{} of {} scenes done, {} running", done, all.size(), running.size())});
        std::this_thread::sleep_for(betweenQuestions);
    }
    return ends;
}

} // namespace quasilux

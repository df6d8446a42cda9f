// Which files a scene was read from, and whether they have changed since.
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <string>

namespace quasilux {

class ReadFiles {
public:
    /// As the file is now, which is about to be read, or was looked for in vain.
    void note(const std::string& path);
    /// Whether any is another one now. One that is gone may be in the middle of being replaced: it is waited for. Looks
    /// at most ten times a second.
    bool haveChanged();
    size_t count() const { return states_.size(); }

private:
    using Clock = std::chrono::steady_clock;
    /// An editor writes into the file, or renames another one to its name.
    struct State {
        int64_t seconds = 0, nanoseconds = 0, bytes = 0;
        uint64_t number = 0; ///< of the file in its file system; 0: there is none
        bool operator==(const State&) const = default;
    };
    static State stateOf(const std::string& path);

    std::map<std::string, State> states_;
    Clock::time_point last_{};
};

/// While it lives, `files` notes what this thread reads for scenes.
class ReadFilesNoted {
public:
    explicit ReadFilesNoted(ReadFiles& files);
    ~ReadFilesNoted();
    ReadFilesNoted(const ReadFilesNoted&) = delete;
    ReadFilesNoted& operator=(const ReadFilesNoted&) = delete;

private:
    ReadFiles* before_;
};

/// For the function that reads: tells the one who notes, if any.
void noteReadFile(const std::string& path);

} // namespace quasilux

// Holds a scene that is not trusted to its limits while it is loaded; one that is trusted has none.
#pragma once

#include "scene/load_limits.h"
#include "util/error.h"

#include <chrono>
#include <functional>
#include <optional>
#include <set>
#include <string>

namespace quasilux {

class LoadGuard {
public:
    explicit LoadGuard(const std::string& scene, const std::optional<LoadLimits>& limits = std::nullopt);

    bool isTrusted() const { return !limits_; }

    // All throw InputError at `where` beyond a limit.
    /// A file that is to be read.
    void admit(const std::string& path, const SourceLocation& where);
    /// A folder in which files are to be looked for.
    void admitFolder(const std::string& path, const SourceLocation& where);
    void addPixels(uint64_t count, const SourceLocation& where);
    /// Images are read anew: those so far are gone.
    void forgetPixels() { pixels_ = 0; }
    void addElement(const SourceLocation& where);
    /// So many files are open, one by the <include> of the other.
    void checkNesting(uint64_t files, const SourceLocation& where);
    /// What is being read now: as often as possible, since the time is looked at here.
    void note(const SourceLocation& where);

    /// Does `load` within the limit on memory.
    void withinMemory(const std::function<void()>& load);

private:
    using Clock = std::chrono::steady_clock;

    void check(uint64_t LoadLimits::*limit, uint64_t found, const SourceLocation& where) const;
    void checkInside(const std::string& path, const SourceLocation& where) const;

    std::optional<LoadLimits> limits_;
    std::string folder_; ///< of the scene, without symbolic links
    Clock::time_point start_ = Clock::now();
    SourceLocation now_;
    std::set<std::string> files_;
    uint64_t bytes_ = 0, pixels_ = 0, elements_ = 0;
};

} // namespace quasilux

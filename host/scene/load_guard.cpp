#include "scene/load_guard.h"

#include "util/memory_limit.h"

#include <OpenImageIO/imageio.h>
#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <fmt/format.h>
#include <new>
#include <stdexcept>
#include <system_error>

namespace quasilux {

namespace fs = std::filesystem;

namespace {

std::string withoutLinks(const fs::path& path) {
    std::error_code status;
    const fs::path real = fs::weakly_canonical(fs::absolute(path), status);
    return status ? std::string() : real.string();
}

/// While it lives, no threads of libraries help to read images: their stacks, one for each processor, would count
/// towards the limit on memory.
class ImagesByThisThread {
public:
    ImagesByThisThread() : exrThreads_(OIIO::get_int_attribute("exr_threads")) { OIIO::attribute("exr_threads", -1); }
    ~ImagesByThisThread() { OIIO::attribute("exr_threads", exrThreads_); }
    ImagesByThisThread(const ImagesByThisThread&) = delete;
    ImagesByThisThread& operator=(const ImagesByThisThread&) = delete;

private:
    int exrThreads_;
};

} // namespace

LoadGuard::LoadGuard(const std::string& scene, const std::optional<LoadLimits>& limits) : limits_(limits), now_{scene} {
    if (!isTrusted()) folder_ = withoutLinks(fs::absolute(scene).parent_path());
}

void LoadGuard::check(uint64_t LoadLimits::*limit, uint64_t found, const SourceLocation& where) const {
    if (isTrusted() || found <= (*limits_).*limit) return;
    const auto* const named = std::find_if(namedLimits.begin(), namedLimits.end(),
                                           [&](const NamedLimit& each) { return each.value == limit; });
    throw InputError(where,
                     fmt::format("more than {} {}, which a scene that is not trusted may not take; give --limit {}=N "
                                 "with a larger N, or leave out --untrusted if you know who made the scene.",
                                 (*limits_).*limit, named->of, named->name));
}

void LoadGuard::checkInside(const std::string& path, const SourceLocation& where) const {
    if (isTrusted() || !limits_->staysInside) return;
    const std::string real = withoutLinks(path);
    const auto [inFolder, rest] = std::mismatch(folder_.begin(), folder_.end(), real.begin(), real.end());
    const bool isInside = inFolder == folder_.end() && (rest == real.end() || *rest == '/' || folder_ == "/");
    if (!folder_.empty() && isInside) return;
    throw InputError(where, fmt::format("'{}' lies outside of the scene's folder '{}', which a scene that is not "
                                        "trusted may not leave; put the file there, or give --allow-outside.",
                                        path, folder_));
}

void LoadGuard::admitFolder(const std::string& path, const SourceLocation& where) {
    note(where);
    checkInside(path, where);
}

void LoadGuard::admit(const std::string& path, const SourceLocation& where) {
    if (isTrusted()) return;
    note(where);
    checkInside(path, where);
    if (!files_.insert(path).second) return;
    check(&LoadLimits::files, files_.size(), where);
    constexpr uint64_t mebibyte = 1 << 20;
    std::error_code status;
    const uint64_t bytes = fs::file_size(path, status); // readFile says what is wrong with the name
    if (!status) bytes_ += std::min<uint64_t>(bytes, INT64_MAX);
    check(&LoadLimits::mebibytes, bytes_ / mebibyte + (bytes_ % mebibyte != 0), where);
}

void LoadGuard::addPixels(uint64_t count, const SourceLocation& where) {
    pixels_ += count;
    check(&LoadLimits::pixels, pixels_, where);
}

void LoadGuard::addElement(const SourceLocation& where) {
    check(&LoadLimits::elements, ++elements_, where);
    note(where);
}

void LoadGuard::checkNesting(uint64_t files, const SourceLocation& where) { check(&LoadLimits::nesting, files, where); }

void LoadGuard::note(const SourceLocation& where) {
    if (isTrusted()) return;
    now_ = where;
    const auto whole = std::chrono::ceil<std::chrono::seconds>(Clock::now() - start_).count();
    check(&LoadLimits::seconds, static_cast<uint64_t>(whole), where);
}

void LoadGuard::withinMemory(const std::function<void()>& load) {
    if (isTrusted()) return load();
    const auto exceeded = [&] { check(&LoadLimits::memory, limits_->memory + 1, now_); };
    const ImagesByThisThread images;
    try {
        const MemoryLimit limit(limits_->memory << 20);
        errno = 0;
        return load();
    } catch (const InputError&) {
        if (errno == ENOMEM) exceeded(); // libraries say of a file that they cannot read it, if they lack memory
        throw;
    } catch (const std::system_error& error) { // there is no room for the stack of a thread
        if (error.code() != std::errc::resource_unavailable_try_again) throw;
        exceeded();
    } catch (const std::bad_alloc&) {
        exceeded();
    } catch (const std::length_error&) { // of an array for which no memory could ever suffice
        exceeded();
    }
}

} // namespace quasilux

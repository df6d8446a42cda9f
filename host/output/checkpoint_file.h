// The file of a checkpoint (docs/reference/reliability.md, "The file"): arrays, what they are as JSON, and a checksum
// over all.
#pragma once

#include "output/atomic_file.h"
#include "util/checksum.h"
#include "util/state_archive.h"

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

namespace quasilux {

inline constexpr const char* checkpointExtension = ".ckpt";

/// Where the checkpoint that a new one replaces is kept.
std::string previousCheckpoint(const std::string& path);

/// Writes arrays, then finish(). Without it nothing changes at `path`. Throws std::system_error where the disk is full
/// or fails.
class CheckpointWriter : public StateSink {
public:
    explicit CheckpointWriter(const std::string& path);

    void begin(const std::string& name) override;
    void write(const void* data, size_t bytes) override;
    /// `description` goes to the file, too. The checkpoint that was there is kept as previousCheckpoint().
    void finish(nlohmann::json description);

private:
    void put(const void* data, size_t bytes);

    std::string path_;
    AtomicFile file_;
    OutputStream stream_;
    Checksum checksum_;
    uint64_t written_ = 0;
    nlohmann::json arrays_ = nlohmann::json::array(); ///< [name, offset, bytes]
};

/// A checkpoint whose checksum is right. Throws InputError where there is no such file, or it is damaged.
class CheckpointReader : public StateSource {
public:
    explicit CheckpointReader(const std::string& path);

    const nlohmann::json& description() const { return description_; }
    const std::string& path() const { return path_; }
    std::vector<std::string> names() const;

    bool has(const std::string& name) const override { return places_.contains(name); }
    uint64_t bytes(const std::string& name) const override { return place(name).bytes; }
    void read(const std::string& name, uint64_t offset, void* into, size_t bytes) const override;

private:
    struct Place {
        uint64_t offset = 0, bytes = 0;
    };
    const Place& place(const std::string& name) const;
    void check(uint64_t fileBytes);
    void describe(uint64_t end, uint64_t bytes);
    void readAt(uint64_t offset, void* into, size_t bytes) const;
    [[noreturn]] void damaged(const std::string& why) const;

    std::string path_;
    mutable std::ifstream stream_;
    nlohmann::json description_;
    std::map<std::string, Place> places_;
};

} // namespace quasilux

// Named arrays in memory, in the order in which they were written (state_archive.h); packed into bytes to be sent
// elsewhere.
#pragma once

#include "util/state_archive.h"

#include <utility>

namespace quasilux {

class MemoryState : public StateSink, public StateSource {
public:
    /// An array of this name that is there already is replaced.
    void begin(const std::string& name) override;
    void write(const void* data, size_t bytes) override;

    bool has(const std::string& name) const override { return find(name) != nullptr; }
    uint64_t bytes(const std::string& name) const override { return array(name).size(); }
    void read(const std::string& name, uint64_t offset, void* into, size_t bytes) const override;

    void copyTo(StateSink& sink) const;
    std::vector<char> packed() const;
    /// Throws InputError where it was not packed().
    static MemoryState unpacked(const std::vector<char>& bytes);

private:
    using Bytes = std::vector<char>;
    const Bytes* find(const std::string& name) const;
    const Bytes& array(const std::string& name) const;

    std::vector<std::pair<std::string, Bytes>> arrays_;
    size_t open_ = 0; ///< the array that is written
};

} // namespace quasilux

// A checkpoint whose checksum is right: arrays, a byte 0, and the description, in which KERNELS stands for the checksum
// of the kernels.
#include "fuzz/input_files.h"
#include "fuzz/targets.h"

#include "learn/learned_state.h"
#include "output/render_checkpoint.h"

namespace quasilux::fuzz {

namespace {

constexpr std::string_view begin = "QLXCKPT2", kernels = "KERNELS";

std::string complete(std::string_view input) {
    const size_t zero = input.rfind('\0');
    const size_t arrays = zero == std::string_view::npos ? 0 : zero + 1;
    std::string description(input.substr(arrays));
    if (const size_t at = description.find(kernels); at != std::string::npos)
        description.replace(at, kernels.size(), kernelChecksum());
    const uint64_t bytes = description.size();
    std::string file = std::string(begin) + std::string(input.substr(0, arrays)) + description +
                       std::string(reinterpret_cast<const char*>(&bytes), sizeof bytes);
    Checksum checksum;
    checksum.add(file.data(), file.size());
    return file + checksum.digest();
}

} // namespace

void readCheckpoint(std::string_view input) {
    const std::string path = write("a.ckpt", complete(input));
    expectInputErrors([&] {
        const CheckpointReader reader(path);
        checkpointOf(reader);
        restoreLearned(reader);
    });
}

} // namespace quasilux::fuzz

#include "scene/volumes/vol_file.h"

#include "scene/xml/xml_document.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <fmt/format.h>

namespace quasilux {

namespace {

// "VOL", version, five integers (encoding, size, channels), the box as six floats; all little-endian.
constexpr size_t headerBytes = 48;
constexpr unsigned volVersion = 3, encodingFloat32 = 1;
constexpr unsigned longestSide = 1 << 16;

class VolReader {
public:
    VolReader(const std::string& path, const SourceLocation& where)
        : path_(path), where_(where), content_(readFile(path, where, "volume")) {}

    VolFile read() const {
        checkStart();
        VolFile file;
        for (size_t axis = 0; axis < 3; ++axis) file.size[axis] = at<uint32_t>(8 + 4 * axis);
        file.channels = at<uint32_t>(20);
        checkSize(file);
        for (int axis = 0; axis < 3; ++axis) {
            file.lower[axis] = double(at<float>(24 + 4 * size_t(axis)));
            file.upper[axis] = double(at<float>(36 + 4 * size_t(axis)));
        }
        file.values.resize(count(file));
        std::memcpy(file.values.data(), content_.data() + headerBytes, file.values.size() * sizeof(float));
        checkValues(file);
        return file;
    }

private:
    [[noreturn]] void fail(const std::string& why) const {
        throw InputError(where_, fmt::format("cannot read the volume '{}': {}", path_, why));
    }

    template <typename T>
    T at(size_t offset) const {
        T value;
        std::memcpy(&value, content_.data() + offset, sizeof value);
        return value;
    }

    void checkStart() const {
        if (content_.size() < headerBytes || content_.compare(0, 3, "VOL") != 0)
            fail("it is no .vol file: these begin with 'VOL' and a header of 48 bytes.");
        if (const unsigned found = static_cast<unsigned char>(content_[3]); found != volVersion)
            fail(fmt::format("it is of version {}; expected version 3.", found));
        if (const auto encoding = at<uint32_t>(4); encoding != encodingFloat32)
            fail(fmt::format("its values are of encoding {}; expected 1, 32-bit floating point.", encoding));
    }

    static size_t count(const VolFile& file) {
        return size_t(file.size[0]) * file.size[1] * file.size[2] * file.channels;
    }

    // Before anything is allocated.
    void checkSize(const VolFile& file) const {
        const auto [x, y, z] = file.size;
        if (std::min({x, y, z}) < 1 || std::max({x, y, z}) > longestSide)
            fail(fmt::format("it has {} x {} x {} voxels; expected 1 to {} along each side.", x, y, z, longestSide));
        if (file.channels != 1 && file.channels != 3)
            fail(fmt::format("it has {} channels; expected 1 or 3.", file.channels));
        const size_t expected = headerBytes + sizeof(float) * count(file), found = content_.size();
        if (found != expected)
            fail(fmt::format("{} x {} x {} voxels of {} channels take {} bytes; the file has {}.", x, y, z,
                             file.channels, expected, found));
    }

    void checkValues(const VolFile& file) const {
        for (size_t i = 0; i < file.values.size(); ++i) {
            if (std::isfinite(file.values[i]) && file.values[i] >= 0) continue;
            const size_t voxel = i / file.channels, row = voxel / file.size[0];
            fail(fmt::format("voxel {}, {}, {} has the value {}; expected finite ones of at least 0.",
                             voxel % file.size[0], row % file.size[1], row / file.size[1], file.values[i]));
        }
    }

    const std::string& path_;
    const SourceLocation& where_;
    std::string content_;
};

} // namespace

VolFile readVolFile(const std::string& path, const SourceLocation& where) { return VolReader(path, where).read(); }

} // namespace quasilux

// <shape type="serialized">: Mitsuba's own format of meshes, versions 3 and 4: a header, then zlib's stream; several
// meshes in a file, whose offsets stand at its end.
#include "scene/shapes/mesh_builder.h"
#include "scene/shapes/shape_plugin.h"
#include "scene/xml/xml_document.h"

#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <limits>
#include <zlib.h>

namespace quasilux {

namespace {

constexpr uint16_t serializedMagic = 0x041C;
constexpr size_t serializedHeader = 4; // bytes: magic and version
/// 0x0010, flat faces, has no effect in Mitsuba 3 either.
enum SerializedFlags : uint32_t {
    hasNormals = 0x0001,
    hasTexCoords = 0x0002,
    hasColors = 0x0008,
    doublePrecision = 0x2000
};

/// The number that begins at `bytes`, little endian.
template <typename T>
T fromLittleEndian(const unsigned char* bytes) {
    uint64_t bits = 0;
    for (size_t i = 0; i < sizeof(T); ++i) bits |= uint64_t(bytes[i]) << (8 * i);
    T value;
    if constexpr (std::is_floating_point_v<T>) {
        const auto narrow = static_cast<std::conditional_t<sizeof(T) == 4, uint32_t, uint64_t>>(bits);
        std::memcpy(&value, &narrow, sizeof(T));
    } else {
        value = static_cast<T>(bits);
    }
    return value;
}

[[noreturn]] void failSerialized(const std::string& path, const std::string& message) {
    throw InputError(SourceLocation{path, 0, 0}, message);
}

/// What zlib compressed, read in pieces.
class InflatedStream {
public:
    InflatedStream(std::string path, std::string_view compressed) : path_(std::move(path)) {
        // zlib's interface takes what it only reads as not const.
        stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(compressed.data()));
        stream_.avail_in = static_cast<uInt>(std::min<size_t>(compressed.size(), std::numeric_limits<uInt>::max()));
        if (inflateInit(&stream_) != Z_OK) failSerialized(path_, "zlib cannot begin to read it.");
    }
    ~InflatedStream() { inflateEnd(&stream_); }
    InflatedStream(const InflatedStream&) = delete;
    InflatedStream& operator=(const InflatedStream&) = delete;

    /// Whether that many bytes may still follow: zlib packs no more than 1032 into one.
    bool canHold(uint64_t bytes) const {
        constexpr uint64_t mostPerByte = 1032, buffered = 1 << 16;
        return bytes <= (uint64_t(stream_.avail_in) + 1) * mostPerByte + buffered;
    }

    /// `what` is what is read, for the message where there is none.
    void read(unsigned char* bytes, size_t count, const char* what) {
        stream_.next_out = bytes;
        stream_.avail_out = static_cast<uInt>(count);
        while (stream_.avail_out > 0) {
            const int state = inflate(&stream_, Z_NO_FLUSH);
            if (state == Z_STREAM_END && stream_.avail_out > 0)
                failSerialized(path_, fmt::format("{}: the mesh ends too early; its header promises more.", what));
            if (state != Z_OK && state != Z_STREAM_END)
                failSerialized(path_, fmt::format("{}: the compressed data are damaged or end too early.", what));
        }
    }

    template <typename T>
    T number(const char* what) {
        unsigned char bytes[sizeof(T)];
        read(bytes, sizeof(T), what);
        return fromLittleEndian<T>(bytes);
    }

private:
    std::string path_;
    z_stream stream_{};
};

class SerializedReader {
public:
    SerializedReader(const std::string& path, std::string_view content, int version)
        : path_(path), in_(path, content), version_(version) {}

    MeshSource read() {
        flags_ = in_.number<uint32_t>("flags");
        if (version_ >= 4) passOverName();
        vertices_ = count("vertices", 3 * scalarBytes());
        const size_t faces = count("triangles", 3 * sizeof(uint32_t));
        if (faces == 0) failSerialized(path_, "the mesh has no triangles.");
        for (const auto& p : vectors<glm::dvec3>("position")) mesh_.positions.push_back(p);
        if (flags_ & hasNormals) mesh_.normals = vectors<glm::dvec3>("normal");
        if (flags_ & hasTexCoords) mesh_.uvs = vectors<glm::dvec2>("texture coordinate");
        if (flags_ & hasColors) vectors<glm::dvec3>("color");
        readTriangles(faces);
        return std::move(mesh_);
    }

private:
    /// A few bytes of a file may unpack to any length.
    void passOverName() {
        constexpr size_t most = 1 << 16;
        for (size_t length = 0; in_.number<unsigned char>("name") != 0; ++length)
            if (length == most)
                failSerialized(path_, fmt::format("the mesh's name has more than {} bytes; shorten it.", most));
    }

    size_t scalarBytes() const { return flags_ & doublePrecision ? sizeof(double) : sizeof(float); }

    size_t count(const char* what, size_t bytesEach) {
        const auto value = in_.number<uint64_t>(what);
        constexpr uint64_t most = 1 << 28; // 3 GB of positions
        if (value > most || !in_.canHold(value * bytesEach))
            failSerialized(path_, fmt::format("{} {} are more than the file can hold.", value, what));
        return static_cast<size_t>(value);
    }

    template <typename Vector>
    std::vector<Vector> vectors(const char* what) {
        constexpr auto size = static_cast<size_t>(Vector::length());
        const size_t bytesEach = scalarBytes();
        if (!in_.canHold(vertices_ * size * bytesEach))
            failSerialized(path_, fmt::format("{}: {} are more than the file can hold.", what, vertices_));
        std::vector<Vector> all;
        for (size_t i = 0; i < vertices_; ++i) {
            unsigned char bytes[size * sizeof(double)];
            in_.read(bytes, size * bytesEach, what);
            Vector vector;
            for (size_t c = 0; c < size; ++c) {
                const unsigned char* at = bytes + c * bytesEach;
                const double value =
                    bytesEach == sizeof(double) ? fromLittleEndian<double>(at) : double(fromLittleEndian<float>(at));
                if (!std::isfinite(value))
                    failSerialized(path_, fmt::format("{} {} is not made of finite numbers.", what, i));
                vector[static_cast<glm::length_t>(c)] = value;
            }
            all.push_back(vector);
        }
        return all;
    }

    void readTriangles(size_t count) {
        for (size_t t = 0; t < count; ++t) {
            std::array<MeshSource::Corner, 3> corners;
            unsigned char bytes[3 * sizeof(uint32_t)];
            in_.read(bytes, sizeof(bytes), "triangle");
            for (size_t c = 0; c < 3; ++c) {
                const auto index = fromLittleEndian<uint32_t>(bytes + c * sizeof(uint32_t));
                if (index >= vertices_)
                    failSerialized(path_, fmt::format("triangle {}: vertex {} does not exist; there are {}.", t, index,
                                                      vertices_));
                corners[c].position = index;
                corners[c].vertex = index;
                if (flags_ & hasNormals) corners[c].normal = index;
                if (flags_ & hasTexCoords) corners[c].uv = index;
            }
            mesh_.triangles.push_back(corners);
        }
    }

    const std::string& path_;
    InflatedStream in_;
    int version_;
    uint32_t flags_ = 0;
    size_t vertices_ = 0;
    MeshSource mesh_;
};

/// Where the mesh of that index begins, by the table at the end of the file.
size_t offsetOf(const std::string& path, const std::string& content, int version, int64_t index,
                const SourceLocation& where) {
    if (index == 0) return 0;
    const auto* bytes = reinterpret_cast<const unsigned char*>(content.data());
    const auto meshes = fromLittleEndian<uint32_t>(bytes + content.size() - sizeof(uint32_t));
    const size_t entry = version >= 4 ? sizeof(uint64_t) : sizeof(uint32_t);
    if (meshes > (content.size() - sizeof(uint32_t)) / entry)
        failSerialized(path, fmt::format("the file ends with {} meshes, which is more than it can hold.", meshes));
    if (index < 0 || index >= int64_t(meshes))
        throw InputError(where,
                         fmt::format("there is no mesh {} in '{}'; it has {}, counted from 0.", index, path, meshes));
    const unsigned char* at = bytes + content.size() - sizeof(uint32_t) - entry * (meshes - static_cast<size_t>(index));
    return version >= 4 ? fromLittleEndian<uint64_t>(at) : fromLittleEndian<uint32_t>(at);
}

MeshSource readSerializedFile(const MeshFile& file, const SourceLocation& whereIndex) {
    const std::string content = readFile(file.path, file.where, "mesh");
    const auto header = [&](size_t at) {
        if (content.size() < 2 * serializedHeader || at > content.size() - 2 * serializedHeader)
            failSerialized(file.path, "the file ends too early.");
        const auto* bytes = reinterpret_cast<const unsigned char*>(content.data()) + at;
        if (fromLittleEndian<uint16_t>(bytes) != serializedMagic)
            failSerialized(file.path, "this is not a serialized mesh; expected 0x041C at its beginning.");
        const int version = fromLittleEndian<uint16_t>(bytes + sizeof(uint16_t));
        if (version != 3 && version != 4)
            failSerialized(file.path, fmt::format("version {}; known: 3 and 4.", version));
        return version;
    };
    const int version = header(0);
    const size_t offset = offsetOf(file.path, content, version, file.index, whereIndex);
    header(offset);
    return SerializedReader(file.path, std::string_view(content).substr(offset + serializedHeader), version).read();
}

} // namespace

void readSerialized(Properties& properties, ShapeDescription& shape) {
    MeshFile file = readMeshFile(properties);
    file.index = properties.integer("shape_index", 0);
    const SourceLocation whereIndex = properties.where("shape_index");
    shape.mesh = placeMeshFile(
        file, [&] { return readSerializedFile(file, whereIndex); }, properties, shape);
}

} // namespace quasilux

// <shape type="obj">: Wavefront OBJ. Polygons are fanned; groups, materials, lines and curves are passed over.
#include "scene/shapes/mesh_builder.h"
#include "scene/shapes/shape_plugin.h"
#include "scene/xml/numbers.h"
#include "scene/xml/xml_document.h"

#include <algorithm>
#include <fmt/format.h>
#include <functional>
#include <utility>

namespace quasilux {

namespace {

const Names ignoredKeywords = {
    "o",    "g",    "s",      "usemtl", "mtllib",   "usemap",   "maplib", "l",          "p",         "vp",    "deg",
    "bmat", "step", "cstype", "curv",   "curv2",    "surf",     "parm",   "trim",       "hole",      "scrv",  "sp",
    "end",  "con",  "mg",     "bevel",  "c_interp", "d_interp", "lod",    "shadow_obj", "trace_obj", "ctech", "stech"};

class ObjReader {
public:
    /// `refuse` is called for the first line of an unknown keyword; where it returns, all such lines are passed over.
    using Refuse = std::function<void(const SourceLocation& where, const std::string& message)>;

    ObjReader(std::string path, std::string text, bool flipTexCoords, Refuse refuse)
        : text_(std::move(text)), refuse_(std::move(refuse)), flipTexCoords_(flipTexCoords) {
        where_.file = std::move(path);
    }

    MeshSource read() {
        where_.line = 1;
        for (size_t begin = 0; begin < text_.size();) {
            int lines = 0;
            const size_t end = joinLines(begin, lines);
            readLine(std::string_view(text_).substr(begin, end - begin));
            begin = end + 1;
            where_.line += lines;
        }
        positions_.check(mesh_.positions.size());
        normals_.check(mesh_.normals.size());
        uvs_.check(mesh_.uvs.size());
        if (mesh_.triangles.empty())
            throw InputError(SourceLocation{where_.file}, "the mesh has no faces; expected lines 'f …'.");
        return std::move(mesh_);
    }

private:
    /// The largest index to elements of a kind, which may follow the face.
    struct LargestIndex {
        std::string_view what;
        int64_t index = 0;
        SourceLocation where = {};

        void check(size_t count) const {
            if (index > static_cast<int64_t>(count))
                throw InputError(where,
                                 fmt::format("face: {} index {} does not exist; the file has {}.", what, index, count));
        }
    };

    /// Makes those `lines` one of which each but the last ends in a backslash, which continues it; one that ends a
    /// comment is part of that. Returns where they end.
    size_t joinLines(size_t begin, int& lines) {
        size_t end = begin;
        for (lines = 1;; ++lines) {
            const size_t start = end;
            end = std::min(text_.find('\n', start), text_.size());
            const std::string_view line = std::string_view(text_).substr(start, end - start);
            const size_t last = line.find_last_not_of('\r');
            if (last == std::string_view::npos || line[last] != '\\' || line.find('#') != std::string_view::npos)
                return end;
            std::fill_n(text_.begin() + ptrdiff_t(start + last), std::min(end + 1, text_.size()) - start - last, ' ');
        }
    }

    void readLine(std::string_view line) {
        line = line.substr(0, line.find('#'));
        const std::vector<std::string_view> words = splitWords(line);
        if (words.empty()) return;
        if (words[0] == "v")
            mesh_.positions.push_back(readVector(words, "vertex"));
        else if (words[0] == "vn")
            mesh_.normals.push_back(readVector(words, "normal"));
        else if (words[0] == "vt")
            mesh_.uvs.push_back(readUv(words));
        else if (words[0] == "f")
            readFace(words);
        else if (std::find(ignoredKeywords.begin(), ignoredKeywords.end(), words[0]) == ignoredKeywords.end())
            refuseOnce(
                fmt::format("unknown line '{}'; expected v, vn, vt, f or another keyword of OBJ.", line.substr(0, 40)));
    }

    void refuseOnce(const std::string& message) {
        if (!std::exchange(hasRefused_, true)) refuse_(where_, message);
    }

    static std::vector<std::string_view> splitWords(std::string_view line) {
        std::vector<std::string_view> words;
        size_t begin = 0;
        while ((begin = line.find_first_not_of(" \t\r", begin)) != std::string_view::npos) {
            const size_t end = std::min(line.find_first_of(" \t\r", begin), line.size());
            words.push_back(line.substr(begin, end - begin));
            begin = end;
        }
        return words;
    }

    glm::dvec3 readVector(const std::vector<std::string_view>& words, std::string_view what) const {
        if (words.size() < 4)
            throw InputError(where_, fmt::format("a {} with {} numbers; expected three.", what, words.size() - 1));
        return {parseNumber(words[1], where_, what), parseNumber(words[2], where_, what),
                parseNumber(words[3], where_, what)};
    }

    /// A second number may be missing: v is 0 then.
    glm::dvec2 readUv(const std::vector<std::string_view>& words) const {
        if (words.size() < 2) throw InputError(where_, "a texture coordinate without numbers; expected two.");
        const double u = parseNumber(words[1], where_, "texture coordinate");
        const double v = words.size() > 2 ? parseNumber(words[2], where_, "texture coordinate") : 0;
        return {u, flipTexCoords_ ? 1 - v : v};
    }

    /// An index counted from 1, or from the last one back where negative.
    unsigned readIndex(std::string_view text, size_t count, LargestIndex& largest) {
        const int64_t index = parseInteger(text, where_, fmt::format("face: {} index", largest.what));
        const int64_t resolved = index < 0 ? static_cast<int64_t>(count) + index : index - 1;
        if (index == 0 || resolved < 0 || resolved >= QL_NONE)
            throw InputError(where_, fmt::format("face: {} index {} does not exist; {} are given before this line.",
                                                 largest.what, index, count));
        if (index > largest.index) {
            largest.index = index;
            largest.where = where_;
        }
        return static_cast<unsigned>(resolved);
    }

    /// "v", "v/t", "v//n" or "v/t/n"; what is empty after a slash is not given.
    MeshSource::Corner readCorner(std::string_view word) {
        const size_t slash = std::min(word.find('/'), word.size());
        MeshSource::Corner corner;
        corner.position = readIndex(word.substr(0, slash), mesh_.positions.size(), positions_);
        corner.vertex = corner.position;
        if (slash == word.size()) return corner;
        word.remove_prefix(slash + 1);
        const size_t second = std::min(word.find('/'), word.size());
        if (second > 0) { // a seam of texture coordinates splits the vertex, and so its computed normal, as in Mitsuba
            corner.uv = readIndex(word.substr(0, second), mesh_.uvs.size(), uvs_);
            corner.vertex |= uint64_t(corner.uv + 1) << 32;
        }
        if (second + 1 < word.size())
            corner.normal = readIndex(word.substr(second + 1), mesh_.normals.size(), normals_);
        return corner;
    }

    /// Of points and lines nothing is left.
    void readFace(const std::vector<std::string_view>& words) {
        if (words.size() < 4) return;
        const MeshSource::Corner first = readCorner(words[1]);
        MeshSource::Corner previous = readCorner(words[2]);
        for (size_t i = 3; i < words.size(); ++i) {
            const MeshSource::Corner next = readCorner(words[i]);
            mesh_.triangles.push_back({first, previous, next});
            previous = next;
        }
    }

    std::string text_;
    Refuse refuse_;
    SourceLocation where_;
    MeshSource mesh_;
    LargestIndex positions_{"vertex"}, normals_{"normal"}, uvs_{"texture"};
    bool flipTexCoords_, hasRefused_ = false;
};

} // namespace

void readObj(Properties& properties, ShapeDescription& shape) {
    MeshFile file = readMeshFile(properties);
    file.flipTexCoords = properties.boolean("flip_tex_coords", true);
    const auto refuse = [&](const SourceLocation& where, const std::string& message) {
        properties.context().refuseUnknown(where, message, "lines of unknown keywords are passed over");
    };
    const auto read = [&] {
        return ObjReader(file.path, readTextFile(file.path, file.where, "mesh"), file.flipTexCoords, refuse).read();
    };
    shape.mesh = placeMeshFile(file, read, properties, shape);
}

} // namespace quasilux

#include "scene/gltf/model_file.h"

#include "scene/xml/names.h"
#include "scene/xml/read_files.h"
#include "scene/xml/xml_document.h"

#include <algorithm>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace quasilux {

namespace {

using Bytes = std::vector<unsigned char>;

const Names knownExtensions = {"EXT_lights_ies",
                               "EXT_mesh_gpu_instancing",
                               "KHR_lights_punctual",
                               "KHR_materials_clearcoat",
                               "KHR_materials_emissive_strength",
                               "KHR_materials_ior",
                               "KHR_materials_specular",
                               "KHR_materials_transmission",
                               "KHR_materials_volume",
                               "KHR_mesh_quantization",
                               "KHR_texture_transform"};

// tinygltf reads what is free of form, such as extras, by recursion.
constexpr int maximumJsonNesting = 100;

constexpr size_t glbHeader = 12, chunkHeader = 8;

uint32_t wordAt(const std::string& bytes, size_t offset) {
    uint32_t word = 0;
    for (size_t k = 4; k-- > 0;) word = word << 8 | static_cast<unsigned char>(bytes[offset + k]);
    return word;
}

bool isBinary(const std::string& bytes) { return bytes.compare(0, 4, "glTF") == 0; }

/// The JSON in a file of either form.
std::string_view jsonOf(const std::string& bytes, const std::string& path) {
    if (!isBinary(bytes)) return bytes;
    constexpr uint32_t jsonChunk = 0x4e4f534a;
    const auto fail = [&](const std::string& why) {
        throw InputError({path}, fmt::format("malformed GLB: {}. It may have been cut off.", why));
    };
    if (bytes.size() < glbHeader + chunkHeader)
        fail(fmt::format("{} bytes; expected a header of {}", bytes.size(), glbHeader + chunkHeader));
    if (wordAt(bytes, 4) != 2)
        throw InputError({path}, fmt::format("GLB version {}; expected 2. Export it as glTF 2.0.", wordAt(bytes, 4)));
    const size_t stated = wordAt(bytes, 8), length = wordAt(bytes, 12);
    if (stated > bytes.size()) fail(fmt::format("its header states {} bytes, the file has {}", stated, bytes.size()));
    if (wordAt(bytes, 16) != jsonChunk) fail("its first chunk is not JSON");
    if (length > stated || length + glbHeader + chunkHeader > stated)
        fail(fmt::format("its JSON of {} bytes reaches beyond the {} that its header states", length, stated));
    return std::string_view(bytes).substr(glbHeader + chunkHeader, length);
}

void checkNesting(std::string_view json, const std::string& path) {
    int depth = 0;
    bool inString = false;
    for (size_t i = 0; i < json.size(); ++i) {
        const char c = json[i];
        if (inString && c == '\\')
            ++i;
        else if (c == '"')
            inString = !inString;
        else if (!inString && (c == '{' || c == '[') && ++depth > maximumJsonNesting)
            throw InputError({path}, fmt::format("JSON nested deeper than {}.", maximumJsonNesting));
        else if (!inString && (c == '}' || c == ']'))
            --depth;
    }
}

nlohmann::json parsed(std::string_view json, const std::string& path) {
    try {
        return nlohmann::json::parse(json);
    } catch (const nlohmann::json::parse_error& error) {
        const std::string_view before = json.substr(0, std::min(json.size(), std::max<size_t>(error.byte, 1) - 1));
        const auto line = int(std::count(before.begin(), before.end(), '\n'));
        const auto column = int(before.size() - (before.rfind('\n') + 1)); // npos + 1 is 0
        const std::string text = error.what();
        throw InputError({path, line + 1, column + 1},
                         fmt::format("malformed JSON: {}.", text.substr(text.find(": ") + 2)));
    }
}

void checkVersion(const nlohmann::json& json, const std::string& path) {
    const auto at = [](const nlohmann::json& object, const char* name) {
        return object.is_object() && object.contains(name) ? object[name] : nlohmann::json();
    };
    const nlohmann::json version = at(at(json, "asset"), "version");
    if (!version.is_string()) throw InputError({path + ": asset"}, "the file states no version; expected glTF 2.0.");
    const std::string text = version.get<std::string>();
    if (text.rfind("2.", 0) != 0)
        throw InputError({path + ": asset"},
                         fmt::format("glTF version {}; expected 2.0. Export it as glTF 2.0.", text));
}

/// Before anything else of the file is looked at, which may make no sense without them.
void checkRequired(const nlohmann::json& json, const std::string& path, Unknown unknown,
                   std::vector<std::string>& forgiven) {
    if (!json.contains("extensionsRequired") || !json["extensionsRequired"].is_array()) return;
    for (const auto& entry : json["extensionsRequired"]) {
        if (!entry.is_string() || isKnownGltfExtension(entry.get<std::string>())) continue;
        const std::string name = entry.get<std::string>();
        if (unknown == Unknown::refused)
            throw InputError({path + ": extensionsRequired"},
                             fmt::format("the file requires the extension '{}', which is not supported; export it "
                                         "without, or give --lenient to leave out what it is about. Known: {}.",
                                         name, joinNames(knownExtensions)));
        forgiven.push_back(
            asMessage(fmt::format("{}: the required extension '{}' is not supported. It is ignored.", path, name)));
    }
}

/// What tinygltf asks for, by the rules of all files of scenes. It is a library of no exceptions: the first one waits
/// here.
struct FileAccess {
    const FileResolver& files;
    SourceLocation where;
    std::exception_ptr failure = nullptr;

    std::string resolve(const std::string& name) {
        try {
            std::string found = files.resolve(name, where);
            noteReadFile(found);
            std::error_code ignored;
            if (std::filesystem::exists(found, ignored)) return found;
            readFile(found, where, "glTF"); // says that there is none
        } catch (...) {
            if (!failure) failure = std::current_exception();
        }
        return {};
    }
    bool read(const std::string& name, Bytes& bytes) {
        const std::string found = resolve(name);
        if (found.empty()) return false;
        try {
            const std::string content = readFile(found, where, "glTF");
            bytes.assign(content.begin(), content.end());
            return true;
        } catch (...) {
            if (!failure) failure = std::current_exception();
        }
        return false;
    }
};

tinygltf::FsCallbacks callbacksOf(FileAccess& access) {
    tinygltf::FsCallbacks calls{};
    calls.FileExists = [](const std::string& name, void* user) {
        return !static_cast<FileAccess*>(user)->resolve(name).empty();
    };
    calls.ExpandFilePath = [](const std::string& name, void*) { return name; };
    calls.ReadWholeFile = [](Bytes* bytes, std::string*, const std::string& name, void* user) {
        return static_cast<FileAccess*>(user)->read(name, *bytes);
    };
    calls.WriteWholeFile = [](std::string*, const std::string&, const Bytes&, void*) { return false; };
    calls.user_data = &access;
    return calls;
}

/// Keeps an image as it is encoded. One in a buffer is found again by its view, whose bounds nobody has checked yet.
bool keepEncoded(tinygltf::Image* image, const int, std::string*, std::string*, int, int, const unsigned char* bytes,
                 int size, void*) {
    image->as_is = true;
    if (image->bufferView < 0 && size > 0) image->image.assign(bytes, bytes + size);
    return true;
}

/// The first line of what the library says.
std::string reasonOf(const std::string& errors) {
    constexpr size_t most = 200; // it may quote all data of a buffer
    const std::string first = errors.substr(0, std::min(errors.find('\n'), most));
    return first.empty() ? "unknown reason" : first;
}

} // namespace

bool isKnownGltfExtension(const std::string& name) {
    return std::find(knownExtensions.begin(), knownExtensions.end(), name) != knownExtensions.end();
}

tinygltf::Model readGltfModel(const std::string& path, const FileResolver& files, Unknown unknown,
                              std::vector<std::string>& forgiven) {
    std::string bytes = readTextFile(path, {}, "scene");
    if (bytes.size() >= UINT32_MAX)
        throw InputError({path}, "the file has 4 GiB or more; expected a smaller one, with its buffers in files.");
    const std::string_view json = jsonOf(bytes, path);
    checkNesting(json, path);
    const nlohmann::json tree = parsed(json, path);
    checkVersion(tree, path);
    checkRequired(tree, path, unknown, forgiven);

    FileAccess access{files, {path}};
    tinygltf::TinyGLTF loader;
    loader.SetFsCallbacks(callbacksOf(access));
    loader.SetImageLoader(keepEncoded, nullptr);
    tinygltf::Model model;
    std::string errors, warnings;
    bool isRead = false;
    const auto size = static_cast<unsigned>(bytes.size());
    const bool binary = isBinary(bytes);
    bytes.append(chunkHeader, '\0'); // tinygltf leaves out the second chunk's header where it checks its length
    try {
        isRead = binary ? loader.LoadBinaryFromMemory(&model, &errors, &warnings,
                                                      reinterpret_cast<const unsigned char*>(bytes.data()), size, "")
                        : loader.LoadASCIIFromString(&model, &errors, &warnings, bytes.data(), size, "");
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& error) {
        errors = error.what();
    }
    if (access.failure) std::rethrow_exception(access.failure);
    // The library says of some values that they are wrong, and takes others.
    if (!isRead || !errors.empty())
        throw InputError({path}, fmt::format("not a valid glTF file: {}.", reasonOf(errors)));
    return model;
}

} // namespace quasilux

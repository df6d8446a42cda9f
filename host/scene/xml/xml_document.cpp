// Turns files into the tree of elements; pugixml is used here only.
#include "scene/xml/xml_document.h"

#include "scene/xml/names.h"
#include "scene/xml/plain_instances.h"
#include "scene/xml/read_files.h"
#include "scene/xml/tag_pairs.h"
#include "scene/xml/tags.h"
#include "scene/xml/upgrade.h"

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <pugixml.hpp>
#include <set>
#include <system_error>
#include <utility>

namespace quasilux {

namespace {

constexpr size_t maximumValue = 1 << 16; // parameters made of parameters can double at each step

/// Lines and columns of one file.
class TextPositions {
public:
    TextPositions(std::string file, const std::string& text) : file_(std::move(file)) {
        lineStarts_.push_back(0);
        for (size_t i = 0; i < text.size(); ++i)
            if (text[i] == '\n') lineStarts_.push_back(i + 1);
    }
    SourceLocation at(ptrdiff_t offset) const {
        if (offset < 0) return {file_, 0, 0};
        const auto next = std::upper_bound(lineStarts_.begin(), lineStarts_.end(), static_cast<size_t>(offset));
        return {file_, static_cast<int>(next - lineStarts_.begin()),
                static_cast<int>(static_cast<size_t>(offset) - *(next - 1)) + 1};
    }

private:
    std::string file_;
    std::vector<size_t> lineStarts_;
};

/// As the parameter `name` of the object around it.
void rename(Element& object, const std::string& name) {
    auto& all = object.attributes;
    all.erase(std::remove_if(all.begin(), all.end(), [](const Attribute& a) { return a.name == "name"; }), all.end());
    all.push_back({"name", name});
}

struct Parameter {
    std::string name, value;
    bool given = false; ///< by the caller; a `<default>` does not change it
    bool used = false;
};

class DocumentReader {
public:
    DocumentReader(const std::string& path, const SceneParameters& parameters, Unknown unknown,
                   std::shared_ptr<LoadGuard> guard)
        : files_(path, std::move(guard)), folders_{folderOf(path)}, unknown_(unknown) {
        for (const auto& [name, value] : parameters) {
            for (const Parameter& earlier : parameters_)
                if (earlier.name == name)
                    throw InputError(fmt::format("parameter '{}' is given twice; give it once.", name));
            parameters_.push_back({name, value, true, false});
        }
    }

    /// Root element of a file, as it stands; `mention` is the place that named the file.
    Element readRoot(const std::string& path, const SourceLocation& mention, int depth = 0) {
        checkNesting(path, mention);
        std::string text = readTextFile(path, mention, "scene");
        const TextPositions positions(path, text);
        pugi::xml_document document;
        const pugi::xml_parse_result result = document.load_buffer_inplace(
            text.data(), text.size(), pugi::parse_default | pugi::parse_pi, pugi::encoding_utf8);
        if (!result) throwMalformed(path, mention, positions, result);

        openFiles_.push_back(std::filesystem::weakly_canonical(path).string());
        Element root;
        for (pugi::xml_node node : document.children()) {
            const ptrdiff_t bracket = node.type() == pugi::node_pi ? 2 : 1; // "<?" or "<" before the name
            const SourceLocation where = positions.at(node.offset_debug() - bracket);
            if (node.type() == pugi::node_pi && std::string_view(node.name()) == "quasilux")
                throw InputError(where,
                                 "<?quasilux?> outside of the scene; put it into <scene>, a <bsdf> or a <medium>.");
            if (node.type() != pugi::node_element) continue;
            if (!root.tag.empty()) throw InputError(where, "a second outermost element; a file has one.");
            root = convert(node, nullptr, positions, depth);
        }
        openFiles_.pop_back();
        return root;
    }

    const FileResolver& files() const { return files_; }
    const std::vector<std::string>& forgiven() const { return forgiven_; }

    void checkAllUsed() const {
        for (const Parameter& parameter : parameters_) {
            if (parameter.used || !parameter.given) continue;
            Names known;
            for (const Parameter& other : parameters_)
                if (!other.given || other.used) known.push_back(other.name);
            throw InputError(fmt::format("parameter '{}' is not used by the scene.{}", parameter.name,
                                         knownNames(parameter.name, known)));
        }
    }

private:
    /// pugixml names no tags, and has overwritten the text, so it is read again.
    [[noreturn]] void throwMalformed(const std::string& path, const SourceLocation& mention,
                                     const TextPositions& positions, const pugi::xml_parse_result& result) const {
        const bool isOfTags = result.status == pugi::status_end_element_mismatch;
        const std::string text = isOfTags ? readTextFile(path, mention, "scene") : "";
        const auto mismatch = findTagMismatch(text);
        if (!mismatch)
            throw InputError(positions.at(result.offset), fmt::format("malformed XML: {}.", result.description()));
        const auto& [opened, closed, openedAt, at] = *mismatch;
        const SourceLocation where = positions.at(ptrdiff_t(at));
        if (opened.empty())
            throw InputError(where, fmt::format("malformed XML: </{}> ends nothing; remove it.", closed));
        const int line = positions.at(ptrdiff_t(openedAt)).line;
        if (closed.empty())
            throw InputError(where, fmt::format("malformed XML: the file ends, but <{0}> of line {1} has no end; "
                                                "expected </{0}>.",
                                                opened, line));
        throw InputError(where, fmt::format("malformed XML: </{}> where <{}> of line {} is open; expected </{}> first.",
                                            closed, opened, line, opened));
    }

    void checkNesting(const std::string& path, const SourceLocation& mention) const {
        files_.guard().checkNesting(openFiles_.size() + 1, mention);
        if (openFiles_.size() >= maximumNesting)
            throw InputError(
                mention, fmt::format("more than {} files that include each other; join some of them.", maximumNesting));
        std::error_code ignored; // readFile says what is wrong with the name
        const std::string canonical = std::filesystem::weakly_canonical(path, ignored).string();
        if (std::find(openFiles_.begin(), openFiles_.end(), canonical) != openFiles_.end())
            throw InputError(mention, fmt::format("include loop: '{}' includes itself; remove one <include>.", path));
    }

    Element convert(pugi::xml_node node, const Element* parent, const TextPositions& positions, int depth) {
        Element element;
        element.tag = node.name();
        element.where = positions.at(node.offset_debug() - 1);
        if (depth > maximumNesting) throwNesting(element);
        files_.guard().addElement(element.where);
        for (pugi::xml_attribute attribute : node.attributes())
            element.attributes.push_back({attribute.name(), substitute(attribute.value(), element.where)});
        if (!parent && element.find("version")) version_ = majorVersion(element.get("version"));
        const bool isOld = isOfFormerVersion();
        if (isOld) upgradeNames(element);
        if (element.tag == "spectrum" && element.find("type"))
            element.tag = "texture"; // one kind of plugin, as in Mitsuba
        checkElement(element, parent);
        if (element.tag == "spectrum" && openFiles_.size() > 1) placeSpectrum(element);
        for (pugi::xml_node child : node.children()) convertChild(child, element, positions, depth);
        if (isOld) upgradeParameters(element);
        return element;
    }

    void convertChild(pugi::xml_node child, Element& parent, const TextPositions& positions, int depth) {
        if (child.type() == pugi::node_pi) {
            if (std::string_view(child.name()) != "quasilux") return; // another program's
            const SourceLocation where = positions.at(child.offset_debug() - 2);
            if (parent.tag != "scene" && parent.tag != "bsdf" && parent.tag != "medium")
                throw InputError(where,
                                 fmt::format("<?quasilux?> has no meaning in <{}>; put it into <scene>, a <bsdf> "
                                             "or a <medium>.",
                                             parent.tag));
            parent.instructions.push_back(parseInstruction(child.value(), where));
        } else if (child.type() == pugi::node_pcdata || child.type() == pugi::node_cdata) {
            std::string text = child.value();
            text.erase(0, text.find_first_not_of(" \t\r\n"));
            throw InputError(positions.at(child.offset_debug()),
                             fmt::format("text '{}' in <{}>; {}.", text.substr(0, 40), parent.tag,
                                         text.starts_with('&')
                                             ? "entities of XML are not read, use <include filename=\"…\"/>"
                                             : "values are written as attributes"));
        } else if (child.type() == pugi::node_element) {
            if (leavesOut(child, parent, positions)) return;
            Element element = convert(child, &parent, positions, depth + 1);
            if (element.tag == "default")
                define(element);
            else if (element.tag == "include")
                include(element, parent, depth);
            else if (element.tag == "path")
                folders_.insert(folders_.begin(), files_.prepend(element.get("value"), element.where));
            else if (!plainInstances_.keep(element, parent)) {
                plainInstances_.note(element);
                parent.children.push_back(std::move(element));
            }
        }
    }

    bool isOfFormerVersion() const { return version_ == 0 || version_ == 1; }

    /// Whether the element is unknown, and forgiven.
    bool leavesOut(pugi::xml_node node, const Element& parent, const TextPositions& positions) {
        Element element;
        element.tag = node.name();
        element.where = positions.at(node.offset_debug() - 1);
        const bool isKnown = isKnownTag(element.tag) || (isOfFormerVersion() && isFormerTag(element.tag));
        if (unknown_ == Unknown::refused || isKnown || parent.tag == "transform") return false;
        try {
            tagOf(element);
        } catch (const InputError& error) {
            forgiven_.push_back(fmt::format("{} It is left out.", error.what()));
        }
        return true;
    }

    void define(const Element& element) {
        const std::string& name = element.get("name");
        if (name.empty()) throw InputError(element.where, "<default> needs a name that is not empty.");
        const bool known = std::any_of(parameters_.begin(), parameters_.end(),
                                       [&](const Parameter& parameter) { return parameter.name == name; });
        if (!known) parameters_.push_back({name, element.get("value"), false, false});
    }

    /// Within an included file Mitsuba looks for spectra elsewhere than for what is loaded later; that is here too.
    void placeSpectrum(Element& element) const {
        for (Attribute& attribute : element.attributes)
            if (attribute.name == "filename")
                if (const auto found = findIn(folders_, attribute.value))
                    attribute.value = std::filesystem::absolute(*found).string();
    }

    void include(const Element& element, Element& parent, int depth) {
        const int version = version_; // each file has its own
        const Folders folders = folders_;
        folders_.insert(folders_.begin(), folderOf(element.where.file));
        const std::string path = files_.resolve(element.get("filename"), element.where, folders_);
        Element root = readRoot(path, element.where, depth);
        version_ = version;
        folders_ = folders;
        if (root.tag != "scene") {
            if (const std::string* name = element.find("name")) rename(root, *name);
            checkElement(root, &parent);
            parent.children.push_back(std::move(root));
            return;
        }
        moveInstances(root, parent.children.size(), parent);
        for (Element& child : root.children) {
            checkElement(child, &parent);
            parent.children.push_back(std::move(child));
        }
        for (Instruction& instruction : root.instructions) parent.instructions.push_back(std::move(instruction));
    }

    /// Replaces each `$name`, the longest known name first, as Mitsuba does.
    std::string substitute(std::string text, const SourceLocation& where) {
        size_t position = 0;
        while ((position = text.find('$', position)) != std::string::npos) {
            if (position > 0 && text[position - 1] == '\\') { // stands for itself
                text.erase(position - 1, 1);
                continue;
            }
            Parameter* longest = nullptr;
            for (Parameter& parameter : parameters_)
                if (text.compare(position + 1, parameter.name.size(), parameter.name) == 0 && !parameter.name.empty() &&
                    (!longest || parameter.name.size() > longest->name.size()))
                    longest = &parameter;
            if (!longest) throwUndefined(text.substr(position + 1), where);
            longest->used = true;
            text.replace(position, longest->name.size() + 1, longest->value);
            position += longest->value.size();
            if (text.size() > maximumValue)
                throw InputError(where,
                                 fmt::format("a value grows to more than {} letters by its parameters.", maximumValue));
        }
        return text;
    }

    [[noreturn]] void throwUndefined(const std::string& name, const SourceLocation& where) const {
        Names known;
        for (const Parameter& parameter : parameters_) known.push_back(parameter.name);
        throw InputError(where, fmt::format("parameter '${}' has no value; write <default name=\"{}\" value=\"…\"/> "
                                            "before it, or give it as an option.{}",
                                            name, name, knownNames(name, known)));
    }

    std::vector<Parameter> parameters_;
    std::vector<std::string> openFiles_;
    FileResolver files_;
    /// Where Mitsuba looks for includes and spectra: the folders of the <path>s of the file that is being read, the
    /// last one first, that of the file which includes it, the <path>s of that one …
    Folders folders_;
    Unknown unknown_;
    std::vector<std::string> forgiven_;
    PlainInstanceReader plainInstances_;
    int version_ = 3; ///< the first number of that of the file that is being read
};

} // namespace

SceneDocument readSceneDocument(const std::string& path, const SceneParameters& parameters, Unknown unknown,
                                std::shared_ptr<LoadGuard> guard) {
    DocumentReader reader(path, parameters, unknown, std::move(guard));
    reader.files().guard().admit(path, {path});
    Element root = reader.readRoot(path, {});
    if (root.tag != "scene")
        throw InputError(root.where, fmt::format("the outermost element is <{}>; expected <scene>.", root.tag));
    reader.checkAllUsed();
    return {std::move(root), reader.files(), reader.forgiven()};
}

Instruction parseInstruction(std::string_view text, const SourceLocation& where) {
    Instruction instruction{{}, where};
    const auto malformed = [&]() {
        return InputError(where, fmt::format("<?quasilux {}?>: expected a list of key=\"value\".", text));
    };
    constexpr std::string_view blanks = " \t\r\n";
    size_t position = std::min(text.find_first_not_of(blanks), text.size());
    const size_t wordEnd = std::min(text.find_first_of(blanks, position), text.size());
    const std::string_view word = text.substr(position, wordEnd - position);
    if (!word.empty() && word.find_first_of("=\"'") == std::string_view::npos) {
        instruction.kind = word;
        position = wordEnd;
    }
    std::set<std::string_view> keys;
    while ((position = text.find_first_not_of(blanks, position)) != std::string_view::npos) {
        const size_t equals = text.find('=', position);
        if (equals == std::string_view::npos || equals == position || equals + 1 >= text.size()) throw malformed();
        const std::string_view key = text.substr(position, equals - position);
        const char quote = text[equals + 1];
        if ((quote != '"' && quote != '\'') || key.find_first_of(" \t\r\n\"'") != std::string_view::npos)
            throw malformed();
        const size_t end = text.find(quote, equals + 2);
        if (end == std::string_view::npos) throw malformed();
        if (!keys.insert(key).second)
            throw InputError(where, fmt::format("<?quasilux?> has '{}' twice; keep one.", key));
        instruction.entries.push_back({std::string(key), std::string(text.substr(equals + 2, end - equals - 2))});
        position = end + 1;
        if (position < text.size() && blanks.find(text[position]) == std::string_view::npos) throw malformed();
    }
    return instruction;
}

std::string readFile(const std::string& path, const SourceLocation& where, std::string_view what) {
    noteReadFile(path);
    const std::string checkName =
        fmt::format("Check the name; it is relative to the {}.",
                    where.file.empty() ? "current folder" : "folder of the file that mentions it");
    const auto fail = [&](const std::string& why, const std::string& advice) {
        throw InputError(where, fmt::format("cannot read the {} file '{}': {}. {}", what, path, why, advice));
    };
    using std::filesystem::file_type;
    std::error_code error;
    const auto kind = std::filesystem::status(path, error).type();
    if (kind == file_type::directory) fail("it is a folder", fmt::format("Name the {} file in it.", what));
    if (kind == file_type::not_found || error) fail("there is no such file", checkName);
    // A pipe or a device may have no end.
    if (kind != file_type::regular) fail("it is no plain file", checkName);
    std::ifstream file(path, std::ios::binary);
    if (!file) fail(std::generic_category().message(errno), "Give yourself the right to read it.");
    std::string content(std::filesystem::file_size(path, error), 0);
    if (error) fail(error.message(), checkName);
    file.read(content.data(), static_cast<std::streamsize>(content.size()));
    if (file.bad() || static_cast<size_t>(file.gcount()) != content.size())
        fail(fmt::format("only {} of its {} bytes could be read", file.gcount(), content.size()),
             "Check the disk, or copy it anew.");
    return content;
}

std::string readTextFile(const std::string& path, const SourceLocation& where, std::string_view what) {
    std::string text = readFile(path, where, what);
    if (text.starts_with("\xef\xbb\xbf")) text.erase(0, 3);
    return text;
}

} // namespace quasilux

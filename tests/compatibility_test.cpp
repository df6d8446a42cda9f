// docs/reference/compatibility.md is what the loader says to each plugin and parameter of Mitsuba 3.9
// (tests/data/mitsuba_plugins.txt). With QUASILUX_WRITE_COMPATIBILITY set, the page is written instead: bash
// scripts/compatibility.sh.
#include "scene/scene.h"
#include "support/scene_files.h"

#include <cstdlib>
#include <fstream>
#include <map>
#include <regex>
#include <sstream>

namespace quasilux {
namespace {

struct Parameter {
    std::string name, given; ///< as XML
};
struct Plugin {
    std::string kind, name, needed;
    std::vector<Parameter> parameters;
};

std::string textOf(const std::string& path) {
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<Plugin> pluginsOf(const std::string& text) {
    std::vector<Plugin> plugins;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        if (line.empty() || line[0] == '#') continue;
        if (line[0] == '@') {
            Plugin& plugin = plugins.emplace_back();
            std::istringstream(line.substr(1)) >> plugin.kind >> plugin.name;
        } else if (line[0] == '=')
            plugins.back().needed = line.substr(2);
        else {
            const size_t xml = line.find('<');
            plugins.back().parameters.push_back({line.substr(0, xml - 1), line.substr(xml)});
        }
    }
    return plugins;
}

constexpr const char* supported = "supported";
constexpr const char* withoutEffect = "accepted without effect";
const std::string withWarning = "accepted with a warning: ", refused = "refused: ";

const std::string film = R"(<film type="hdrfilm"><rfilter type="box"/></film>)";

/// The objects of a scene that has `element`, a plugin of this kind, in a place where it belongs. Lines of its own:
/// `element` is line 3.
std::string sceneAround(const Plugin& plugin, const std::string& element) {
    const std::string camera = "<sensor type=\"perspective\">" + film + "</sensor>",
                      light = "<emitter type=\"point\"/>";
    const auto shape = [&](const std::string& content) {
        return camera + light + "<shape type=\"sphere\">\n" + content + "\n</shape>";
    };
    const auto sensor = [&](const std::string& content) {
        return light + "<sensor type=\"perspective\">\n" + content + "\n</sensor>";
    };
    const auto inMedium = [&](const std::string& medium) {
        return shape("<bsdf type=\"null\"/><medium name=\"interior\" " + medium + "</medium>");
    };
    if (plugin.kind == "bsdf") return shape(element);
    if (plugin.name == "mesh_attribute")
        return camera + light +
               "<shape type=\"ply\"><string name=\"filename\" value=\"colors.ply\"/>\n<bsdf type=\"diffuse\">" +
               element + "</bsdf></shape>";
    if (plugin.name == "blackbody")
        return camera + "<shape type=\"rectangle\">\n<emitter type=\"area\">" + element + "</emitter></shape>";
    if (plugin.kind == "texture") return shape("<bsdf type=\"diffuse\">" + element + "</bsdf>");
    if (plugin.kind == "medium") return shape("<bsdf type=\"null\"/>" + element);
    if (plugin.kind == "phase") return inMedium("type=\"homogeneous\">" + element);
    if (plugin.kind == "volume") return inMedium("type=\"heterogeneous\">" + element);
    if (plugin.kind == "film" || plugin.kind == "sampler") return sensor(element);
    if (plugin.kind == "rfilter") return sensor("<film type=\"hdrfilm\">" + element + "</film>");
    if (plugin.kind == "sensor")
        return plugin.name == "irradiancemeter" ? light + "<shape type=\"sphere\">\n" + element + "\n</shape>"
                                                : light + "\n" + element;
    if (plugin.kind == "emitter" && (plugin.name == "area" || plugin.name == "directionalarea"))
        return camera + "<shape type=\"rectangle\">\n" + element + "\n</shape>";
    if (plugin.kind == "emitter") return camera + "\n" + element;
    return camera + light + "\n" + element;
}

std::string elementOf(const Plugin& plugin, const std::string& given) {
    static const std::map<std::string, std::string> names{
        {"texture", "reflectance"}, {"medium", "interior"}, {"volume", "sigma_t"}};
    const auto found = names.find(plugin.kind);
    std::string name = found == names.end() ? "" : found->second;
    if (plugin.name == "blackbody") name = "radiance"; // as a reflectance it is far above 1
    return "<" + plugin.kind + " type=\"" + plugin.name + "\"" + (name.empty() ? "" : " name=\"" + name + "\"") + ">" +
           plugin.needed + given + "</" + plugin.kind + ">";
}

class Compatibility : public testing::Test {
protected:
    Compatibility() {
        const std::string data = QUASILUX_SOURCE_DIR "/tests/data/";
        for (const char* name : {"quads.obj", "tetrahedron.ply", "triangle.serialized"})
            files_.write(name, textOf(data + name));
        files_.write("colors.ply", textOf(QUASILUX_SOURCE_DIR "/tests/scenes/compare/colors.ply"));
        files_.write("checker.ppm", std::string("P6\n2 2\n255\n") + std::string("\x10\x20\x30\x80\x80\x80\x80\x80\x80"
                                                                                "\x10\x20\x30",
                                                                                12));
        files_.write("curve.txt", "0 0 0 0.1\n0 0 1 0.1\n0 0 2 0.1\n0 1 3 0.1\n");
        files_.write("grid.vol", volume());
    }

    /// What the page says of it; warnings that are among `known` do not count.
    std::string outcome(const Plugin& plugin, const std::string& given, const std::string& known = "") const {
        const std::string path =
            files_.write("scene.xml", "<scene version=\"3.0.0\">\n" + sceneAround(plugin, elementOf(plugin, given)) +
                                          "\n</scene>\n");
        try {
            const Scene scene = loadScene(path);
            if (!scene.withoutEffect.empty()) return withoutEffect;
            for (const std::string& warning : scene.warnings) {
                const std::string text = withWarning + plain(warning);
                if (warning.find("is used by no") == std::string::npos &&
                    warning.find("a further <sensor>") == std::string::npos && text != known)
                    return text;
            }
            return supported;
        } catch (const InputError& error) {
            std::string message = error.what();
            EXPECT_EQ(message.find("no such file"), std::string::npos) << message;
            return refused + plain(message);
        }
    }

    std::string page() const;

private:
    /// Mitsuba's format: "VOL", version 3, float32, 2 x 2 x 2, one channel, box, values.
    static std::string volume() {
        std::string text("VOL\3", 4);
        const auto add = [&](auto value) { text.append(reinterpret_cast<const char*>(&value), sizeof value); };
        for (const int32_t value : {1, 2, 2, 2, 1}) add(value);
        for (const float value : {0.f, 0.f, 0.f, 1.f, 1.f, 1.f}) add(value);
        for (int k = 0; k < 8; ++k) add(0.1f * static_cast<float>(k));
        return text;
    }

    /// Without places, lists of names, and folders.
    std::string plain(std::string message) const {
        message = std::regex_replace(message, std::regex(R"(^[^ ]*scene\.xml:\d+:\d+: )"), "");
        message = std::regex_replace(
            message, std::regex(R"( (Did you mean|Known:|Objects that it takes|Parameters of it).*)"), "");
        const std::string folder = files_.path("");
        for (size_t at; (at = message.find(folder)) != std::string::npos;) message.erase(at, folder.size());
        for (char& letter : message)
            if (letter == '\n' || letter == '|') letter = ' ';
        return message;
    }

    test::SceneFiles files_;
};

std::string Compatibility::page() const {
    std::ostringstream page;
    page << "# Compatibility with Mitsuba 3.9\n\n"
            "Each plugin of Mitsuba 3.9 and each of its parameters, and what quasilux does with it. This page is made "
            "by trying each one\n"
            "in the loader (`bash scripts/compatibility.sh`), and a test holds it against the loader. What the "
            "parameters mean is in\n"
            "[scene-language.md](scene-language.md). A parameter that may be a texture too has a line of its own for "
            "that.\n";
    std::string kind;
    for (const Plugin& plugin : pluginsOf(textOf(QUASILUX_SOURCE_DIR "/tests/data/mitsuba_plugins.txt"))) {
        if (plugin.kind != kind) {
            kind = plugin.kind;
            page << "\n## " << kind << "\n\n| plugin | parameter | |\n|---|---|---|\n";
        }
        const std::string itself = outcome(plugin, "");
        page << "| **`" << plugin.name << "`** | | " << itself << " |\n";
        if (itself.starts_with(refused)) continue;
        for (const Parameter& parameter : plugin.parameters)
            page << "| | `" << parameter.name << "` | " << outcome(plugin, parameter.given, itself) << " |\n";
    }
    return page.str();
}

TEST_F(Compatibility, ThePageIsWhatTheLoaderSays) {
    const std::string path = QUASILUX_SOURCE_DIR "/docs/reference/compatibility.md", now = page();
    if (std::getenv("QUASILUX_WRITE_COMPATIBILITY")) {
        std::ofstream(path) << now;
        return;
    }
    EXPECT_EQ(textOf(path), now) << "out of date: bash scripts/compatibility.sh makes it anew";
}

TEST_F(Compatibility, ProbesTellSupportedFromAcceptedAndRefused) {
    const Plugin path{"integrator", "path", "", {}};
    EXPECT_EQ(outcome(path, R"(<integer name="max_depth" value="4"/>)"), supported);
    EXPECT_EQ(outcome(path, R"(<integer name="rr_depth" value="4"/>)"), withoutEffect);
    EXPECT_EQ(outcome(path, R"(<integer name="no_such_depth" value="4"/>)").rfind(refused, 0), 0u);
    const Plugin unknown{"bsdf", "no_such_bsdf", "", {}};
    EXPECT_EQ(outcome(unknown, "").substr(0, 43), "refused: unknown bsdf plugin 'no_such_bsdf'");
    const Plugin moment{"integrator", "moment", "", {}};
    const std::string warned = outcome(moment, "");
    EXPECT_EQ(warned.rfind(withWarning, 0), 0u);
    EXPECT_EQ(outcome(moment, R"(<boolean name="hide_emitters" value="true"/>)", warned), withoutEffect)
        << "the nested integrator goes by its own";
}

} // namespace
} // namespace quasilux

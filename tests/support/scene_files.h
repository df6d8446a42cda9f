// Scene and mesh files for the loader's tests, in a folder that is removed again.
#pragma once

#include "scene/scene.h"

#include <filesystem>
#include <fstream>
#include <functional>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>
#include <unistd.h>

namespace quasilux::test {

class SceneFiles {
public:
    SceneFiles() {
        const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
        std::string name = std::string(info->test_suite_name()) + "_" + info->name() + "_" + std::to_string(getpid());
        for (char& letter : name)
            if (letter == '/') letter = '_';
        folder_ = std::filesystem::temp_directory_path() / ("quasilux_" + name);
        std::filesystem::create_directories(folder_);
    }
    ~SceneFiles() {
        std::error_code ignored;
        std::filesystem::remove_all(folder_, ignored);
    }
    SceneFiles(const SceneFiles&) = delete;
    SceneFiles& operator=(const SceneFiles&) = delete;

    /// Path of the file written.
    std::string write(const std::string& name, const std::string& content) const {
        std::ofstream(folder_ / name, std::ios::binary) << content;
        return path(name);
    }
    std::string path(const std::string& name) const { return (folder_ / name).string(); }

private:
    std::filesystem::path folder_;
};

/// Loads `file` and returns the message of the InputError, or fails.
inline std::string errorOf(const std::string& file,
                           const std::vector<std::pair<std::string, std::string>>& parameters = {}) {
    try {
        loadScene(file, parameters);
    } catch (const InputError& error) {
        return error.what();
    }
    ADD_FAILURE() << "loaded without an error";
    return {};
}

inline const char* const minimalSensor = "<sensor type=\"perspective\"/>\n";
inline const char* const minimalLight = "<emitter type=\"point\"/>\n";

/// A complete scene; `body` starts in column 1 of line 4.
inline std::string sceneWith(const std::string& body) {
    return std::string("<scene version=\"3.0.0\">\n") + minimalSensor + minimalLight + body + "\n</scene>\n";
}

/// Each body, or what `wrap` makes of it, makes a scene that is refused, with a message that has all these parts.
template <typename Cases, typename Wrap = std::identity>
void expectErrors(const SceneFiles& files, const Cases& cases, const Wrap& wrap = {}) {
    for (const auto& [body, messages] : cases) {
        const std::string error = errorOf(files.write("scene.xml", sceneWith(wrap(body))));
        for (const auto& message : messages) EXPECT_THAT(error, ::testing::HasSubstr(message)) << body;
    }
}

/// A complete scene, loaded.
inline Scene loadBody(const std::string& body) {
    SceneFiles files;
    return loadScene(files.write("scene.xml", sceneWith(body)));
}

/// Of a perspective sensor with this content.
inline Sensor loadSensor(const std::string& content) {
    SceneFiles files;
    return loadScene(files.write("scene.xml", "<scene version=\"3.0.0\"><sensor type=\"perspective\">" + content +
                                                  "</sensor><emitter type=\"point\"/></scene>"))
        .sensor;
}
inline ShapeDescription loadShape(const std::string& shape) { return loadBody(shape).shapes.at(0); }

/// A shape under a transform.
inline std::string placed(const std::string& type, const std::string& operations, const std::string& parameters = "") {
    return "<shape type=\"" + type + "\">" + parameters + "<transform name=\"to_world\">" + operations +
           "</transform></shape>";
}

inline void expectNear(const glm::vec3& value, const glm::vec3& expected, float tolerance = 1e-6f) {
    EXPECT_NEAR(value.x, expected.x, tolerance);
    EXPECT_NEAR(value.y, expected.y, tolerance);
    EXPECT_NEAR(value.z, expected.z, tolerance);
}

} // namespace quasilux::test

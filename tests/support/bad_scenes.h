// Scenes with one mistake in their body, and what is to be said of it.
#pragma once

#include "support/scene_files.h"

#include <gmock/gmock.h>
#include <ostream>
#include <string>
#include <vector>

namespace quasilux::test {

struct BadBody {
    const char* name;
    const char* body;                  ///< starts at line 4, column 1 of scene.xml
    std::vector<const char*> expected; ///< parts of the message
};
inline void PrintTo(const BadBody& bad, std::ostream* out) { *out << bad.body; }

/// The message is expected to have all parts.
inline void expectRefused(const BadBody& bad) {
    SceneFiles files;
    const std::string message = errorOf(files.write("scene.xml", sceneWith(bad.body)));
    for (const char* part : bad.expected) EXPECT_THAT(message, testing::HasSubstr(part));
}

} // namespace quasilux::test

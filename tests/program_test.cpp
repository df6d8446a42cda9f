// Programs of several kernel files: errors name the file and the line that a reader sees. Nothing is left to chance.
#include "support/test_kernels.h"

#include "util/error.h"

#include <gmock/gmock.h>

namespace quasilux {
namespace {

using Sources = std::map<std::string, std::string>;

std::string errorOf(const std::string& text) {
    const Sources sources = {{"main.cl", text}, {"header.clh", "\n\n\nfloat unused(float x);\n"}};
    try {
        Program(testDevice(), "main.cl", "", sources);
    } catch (const DeviceError& error) {
        return error.what();
    }
    return "no error";
}

TEST(Program, ErrorsNameTheLineOfTheirFile) {
    EXPECT_THAT(errorOf("#include \"header.clh\"\n\n__kernel void k() { wrong; }\n"), testing::HasSubstr("main.cl:3:"));
    EXPECT_THAT(errorOf("#ifdef NEVER\n#include \"header.clh\"\n#endif\n__kernel void k() { wrong; }\n"),
                testing::HasSubstr("main.cl:4:"))
        << "after a file that is left out";
    EXPECT_THAT(errorOf("#ifndef NEVER\n\n#else\n#include \"header.clh\"\n#endif\n\n__kernel void k() { wrong; }\n"),
                testing::HasSubstr("main.cl:7:"));
    EXPECT_EQ(errorOf("#include \"header.clh\"\n__kernel void k() {}\n"), "no error") << "control";
}

} // namespace
} // namespace quasilux

// `quasilux doctor` on this computer, and on one whose runtimes, cache or temporary folder are broken.
#include "support/program_runner.h"

#include <cstdlib>
#include <fstream>
#include <gmock/gmock.h>
#include <map>
#include <nlohmann/json.hpp>

namespace quasilux {
namespace {

using testing::HasSubstr;

class DoctorTest : public CommandLineTest {
protected:
    ~DoctorTest() override {
        for (const auto& entry : variables_) unsetenv(entry.c_str());
    }
    void setVariable(const std::string& name, const std::string& value) {
        variables_.push_back(name);
        setenv(name.c_str(), value.c_str(), 1);
    }
    std::string write(const std::string& name, const std::string& text) const {
        std::ofstream(folder / name) << text;
        return (folder / name).string();
    }
    /// State, what is found and advice by what was looked at.
    std::map<std::string, nlohmann::json> findings(int exitCode) const {
        const Outcome outcome = run({"doctor", "--json"});
        EXPECT_EQ(outcome.exitCode, exitCode) << outcome.output << outcome.errors;
        std::map<std::string, nlohmann::json> found;
        for (const auto& row : nlohmann::json::parse(outcome.output)) found[row.at("what")] = row;
        return found;
    }

private:
    std::vector<std::string> variables_;
};

TEST_F(DoctorTest, NothingIsWrongHere) {
    const Outcome outcome = run({"doctor"});
    EXPECT_EQ(outcome.exitCode, 0) << outcome.output;
    EXPECT_THAT(outcome.output, HasSubstr("ok       device 0, "));
    EXPECT_THAT(outcome.output, HasSubstr("a small kernel was compiled and run"));
    EXPECT_THAT(outcome.output, HasSubstr("ok       Embree: 3."));
    EXPECT_THAT(outcome.output, HasSubstr("ok       OpenImageIO: "));
    EXPECT_THAT(outcome.output, HasSubstr("0 problems"));
    EXPECT_THAT(outcome.errors, "");
}

TEST_F(DoctorTest, NoRuntime) {
    setVariable("OCL_ICD_VENDORS", folder.string());
    const auto found = findings(1);
    EXPECT_EQ(found.at("OpenCL runtimes").at("state"), "problem");
    EXPECT_THAT(std::string(found.at("OpenCL runtimes").at("advice")), HasSubstr("OCL_ICD_VENDORS"));
    EXPECT_THAT(std::string(found.at("OpenCL devices").at("advice")), HasSubstr("pocl-opencl-icd"));
}

TEST_F(DoctorTest, RuntimeWhoseLibraryIsGone) {
    const std::string file = write("gone.icd", "libnowhere.so.7\n");
    setVariable("OCL_ICD_VENDORS", folder.string());
    const auto found = findings(1);
    const auto& runtime = found.at("OpenCL runtime " + file);
    EXPECT_EQ(runtime.at("state"), "problem");
    EXPECT_THAT(std::string(runtime.at("found")), HasSubstr("libnowhere.so.7"));
}

TEST_F(DoctorTest, CacheThatCannotBeWritten) {
    setVariable("POCL_CACHE_DIR", write("file", "no folder") + "/cache");
    const auto found = findings(1);
    EXPECT_EQ(found.at("kernels compiled by PoCL").at("state"), "problem");
    EXPECT_THAT(std::string(found.at("kernels compiled by PoCL").at("advice")), HasSubstr("POCL_CACHE_DIR"));
    EXPECT_THAT(std::string(found.at("OpenCL devices").at("advice")), HasSubstr("what else is wrong"));
}

TEST_F(DoctorTest, TemporaryFolderThatIsNotThere) {
    setVariable("TMPDIR", (folder / "nowhere").string());
    const auto found = findings(1);
    EXPECT_EQ(found.at("temporary folder").at("state"), "problem");
    EXPECT_THAT(std::string(found.at("temporary folder").at("advice")), HasSubstr("TMPDIR"));
}

} // namespace
} // namespace quasilux

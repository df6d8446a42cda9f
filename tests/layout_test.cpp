// Size of every struct that host and device share, offset and size of each of its fields: the same on both sides.
#include "device/kernel_sources.h"
#include "pass_types.h"
#include "support/test_kernels.h"

#include <cstddef>
#include <fstream>
#include <gtest/gtest.h>
#include <regex>
#include <set>
#include <sstream>

namespace quasilux {
namespace {

struct Row {
    std::string name;
    std::vector<unsigned> values; ///< struct: size; field: offset, size
};

} // namespace

namespace shared {
namespace {

// Within shared, whose names others of the host have too.
std::vector<Row> hostLayout() {
    return {
#define STRUCT(type) {#type, {unsigned(sizeof(type))}},
#define FIELD(type, field) {#type "." #field, {unsigned(offsetof(type, field)), unsigned(sizeof(type::field))}},
#include "kernels/layout_fields.h"
#undef STRUCT
#undef FIELD
    };
}

} // namespace
} // namespace shared

namespace {

std::string readTestKernel(const std::string& file) {
    std::ifstream stream(std::string(QUASILUX_SOURCE_DIR) + "/tests/kernels/" + file);
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
}

/// Reads the device's layout; `replaced` changes kernel files first.
std::vector<unsigned> deviceLayout(size_t count, std::map<std::string, std::string> replaced = {}) {
    for (const char* file :
         {"layout.cl", "layout_fields.h", "layout_sensor_fields.h", "layout_learned_fields.h", "layout_pass_fields.h"})
        replaced[file] = readTestKernel(file);
    Program program(testDevice(), "layout.cl", "", replaced);
    Buffer<char> memory(testDevice(), 1 << 16, "memory");
    Buffer<unsigned> sizes(testDevice(), count, "sizes");
    program.kernel("layout").launch(1, memory, sizes);
    return sizes.read();
}

std::vector<unsigned> flat(const std::vector<Row>& rows) {
    std::vector<unsigned> values;
    for (const Row& row : rows) values.insert(values.end(), row.values.begin(), row.values.end());
    return values;
}

/// "Struct" and "Struct.field" of every typedef in a header.
std::set<std::string> declared(const std::string& header) {
    const std::string text = std::regex_replace(kernelSources().at(header), std::regex(R"(/\*[^]*?\*/)"), "");
    const std::regex structure(R"(typedef struct \{([^}]*)\}\s*(\w+);)"), field(R"((\w+)(\[[^\]]*\])?\s*[,;])");
    std::set<std::string> names;
    for (std::sregex_iterator s(text.begin(), text.end(), structure), end; s != end; ++s) {
        const std::string body = (*s)[1], name = (*s)[2];
        names.insert(name);
        for (std::sregex_iterator f(body.begin(), body.end(), field); f != end; ++f)
            names.insert(name + "." + (*f)[1].str());
    }
    return names;
}

TEST(Layout, EveryFieldLiesWhereTheHostHasIt) {
    const std::vector<Row> rows = shared::hostLayout();
    const std::vector<unsigned> device = deviceLayout(flat(rows).size());
    size_t next = 0;
    for (const Row& row : rows)
        for (unsigned value : row.values) EXPECT_EQ(device[next++], value) << row.name;
}

TEST(Layout, EveryDeclaredFieldIsCompared) {
    std::set<std::string> compared;
    for (const Row& row : shared::hostLayout()) compared.insert(row.name);
    std::set<std::string> names = declared("shared_types.h");
    names.merge(declared("learned_types.h"));
    names.merge(declared("sensor_types.h"));
    names.merge(declared("pass_types.h"));
    EXPECT_GT(names.size(), 100u);
    EXPECT_EQ(compared, names) << "tests/kernels/layout_*fields.h and the headers of kernels/ differ";
}

TEST(Layout, NodesAndBlocksAreAsDocumented) {
    EXPECT_EQ(sizeof(shared::BvhNode), 224u);
    EXPECT_EQ(sizeof(shared::PrimitiveBlock), 320u);
}

TEST(Layout, AMovedFieldIsFound) {
    std::string header = kernelSources().at("shared_types.h");
    const std::string from = "float radius;";
    const size_t place = header.find(from);
    ASSERT_NE(place, std::string::npos);
    header.replace(place, from.size(), "ulong radius;"); // aligned to 8
    const std::vector<unsigned> host = flat(shared::hostLayout());
    EXPECT_NE(deviceLayout(host.size(), {{"shared_types.h", header}}), host);
}

} // namespace
} // namespace quasilux

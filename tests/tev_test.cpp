// --tev: what arrives at a small server that reads tev's packets, and renders whose tev is not there or goes away.
#include "view/tev_client.h"

#include "support/program_runner.h"

#include <OpenImageIO/imageio.h>
#include <arpa/inet.h>
#include <cstring>
#include <gmock/gmock.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <thread>
#include <unistd.h>

namespace quasilux {
namespace {

using testing::HasSubstr;

/// Reads values as tev does: little-endian, texts up to a zero. Fails the test beyond the end.
class PacketReader {
public:
    explicit PacketReader(std::string bytes) : bytes_(std::move(bytes)) {}
    template <typename T>
    T number() {
        T value{};
        if (at_ + sizeof value > bytes_.size()) throw std::runtime_error("packet ends too soon");
        std::memcpy(&value, bytes_.data() + at_, sizeof value);
        at_ += sizeof value;
        return value;
    }
    std::string text() {
        const size_t end = bytes_.find('\0', at_);
        if (end == std::string::npos) throw std::runtime_error("text without end");
        const std::string value = bytes_.substr(at_, end - at_);
        at_ = end + 1;
        return value;
    }
    size_t left() const { return bytes_.size() - at_; }
    float value(size_t index) const {
        float value{};
        if (at_ + (index + 1) * sizeof value > bytes_.size()) throw std::runtime_error("too few values");
        std::memcpy(&value, bytes_.data() + at_ + index * sizeof value, sizeof value);
        return value;
    }

private:
    std::string bytes_;
    size_t at_ = 0;
};

/// A picture as packets make it.
struct Received {
    std::string name;
    int width = 0, height = 0, created = 0, updates = 0;
    std::vector<std::string> channels;
    std::vector<float> pixels; ///< channels side by side

    void take(const std::string& packet) {
        PacketReader reader(packet);
        ASSERT_EQ(reader.number<uint32_t>(), packet.size());
        const int type = reader.number<int8_t>();
        EXPECT_EQ(reader.number<int8_t>(), 0) << "grabs the focus";
        if (type == 4)
            create(reader);
        else if (type == 6)
            update(reader);
        else
            FAIL() << "packet of type " << type;
    }

private:
    void create(PacketReader& reader) {
        ++created;
        name = reader.text();
        width = reader.number<int32_t>();
        height = reader.number<int32_t>();
        channels.resize(static_cast<size_t>(reader.number<int32_t>()));
        for (auto& channel : channels) channel = reader.text();
        EXPECT_EQ(reader.left(), 0u);
        pixels.assign(static_cast<size_t>(width) * static_cast<size_t>(height) * channels.size(), -1);
    }
    void update(PacketReader& reader) {
        ++updates;
        EXPECT_EQ(reader.text(), name);
        const auto count = static_cast<size_t>(reader.number<int32_t>());
        ASSERT_EQ(count, channels.size());
        for (const auto& channel : channels) EXPECT_EQ(reader.text(), channel);
        const int x = reader.number<int32_t>(), y = reader.number<int32_t>(), columns = reader.number<int32_t>(),
                  rows = reader.number<int32_t>();
        ASSERT_TRUE(x == 0 && columns == width && y >= 0 && rows > 0 && y + rows <= height);
        std::vector<int64_t> offsets, strides;
        for (size_t c = 0; c < count; ++c) offsets.push_back(reader.number<int64_t>());
        for (size_t c = 0; c < count; ++c) strides.push_back(reader.number<int64_t>());
        const auto first = static_cast<size_t>(y * width), n = static_cast<size_t>(rows * width);
        for (size_t c = 0; c < count; ++c)
            for (size_t k = 0; k < n; ++k)
                pixels.at((first + k) * count + c) =
                    reader.value(static_cast<size_t>(offsets[c] + static_cast<int64_t>(k) * strides[c]));
        EXPECT_EQ(reader.left(), n * count * sizeof(float));
    }
};

/// Takes one connection, and packets from it until it ends, or only `most`.
class TevServer {
public:
    explicit TevServer(int most = 1 << 30) {
        listener_ = socket(AF_INET, SOCK_STREAM, 0);
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        socklen_t size = sizeof address;
        if (bind(listener_, reinterpret_cast<sockaddr*>(&address), size) != 0 || listen(listener_, 1) != 0 ||
            getsockname(listener_, reinterpret_cast<sockaddr*>(&address), &size) != 0)
            throw std::runtime_error("no port");
        port_ = ntohs(address.sin_port);
        thread_ = std::thread([this, most] { serve(most); });
    }
    ~TevServer() { finish(); }
    std::string address() const { return "127.0.0.1:" + std::to_string(port_); }
    const Received& finish() {
        shutdown(listener_, SHUT_RDWR);
        if (thread_.joinable()) thread_.join();
        return received_;
    }

private:
    void serve(int most) {
        const int connection = accept(listener_, nullptr, nullptr);
        for (int packets = 0; connection >= 0 && packets < most; ++packets) {
            std::string packet(sizeof(uint32_t), '\0');
            if (!fill(connection, packet, 0)) break;
            uint32_t size = 0;
            std::memcpy(&size, packet.data(), sizeof size);
            packet.resize(size);
            if (!fill(connection, packet, sizeof size)) break;
            received_.take(packet);
        }
        if (connection >= 0) close(connection);
        close(listener_);
    }
    static bool fill(int connection, std::string& bytes, size_t from) {
        while (from < bytes.size()) {
            const ssize_t count = recv(connection, bytes.data() + from, bytes.size() - from, 0);
            if (count <= 0) return false;
            from += static_cast<size_t>(count);
        }
        return true;
    }

    int listener_ = -1, port_ = 0;
    Received received_;
    std::thread thread_;
};

TEST(TevPackets, AreAsTheProtocolHasThem) {
    const std::string packet = tev::createImage("ab", 3, 2);
    const std::string expected("\x1b\0\0\0"
                               "\4\0"
                               "ab\0"
                               "\3\0\0\0\2\0\0\0\3\0\0\0"
                               "R\0G\0B\0",
                               27);
    EXPECT_EQ(packet, expected);
    Received received;
    received.take(packet);
    const std::vector<float> values{1, 2, 3, 4, 5, 6, 7, 8, 9};
    received.take(tev::updateImage("ab", 1, 3, 1, values.data()));
    EXPECT_EQ(std::vector<float>(received.pixels.begin() + 9, received.pixels.end()), values);
    EXPECT_EQ(received.pixels[8], -1);
}

class TevTest : public CommandLineTest {
protected:
    Outcome render(const std::string& tev, const std::string& seconds) const {
        return run({"render", "--tev", tev, "scene.xml", "--fixed", "--time", seconds, "-o", "a.exr"});
    }
};

TEST_F(TevTest, HasTheImageInTheEndAndOlderOnesBefore) {
    TevServer server;
    const Outcome outcome = render(server.address(), "2");
    EXPECT_EQ(outcome.exitCode, 0) << outcome.errors;
    EXPECT_EQ(outcome.errors, "");
    const Received& received = server.finish();
    EXPECT_EQ(received.name, "a.exr");
    EXPECT_EQ(received.created, 1);
    EXPECT_GE(received.updates, 2);
    EXPECT_THAT(received.channels, testing::ElementsAre("R", "G", "B"));
    const auto image = OIIO::ImageInput::open((folder / "a.exr").string());
    ASSERT_TRUE(image);
    std::vector<float> pixels(received.pixels.size());
    ASSERT_TRUE(image->read_image(0, 0, 0, 3, OIIO::TypeDesc::FLOAT, pixels.data()));
    for (size_t k = 0; k < pixels.size(); ++k) EXPECT_FLOAT_EQ(received.pixels[k], pixels[k]) << k;
}

TEST_F(TevTest, ThatIsNotThereIsAWarning) {
    std::string nobody;
    {
        TevServer server;
        nobody = server.address();
    }
    const Outcome outcome = render(nobody, "0.1");
    EXPECT_EQ(outcome.exitCode, 0);
    EXPECT_THAT(outcome.errors, HasSubstr("warning: no tev at " + nobody + " (Connection refused)"));
    EXPECT_TRUE(std::filesystem::exists(folder / "a.exr"));
    EXPECT_EQ(run({"render", "scene.xml", "--tev", nobody, "--strict"}).exitCode, 2);
    expectRefused({"render", "scene.xml", "--tev=here"}, "'here' given, expected HOST:PORT");
}

TEST_F(TevTest, ThatGoesAwayIsAWarning) {
    TevServer server(2);
    const Outcome outcome = render(server.address(), "2.5");
    EXPECT_EQ(outcome.exitCode, 0);
    EXPECT_THAT(outcome.errors, HasSubstr("warning: tev at " + server.address() + " has gone"));
}

// The pictures take memory of the device, which may have none left: the render goes on without them.
TEST_F(TevTest, PicturesThatCannotBeMadeAreAWarning) {
    TevServer server;
    const Outcome outcome = runWith(QUASILUX_FAILING_OPENCL,
                                    {"render", "--tev", server.address(), "scene.xml", "--fixed", "--passes", "20",
                                     "--photons", "256", "-o", "a.exr"},
                                    {{"QUASILUX_FAIL_CALL", "clEnqueueNDRangeKernel"},
                                     {"QUASILUX_FAIL_KERNEL", "cutFilm"},
                                     {"QUASILUX_FAIL_AT", "1"}});
    EXPECT_EQ(outcome.exitCode, 0);
    EXPECT_THAT(outcome.errors,
                HasSubstr("warning: tev at " + server.address() + " gets no more pictures (kernel cutFilm"));
    EXPECT_THAT(outcome.errors, HasSubstr("it has an older one or none"));
    EXPECT_TRUE(std::filesystem::exists(folder / "a.exr"));
}

} // namespace
} // namespace quasilux

#include "view/tev_client.h"

#include "render/renderer.h"
#include "util/error.h"

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cstring>
#include <fmt/format.h>
#include <netdb.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

namespace quasilux {

namespace {

constexpr uint8_t updateImageV3 = 6, createImagePacket = 4;
const std::vector<std::string> channels{"R", "G", "B"};
constexpr size_t pixelsAtOnce = 1u << 20; // of a packet, and of what is read from the film at a time
constexpr time_t secondsToConnect = 2, secondsToTake = 5;
// Pictures of a render that goes on come no more often than this, and take at most this share of its time.
constexpr double secondsBetweenPictures = 0.5, shareOfTime = 0.02;

// Numbers are little-endian, texts end with a zero, and the length of all counts itself.
static_assert(std::endian::native == std::endian::little, "numbers are written as they are in memory");

class Packet {
public:
    explicit Packet(uint8_t type) : bytes_(sizeof(uint32_t), '\0') {
        number(type);
        number(uint8_t{0}); // the picture that is looked at stays so
    }
    template <typename T>
    void number(T value) {
        raw(&value, sizeof value);
    }
    void text(const std::string& value) { raw(value.c_str(), value.size() + 1); }
    void raw(const void* data, size_t size) { bytes_.append(static_cast<const char*>(data), size); }
    std::string finished() {
        const auto size = static_cast<uint32_t>(bytes_.size());
        std::memcpy(bytes_.data(), &size, sizeof size);
        return std::move(bytes_);
    }

private:
    std::string bytes_;
};

void setTimeout(int socket, time_t seconds) {
    const timeval time{seconds, 0};
    setsockopt(socket, SOL_SOCKET, SO_SNDTIMEO, &time, sizeof time);
}

// A connected socket; -1: `why` says what the system said.
int connectTo(const std::string& address, std::string& why) {
    const auto colon = address.rfind(':');
    std::string host = address.substr(0, colon);
    if (host.size() > 2 && host.front() == '[' && host.back() == ']') host = host.substr(1, host.size() - 2);
    addrinfo hints{}, *found = nullptr;
    hints.ai_socktype = SOCK_STREAM;
    if (const int failed = getaddrinfo(host.c_str(), address.substr(colon + 1).c_str(), &hints, &found); failed != 0) {
        why = gai_strerror(failed);
        return -1;
    }
    int connected = -1;
    for (const addrinfo* each = found; each != nullptr && connected < 0; each = each->ai_next) {
        const int one = socket(each->ai_family, each->ai_socktype | SOCK_CLOEXEC, each->ai_protocol);
        if (one < 0) continue;
        setTimeout(one, secondsToConnect);
        if (connect(one, each->ai_addr, each->ai_addrlen) == 0) {
            connected = one;
            setTimeout(one, secondsToTake);
        } else {
            why = errno == EINPROGRESS ? "no answer" : std::strerror(errno);
            close(one);
        }
    }
    freeaddrinfo(found);
    return connected;
}

} // namespace

namespace tev {

std::string createImage(const std::string& name, unsigned width, unsigned height) {
    Packet packet(createImagePacket);
    packet.text(name);
    for (const unsigned value : {width, height, static_cast<unsigned>(channels.size())}) packet.number(value);
    for (const auto& channel : channels) packet.text(channel);
    return packet.finished();
}

std::string updateImage(const std::string& name, unsigned y, unsigned width, unsigned rows, const float* values) {
    const size_t count = channels.size();
    Packet packet(updateImageV3);
    packet.text(name);
    packet.number(static_cast<uint32_t>(count));
    for (const auto& channel : channels) packet.text(channel);
    for (const unsigned value : {0u, y, width, rows}) packet.number(value);
    for (size_t c = 0; c < count; ++c) packet.number(static_cast<int64_t>(c));     // where a channel begins
    for (size_t c = 0; c < count; ++c) packet.number(static_cast<int64_t>(count)); // from pixel to pixel
    packet.raw(values, size_t(width) * rows * count * sizeof(float));
    return packet.finished();
}

} // namespace tev

TevClient::TevClient(const std::string& address, std::string name, Device& device)
    : address_(address), name_(std::move(name)), cutter_(device) {
    std::string why;
    socket_ = connectTo(address_, why);
    isLost_ = socket_ < 0;
    if (isLost_)
        warnings_.push_back(fmt::format("no tev at {} ({}): start it before the render, or say where it is by --tev "
                                        "HOST:PORT; the render goes on without it",
                                        address_, why));
    else
        sender_ = std::thread([this] { sendPictures(); });
}

TevClient::~TevClient() { finish(); }

void TevClient::finish() {
    {
        const std::lock_guard lock(mutex_);
        isOver_ = true;
        changed_.notify_all();
    }
    if (sender_.joinable()) sender_.join();
    if (socket_ >= 0) close(std::exchange(socket_, -1));
}

std::vector<std::string> TevClient::takeWarnings() {
    const std::lock_guard lock(mutex_);
    return std::exchange(warnings_, {});
}

void TevClient::afterPass(const Renderer& renderer, bool isLast) {
    const auto passes = static_cast<unsigned>(renderer.counters().passes);
    const auto start = Clock::now();
    {
        const std::lock_guard lock(mutex_);
        if (isLost_ || passes == 0) return;
        if (!isLast && (start < next_ || isSending_ || picture_)) return;
    }
    std::unique_ptr<FilmImage> picture;
    if (const auto why = failureOf([&] { picture = std::make_unique<FilmImage>(develop(renderer.film(), passes)); }))
        return giveUp("gets no more pictures", *why); // the render is to go on
    const double cost = std::chrono::duration<double>(Clock::now() - start).count();
    next_ = start + std::chrono::duration_cast<Clock::duration>(
                        std::chrono::duration<double>(std::max(secondsBetweenPictures, cost / shareOfTime)));
    const std::lock_guard lock(mutex_);
    picture_ = std::move(picture);
    changed_.notify_all();
}

// Piece by piece, as each takes memory of the device.
FilmImage TevClient::develop(const Film& film, unsigned passes) {
    FilmImage whole;
    whole.width = film.width();
    whole.height = film.height();
    const auto rows = static_cast<unsigned>(std::max<size_t>(1, pixelsAtOnce / film.width()));
    for (unsigned y = 0; y < film.height(); y += rows) {
        FilmCutChoice piece;
        piece.y = y;
        piece.width = film.width();
        piece.height = std::min(rows, film.height() - y);
        const FilmImage part = cutter_.develop(film, passes, piece);
        whole.radiance.insert(whole.radiance.end(), part.radiance.begin(), part.radiance.end());
    }
    return whole;
}

void TevClient::sendPictures() {
    std::unique_lock lock(mutex_);
    while (true) {
        changed_.wait(lock, [&] { return picture_ || isOver_; });
        if (!picture_ || isLost_) return;
        const auto picture = std::exchange(picture_, nullptr);
        isSending_ = true;
        lock.unlock();
        sendPicture(*picture);
        lock.lock();
        isSending_ = false;
    }
}

void TevClient::sendPicture(const FilmImage& picture) {
    if (!std::exchange(isCreated_, true) && !sendAll(tev::createImage(name_, picture.width, picture.height))) return;
    const auto rows = static_cast<unsigned>(std::max<size_t>(1, pixelsAtOnce / picture.width));
    for (unsigned y = 0; y < picture.height; y += rows) {
        const float* values = &picture.radiance[size_t(y) * picture.width * channels.size()];
        const unsigned count = std::min(rows, picture.height - y);
        if (!sendAll(tev::updateImage(name_, y, picture.width, count, values))) return;
    }
}

bool TevClient::sendAll(const std::string& bytes) {
    // tev says nothing, so that an end is all that can be read; the system would take one more packet after it without
    // a word.
    char none = 0;
    if (recv(socket_, &none, 1, MSG_PEEK | MSG_DONTWAIT) == 0) {
        giveUp("has gone", "it has closed the connection");
        return false;
    }
    for (size_t sent = 0; sent < bytes.size();) {
        const ssize_t count = ::send(socket_, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) {
            giveUp("has gone", errno == EAGAIN ? "it takes nothing any more" : std::strerror(errno));
            return false;
        }
        sent += static_cast<size_t>(count);
    }
    return true;
}

void TevClient::giveUp(const char* what, const std::string& why) {
    const std::lock_guard lock(mutex_);
    isLost_ = true;
    warnings_.push_back(fmt::format("tev at {} {} ({}): it has an older one or none", address_, what, why));
}

} // namespace quasilux

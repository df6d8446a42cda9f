// The picture in the viewer tev while it converges, by tev's protocol over TCP.
// From: https://github.com/Tom94/tev, "Over the network via TCP/IP"; packets CreateImage (4) and UpdateImageV3 (6).
#pragma once

#include "device/device.h"
#include "render/film_cut.h"

#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace quasilux {

class Renderer;

/// Packets, each with its length in front.
namespace tev {
std::string createImage(const std::string& name, unsigned width, unsigned height);
/// So many rows from `y` on; `values` has R, G, B side by side.
std::string updateImage(const std::string& name, unsigned y, unsigned width, unsigned rows, const float* values);
} // namespace tev

class TevClient {
public:
    /// `address`: HOST:PORT. That nobody is there is a warning, and then nothing is sent. `name`: of the picture in
    /// tev.
    TevClient(const std::string& address, std::string name, Device& device);
    ~TevClient();
    TevClient(const TevClient&) = delete;
    TevClient& operator=(const TevClient&) = delete;

    /// Called by the thread that renders, after each pass: a new picture, if it is time for one and the one before has
    /// gone; of the last pass in any case.
    void afterPass(const Renderer& renderer, bool isLast);
    /// Waits until the last picture has gone, or tev takes no more.
    void finish();
    /// What went wrong since the last call.
    std::vector<std::string> takeWarnings();

private:
    using Clock = std::chrono::steady_clock;
    FilmImage develop(const Film& film, unsigned passes);
    void sendPictures();
    void sendPicture(const FilmImage& picture);
    bool sendAll(const std::string& bytes);
    void giveUp(const char* what, const std::string& why);

    std::string address_, name_;
    FilmCutter cutter_;
    Clock::time_point next_{};
    int socket_ = -1;        ///< this and
    bool isCreated_ = false; ///< this are the sender's, once it runs
    std::thread sender_;

    std::mutex mutex_;
    std::condition_variable changed_;
    std::unique_ptr<FilmImage> picture_; ///< that waits
    std::vector<std::string> warnings_;
    bool isSending_ = false, isOver_ = false;
    bool isLost_ = false; ///< tev is not there, or not any more
};

} // namespace quasilux

// Messages between ranks, none of which anybody waits for: they are sent and received while other things are done.
#pragma once

#include <deque>
#include <mpi.h>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

namespace quasilux {

/// Between two looks at what has arrived.
inline constexpr double secondsOfTurn = 2e-3;

struct Message {
    unsigned from = 0;
    nlohmann::json head;
    std::vector<char> body{};
};

class Messages {
public:
    ~Messages();

    void send(unsigned to, const Message& message);
    /// One that has arrived; in the order in which each rank sent its own.
    std::optional<Message> receive();
    /// Until all that were sent have left.
    void flush();

private:
    void forgetSent();

    struct Sent {
        std::vector<char> bytes;
        MPI_Request request = MPI_REQUEST_NULL;
    };
    std::deque<Sent> sent_; // a deque leaves its elements where they are
};

} // namespace quasilux

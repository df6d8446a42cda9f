#include "ranks/mpi/messages.h"

#include "util/error.h"

#include <climits>
#include <cstring>

namespace quasilux {

namespace {

constexpr int tag = 1;

std::vector<char> packed(const Message& message) {
    const auto head = nlohmann::json::to_msgpack(message.head);
    const uint64_t headBytes = head.size();
    std::vector<char> bytes(sizeof headBytes + head.size() + message.body.size());
    std::memcpy(bytes.data(), &headBytes, sizeof headBytes);
    std::memcpy(bytes.data() + sizeof headBytes, head.data(), head.size());
    if (!message.body.empty())
        std::memcpy(bytes.data() + sizeof headBytes + head.size(), message.body.data(), message.body.size());
    if (bytes.size() > INT_MAX) throw DeviceError("a message between ranks is longer than MPI can send");
    return bytes;
}

Message unpacked(const std::vector<char>& bytes, unsigned from) {
    uint64_t headBytes = 0;
    std::memcpy(&headBytes, bytes.data(), sizeof headBytes);
    const char* head = bytes.data() + sizeof headBytes;
    Message message;
    message.from = from;
    message.head = nlohmann::json::from_msgpack(head, head + headBytes);
    message.body.assign(head + headBytes, bytes.data() + bytes.size());
    return message;
}

} // namespace

// Those that have not left by now are for ranks that do not listen any more.
Messages::~Messages() {
    for (Sent& sent : sent_) MPI_Request_free(&sent.request);
}

void Messages::send(unsigned to, const Message& message) {
    forgetSent();
    Sent& sent = sent_.emplace_back();
    sent.bytes = packed(message);
    MPI_Isend(sent.bytes.data(), static_cast<int>(sent.bytes.size()), MPI_BYTE, static_cast<int>(to), tag,
              MPI_COMM_WORLD, &sent.request);
}

std::optional<Message> Messages::receive() {
    forgetSent();
    int isThere = 0, bytes = 0;
    MPI_Status status;
    MPI_Iprobe(MPI_ANY_SOURCE, tag, MPI_COMM_WORLD, &isThere, &status);
    if (!isThere) return std::nullopt;
    MPI_Get_count(&status, MPI_BYTE, &bytes);
    std::vector<char> data(static_cast<size_t>(bytes));
    MPI_Recv(data.data(), bytes, MPI_BYTE, status.MPI_SOURCE, tag, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    return unpacked(data, static_cast<unsigned>(status.MPI_SOURCE));
}

void Messages::flush() {
    for (Sent& sent : sent_) MPI_Wait(&sent.request, MPI_STATUS_IGNORE);
    sent_.clear();
}

void Messages::forgetSent() {
    for (int isDone = 1; !sent_.empty();) {
        MPI_Test(&sent_.front().request, &isDone, MPI_STATUS_IGNORE);
        if (!isDone) return;
        sent_.pop_front();
    }
}

} // namespace quasilux

// The handlers of the signals that end a render.
#include "cli/interrupt.h"

#include <array>
#include <csignal>
#include <cstdint>
#include <ctime>
#include <unistd.h>

namespace quasilux {

namespace {

constexpr int signalBase = 128; // exit code of a program that a signal ends, as shells report it
constexpr std::array<int, 3> endingSignals{SIGINT, SIGTERM, SIGHUP};

// One cause may send several: a terminal that is closed SIGHUP by the shell and by the kernel, systemd SIGTERM with
// SIGHUP, `timeout` its signal to the program and to its group. These come close together; Ctrl-C is a key that may be
// pressed twice.
constexpr int64_t millisecondsOfOneCause = 2000, millisecondsOfOneKey = 200;

std::atomic<bool> interrupted{false};
std::atomic<int> firstSignal{0};
std::atomic<int64_t> firstTime{0}; // of milliseconds(); 0: none has come
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free &&
                  std::atomic<int64_t>::is_always_lock_free,
              "a signal handler may only touch lock-free atomics");

// Never 0. A signal handler may ask the system's clock, std::chrono promises nothing.
int64_t milliseconds() {
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);
    return 1 + int64_t{now.tv_sec} * 1000 + now.tv_nsec / 1000000;
}

void onInterrupt(int signal) {
    const int64_t now = milliseconds();
    int64_t first = 0;
    if (firstTime.compare_exchange_strong(first, now)) {
        firstSignal = signal;
        interrupted = true;
    } else if (now - first > (signal == SIGINT ? millisecondsOfOneKey : millisecondsOfOneCause)) {
        _exit(signalBase + signal);
    }
}

void exitNow(int signal) { _exit(signalBase + signal); }

// `nohup` has the program ignore SIGHUP: so it stays.
bool hangupIsIgnored() {
    struct sigaction now {};
    return sigaction(SIGHUP, nullptr, &now) == 0 && now.sa_handler == SIG_IGN;
}

void handle(void (*handler)(int)) {
    static const bool ignoresHangup = hangupIsIgnored(); // by the first call, before any handler is put in
    struct sigaction action {};
    action.sa_handler = handler;
    action.sa_flags = SA_RESTART; // a driver's system calls shall not fail for it
    sigemptyset(&action.sa_mask);
    for (const int signal : endingSignals)
        if (signal != SIGHUP || !ignoresHangup) sigaction(signal, &action, nullptr);
}

} // namespace

const std::atomic<bool>& interruptFlag() { return interrupted; }

void catchInterrupt() { handle(onInterrupt); }

void exitOnInterrupt() { handle(exitNow); }

int signalThatCame() { return firstSignal; }

int exitCodeWhenWritten() {
    const int signal = firstSignal;
    return signal == 0 || signal == SIGINT ? 0 : signalBase + signal;
}

int exitCodeWithoutResult() {
    const int signal = firstSignal;
    return signalBase + (signal == 0 ? SIGINT : signal);
}

} // namespace quasilux

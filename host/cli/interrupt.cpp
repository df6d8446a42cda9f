// The handlers of the signals that end a render.
#include "cli/interrupt.h"

#include <array>
#include <csignal>
#include <unistd.h>

namespace quasilux {

namespace {

constexpr int signalBase = 128; // exit code of a program that a signal ends, as shells report it
constexpr std::array<int, 3> endingSignals{SIGINT, SIGTERM, SIGHUP};

std::atomic<bool> interrupted{false};
std::atomic<int> firstSignal{0};
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free,
              "a signal handler may only touch lock-free atomics");

void onInterrupt(int signal) {
    int none = 0;
    if (!firstSignal.compare_exchange_strong(none, signal)) _exit(signalBase + signal);
    interrupted = true;
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

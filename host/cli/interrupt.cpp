// The handlers of Ctrl-C.
#include "cli/interrupt.h"

#include <csignal>
#include <unistd.h>

namespace quasilux {

namespace {

constexpr int exitInterrupted = 130; // 128 + SIGINT, as shells report it

std::atomic<bool> interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may only touch lock-free atomics");

void onInterrupt(int) {
    if (interrupted.exchange(true)) _exit(exitInterrupted);
}

void exitNow(int) { _exit(exitInterrupted); }

void handle(void (*handler)(int)) {
    struct sigaction action {};
    action.sa_handler = handler;
    action.sa_flags = SA_RESTART; // a driver's system calls shall not fail for it
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, nullptr);
}

} // namespace

const std::atomic<bool>& interruptFlag() { return interrupted; }

void catchInterrupt() { handle(onInterrupt); }

void exitOnInterrupt() { handle(exitNow); }

} // namespace quasilux

#include "server/app/signals.hpp"

#include <pthread.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

namespace skerry::server {

Signals::Signals() : had_terminal_(::isatty(STDIN_FILENO) == 1) {
  sigemptyset(&set_);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&set_, signal);
  pthread_sigmask(SIG_BLOCK, &set_, nullptr);
}

bool Signals::has_lost_terminal() const { return had_terminal_ && ::isatty(STDIN_FILENO) != 1; }

void Signals::await_end() {
  for (;;) {
    int signal = 0;
    sigwait(&set_, &signal);
    if (signal != SIGHUP || has_lost_terminal()) {
      spdlog::info("stopping on signal {}", signal);
      return;
    }
    spdlog::info("SIGHUP: files are taken up anew");
    for (const auto& what : on_hang_up_) what();
  }
}

}  // namespace skerry::server

#include "server/app/signals.hpp"

#include <pthread.h>
#include <spdlog/spdlog.h>

namespace skerry::server {

Signals::Signals() {
  sigemptyset(&set_);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&set_, signal);
  pthread_sigmask(SIG_BLOCK, &set_, nullptr);
}

void Signals::hang_up() const {
  spdlog::info("SIGHUP: files are taken up anew");
  for (const auto& what : on_hang_up_) what();
}

}  // namespace skerry::server

#include "server/app/supervision.hpp"

#include <cstddef>
#include <utility>

namespace skerry::server {
namespace {

constexpr int kFeedings = 4;  // in the time that the watchdog waits

timespec timespec_of(std::chrono::nanoseconds time) {
  constexpr std::int64_t kSecond = 1'000'000'000;
  return {.tv_sec = static_cast<time_t>(time.count() / kSecond),
          .tv_nsec = static_cast<long>(time.count() % kSecond)};
}

// As nohup(1) has it.
bool ignores_hangups() {
  struct sigaction now {};
  return sigaction(SIGHUP, nullptr, &now) == 0 && now.sa_handler == SIG_IGN;
}

}  // namespace

bool Pulse::beats(std::span<const std::uint64_t> steps) {
  before_.resize(steps.size(), 0);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (steps[i] == before_[i]) return false;
  }
  before_.assign(steps.begin(), steps.end());
  return true;
}

Supervision::Supervision(const ServiceManager& manager, Steps steps)
    : manager_(manager), steps_(std::move(steps)) {}

void Supervision::look() {
  if (!pulse_.beats(steps_())) return;
  if (!std::exchange(is_ready_, true)) {
    manager_.ready(status_);
  } else {
    manager_.alive();
  }
}

std::optional<std::chrono::nanoseconds> Supervision::pause() const {
  if (!manager_.is_there()) return std::nullopt;
  if (!is_ready_) return kFirstLooks;
  if (!manager_.watchdog()) return std::nullopt;
  return *manager_.watchdog() / kFeedings;
}

int Supervision::await(const sigset_t& signals, const std::string& status) {
  status_ = status;
  for (;;) {
    if (pause()) look();
    siginfo_t told{};
    const auto time = pause();
    const timespec most = timespec_of(time.value_or(std::chrono::nanoseconds{}));
    const int signal = time ? sigtimedwait(&signals, &told, &most) : sigwaitinfo(&signals, &told);
    if (signal < 0) continue;  // the time is over
    // The kernel sends it when the terminal has gone, people and systemctl to have files read.
    const bool is_hangup = signal == SIGHUP && told.si_code == SI_KERNEL;
    if (is_hangup && ignores_hangups()) continue;
    if (signal != SIGHUP || is_hangup) {
      manager_.stopping();
      return signal;
    }
    manager_.reloading();
    if (reload_) reload_();
    if (is_ready_) manager_.ready(status_);
  }
}

}  // namespace skerry::server

#include "server/access/password_desk.hpp"

#include <pthread.h>
#include <sys/resource.h>

#include <cstring>
#include <utility>

#include "server/access/password.hpp"

namespace skerry::server {
namespace {

constexpr int kNiceness = 10;  // radars and connections go first

}  // namespace

PasswordDesk::PasswordDesk(std::function<void(Task)> post)
    : post_(std::move(post)), thread_([this] { run(); }) {}

PasswordDesk::~PasswordDesk() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  change_.notify_one();
  thread_.join();
}

bool PasswordDesk::has_place() {
  const std::lock_guard lock(mutex_);
  return trials_.size() < kMostWaiting;
}

bool PasswordDesk::try_password(std::string hash, std::string password, Done done) {
  {
    const std::lock_guard lock(mutex_);
    if (trials_.size() >= kMostWaiting) return false;
    trials_.push_back({std::move(hash), std::move(password), std::move(done)});
  }
  change_.notify_one();
  return true;
}

void PasswordDesk::run() {
  ::pthread_setname_np(::pthread_self(), "passwords");
  ::setpriority(PRIO_PROCESS, 0, kNiceness);  // of this thread alone, as Linux has it
  std::unique_lock lock(mutex_);
  while (true) {
    change_.wait(lock, [this] { return ends_ || !trials_.empty(); });
    if (ends_) return;
    Trial trial = std::move(trials_.front());
    trials_.pop_front();
    lock.unlock();
    const bool is_right = is_password(trial.hash, trial.password);
    ::explicit_bzero(trial.password.data(), trial.password.size());
    // Moved: what `done` holds ends on the caller's thread.
    post_([done = std::move(trial.done), is_right] { done(is_right); });
    lock.lock();
  }
}

}  // namespace skerry::server

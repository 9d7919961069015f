#include "server/app/control/control_locks.hpp"

namespace skerry::server {

bool ControlLocks::shared(std::size_t radar, std::size_t other, const std::string& control) const {
  if (radar == other || control == "world") return true;
  const bool is_order = control == "course_deg" || control == "speed_kn" || control == "con";
  return is_order && own_ships_[radar] == own_ships_[other];
}

bool ControlLocks::change(const wire::Set& set) {
  const std::lock_guard lock(mutex_);
  const std::vector<std::set<std::string>> before = locked_;
  for (std::size_t radar = 0; radar < locked_.size(); ++radar) {
    for (const std::string& name : set.unlock()) {
      if (shared(set.radar(), radar, name)) locked_[radar].erase(name);
    }
    for (const std::string& name : set.lock()) {
      if (shared(set.radar(), radar, name)) locked_[radar].insert(name);
    }
  }
  return locked_ != before;
}

bool ControlLocks::is_locked(std::size_t radar, const std::string& control) const {
  const std::lock_guard lock(mutex_);
  return locked_[radar].count(control) > 0;
}

std::vector<std::string> ControlLocks::locked(std::size_t radar) const {
  const std::lock_guard lock(mutex_);
  return {locked_[radar].begin(), locked_[radar].end()};
}

ControlLocks::Locked ControlLocks::all() const {
  const std::lock_guard lock(mutex_);
  return locked_;
}

void ControlLocks::set_all(Locked locked) {
  const std::lock_guard lock(mutex_);
  locked_ = std::move(locked);
}

}  // namespace skerry::server

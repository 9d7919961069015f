// ControlLocks: which controls of which radar only the instructor may change.
#pragma once

#include <cstddef>
#include <functional>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "protocol/wire/radar.pb.h"

namespace skerry::server {

// A lock is of a radar, for all its views.  What radars share is locked in all of them at once: the
// orders of a ship in all her radars, the world in all.
// Thread: any.
class ControlLocks {
 public:
  // `own_ships`: of each radar, which ship it is on.
  explicit ControlLocks(std::vector<std::size_t> own_ships)
      : own_ships_(std::move(own_ships)), locked_(own_ships_.size()) {}

  // Unlocks, then locks, what `set` says.  Requires a radar that is there and names of controls.
  // True if anything is otherwise now.
  bool change(const wire::Set& set);

  bool is_locked(std::size_t radar, const std::string& control) const;
  std::vector<std::string> locked(std::size_t radar) const;

  // All of them, and all of them anew.
  using Locked = std::vector<std::set<std::string>>;
  Locked all() const;
  void set_all(Locked locked);

 private:
  // The radars whose lock of that control is one with that of `radar`.
  bool shared(std::size_t radar, std::size_t other, const std::string& control) const;

  std::vector<std::size_t> own_ships_;
  mutable std::mutex mutex_;
  std::vector<std::set<std::string>> locked_;
};

}  // namespace skerry::server

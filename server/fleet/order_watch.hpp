// OrderWatch: the log of an exercise as it grows.
#pragma once

#include <chrono>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "server/fleet/order_store.hpp"

namespace skerry::fleet {

// Gives every change of the log from a revision on, in order, each once, whatever happens to the
// connection: after a disconnect it goes on behind the last one given.  What was compacted away
// meanwhile is told as an error and then read: orders are all there; of grants and holders the last
// ones are, which is all that counts.
// Thread: one at a time, with a KeyStore of its own.
class OrderWatch {
 public:
  // A member from which nothing came for so long may be stopped or cut off: another is asked. While
  // an exercise runs there are ten grants a second; less would leave members that are well.
  static constexpr std::chrono::milliseconds kQuiet{500};

  // `from`: 1 + LogText::at, or 1.  Error: std::invalid_argument, as of OrderStore.
  // `held`: names that are known to be held.
  OrderWatch(KeyStore& keys, StoreMark& mark, const std::string& exercise, Revision from,
             std::set<std::string> held = {});

  // At the latest at the deadline; empty: nothing came until then, or for kQuiet.
  // Error: said once; the next call goes on where this one ended.  Only went_back stays.
  StoreResult<std::vector<LogEvent>> next(HostTime deadline);

  Revision from() const { return next_; }  // of what comes next

 private:
  StoreResult<std::vector<LogEvent>> read_anew(HostTime deadline);
  StoreResult<std::vector<LogEvent>> events_of(const WatchStep& step);
  void note(const LogEvent& event);

  KeyStore& keys_;
  StoreMark& mark_;
  OrderStore store_;
  Revision next_;
  std::unique_ptr<KeyWatch> stream_;
  HostTime heard_{};
  bool must_read_ = false;
  std::set<std::string> held_;  // names
};

}  // namespace skerry::fleet

// LogReader: the thread that hears an exercise's log.
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "server/fleet/member/member_plan.hpp"
#include "server/fleet/order_store.hpp"
#include "server/fleet/store_mark.hpp"

namespace skerry::fleet {

// Begins the exercise in the store or finds it there, reads its log, and then watches it grow.
class LogReader {
 public:
  struct Heard {
    bool anew = false;  // the events are the whole log
    std::vector<LogEvent> events;
    std::optional<StoreError> error;
    bool ended = false;  // for ever: the error says why
  };
  // Both must outlive it.  `hear` is called from its thread.
  LogReader(const MemberPlan& plan, StoreMark& mark, std::function<void(Heard)> hear);
  ~LogReader() { stop(); }

  // A trouble that cannot pass for so long ends the reader.
  static constexpr std::chrono::seconds kMend{10};

  void start();
  void stop();
  // The whole log is heard again, from its beginning.  Thread: any.
  void read_anew() { anew_.store(true); }

 private:
  void run(const std::stop_token& stop);
  bool begin(KeyStore& keys, OrderStore& store);
  StoreResult<Revision> hear_all(KeyStore& keys, OrderStore& store);
  bool watch(KeyStore& keys, Revision from, const std::stop_token& stop);
  StoreResult<std::string> agree(KeyStore& keys, const LogKeys& names);
  // False: it has ended.  Went back, or `at_once`: at once.  Unreachable, slow, no majority, full,
  // refused, compacted: never.  All else: after kMend without a good answer.
  bool tell(StoreError error, bool at_once = false);

  const MemberPlan& plan_;
  StoreMark& mark_;
  std::function<void(Heard)> hear_;
  std::atomic<bool> anew_{false};
  std::optional<HostTime> troubled_;  // since when by no trouble that may pass; its thread's
  std::set<std::string> holders_;     // names that were held when all was heard; its thread's
  bool differs_ = false;              // the charter; its thread's
  std::jthread thread_;
};

}  // namespace skerry::fleet

// OrderDesk: the thread that appends this host's orders to the log.
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <variant>

#include "server/fleet/exercise_log.hpp"
#include "server/fleet/member/member_plan.hpp"
#include "server/fleet/store_mark.hpp"

namespace skerry::fleet {

// One after the other, each as soon as it can be given: some milliseconds, over an election of the
// store a second.  What has not been appended kPatience after it came is refused.
class OrderDesk {
 public:
  static constexpr std::size_t kMostWaiting = 256;
  static constexpr std::chrono::milliseconds kPatience{3000};

  using Place = std::function<std::variant<ExerciseLog::Place, ExerciseLog::Refusal>()>;
  using Refused = std::function<void(const std::string& id, const std::string& text)>;
  // All must outlive it.  Both functions are called from its thread.
  OrderDesk(const MemberPlan& plan, StoreMark& mark, Place place, Refused refused);
  ~OrderDesk() { stop(); }

  void start();
  // Orders that wait are refused.
  void stop();
  // False: too many wait.  Thread: any.
  bool add(std::string id, std::string order);

 private:
  struct Waiting {
    std::string id, order;
    HostTime until;
  };
  void run(const std::stop_token& stop);
  void append(OrderStore& store, KeyStore& keys, const Waiting& order, const std::stop_token& stop);

  const MemberPlan& plan_;
  StoreMark& mark_;
  Place place_;
  Refused refused_;
  std::mutex mutex_;
  std::condition_variable_any added_;
  std::deque<Waiting> waiting_;  // guarded by mutex_
  std::jthread thread_;
};

}  // namespace skerry::fleet

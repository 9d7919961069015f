#include "tests/system/fleet/history_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace skerry::fleet {
namespace {

class Check {
 public:
  explicit Check(const ToldHistory& history) : history_(history) {}

  std::vector<std::string> run() {
    look_at_log();
    look_at_appends();
    look_at_times();
    for (const WatchTold& watch : history_.watches) look_at_watch(watch);
    return std::move(found_);
  }

 private:
  template <typename... Values>
  void say(fmt::format_string<Values...> text, Values&&... values) {
    if (found_.size() < 20) found_.push_back(fmt::format(text, std::forward<Values>(values)...));
  }

  void look_at_log() {
    OrderSeen last;
    for (const OrderSeen& order : history_.log) {
      if (order.revision <= last.revision)
        say("{} of revision {} stands behind revision {}", order.id, order.revision, last.revision);
      if (order.epoch < last.epoch)
        say("{} of epoch {} stands behind epoch {}", order.id, order.epoch, last.epoch);
      if (order.tick < last.tick)
        say("{} of tick {} stands behind tick {}", order.id, order.tick, last.tick);
      if (!at_.emplace(order.id, order.revision).second) say("{} is there twice", order.id);
      last = order;
    }
  }

  void look_at_appends() {
    for (const AppendTold& append : history_.appends) {
      const auto at = at_.find(append.id);
      if (append.end == AppendTold::End::done && at == at_.end())
        say("{} was acknowledged to {} and is not there", append.id, append.process);
      else if (append.end == AppendTold::End::done && at->second != append.revision)
        say("{} was acknowledged in revision {} and is in {}", append.id, append.revision,
            at->second);
      if (append.end == AppendTold::End::never && at != at_.end())
        say("{} was refused to {} for good and is there", append.id, append.process);
    }
  }

  // By the end of appends: the largest revision acknowledged before each began.
  void look_at_times() {
    std::vector<const AppendTold*> done;
    for (const AppendTold& append : history_.appends) {
      if (append.end == AppendTold::End::done) done.push_back(&append);
    }
    auto begun = done;
    std::sort(done.begin(), done.end(),
              [](const auto* a, const auto* b) { return a->ended_ns < b->ended_ns; });
    std::sort(begun.begin(), begun.end(),
              [](const auto* a, const auto* b) { return a->began_ns < b->began_ns; });
    auto next = done.begin();
    const AppendTold* newest = nullptr;
    for (const AppendTold* append : begun) {
      for (; next != done.end() && (*next)->ended_ns < append->began_ns; ++next) {
        if (!newest || (*next)->revision > newest->revision) newest = *next;
      }
      if (newest && append->revision < newest->revision)
        say("{} in revision {} was begun after {} in {} was acknowledged", append->id,
            append->revision, newest->id, newest->revision);
    }
  }

  void look_at_watch(const WatchTold& watch) {
    auto next = std::find_if(history_.log.begin(), history_.log.end(),
                             [&](const OrderSeen& order) { return order.revision >= watch.from; });
    for (const auto& [revision, id] : watch.orders) {
      if (next == history_.log.end() || next->revision != revision || next->id != id) {
        say("the watch of {} from {} gave {} of revision {}, and {} of {} is next", watch.process,
            watch.from, id, revision, next == history_.log.end() ? "nothing" : next->id,
            next == history_.log.end() ? 0 : next->revision);
        return;
      }
      ++next;
    }
  }

  const ToldHistory& history_;
  std::map<std::string, Revision> at_;
  std::vector<std::string> found_;
};

}  // namespace

std::vector<std::string> contradictions(const ToldHistory& history) { return Check(history).run(); }

}  // namespace skerry::fleet

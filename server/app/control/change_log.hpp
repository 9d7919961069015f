// ChangeLog: who changed which control, in the server's log.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <tuple>

#include "server/app/control/control_change.hpp"
#include "server/core/audit_port.hpp"

namespace skerry::server {

// The logger whose lines say which control was changed; its sinks are those of the server's log.
inline constexpr const char* kControlLogger = "controls";

// A line for every change, but at most one in kQuietTime for each control and origin: a display
// whose knob is turned, or a sender gone wild, changes a control a thousand times a second.  What
// comes within that time is put together in one line that says from what to what and how many
// changes that were.  Lines of all together are bounded too: kMostLines at once and one every
// kLineTime on and on; what is beyond is counted, and the count is told in a line of its own.
// Thread: one at a time.  Times are those of a steady clock.
class ChangeLog {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::seconds kQuietTime{1};
  static constexpr int kMostLines = 100;
  static constexpr std::chrono::milliseconds kLineTime{200};
  static constexpr std::size_t kMaxWaiting = 512;  // controls and origins looked at one by one

  // Takes the lines; the server's log by default.
  using Sink = std::function<void(const std::string& line)>;
  ChangeLog();
  explicit ChangeLog(Sink sink) : sink_(std::move(sink)) {}
  // The audit has every line, also those that are beyond what the log takes.
  void set_audit(AuditPort* audit) { audit_ = audit; }

  // `place`: "radar 0 view 0".
  void add(const std::string& origin, const std::string& place, const ControlChange& change,
           Clock::time_point now);
  // Tells what has waited its time.  Call it a few times a second while waits() is true.
  void flush(Clock::time_point now);
  // Tells all that waits, at the end.
  void flush_all();
  bool waits() const { return !entries_.empty() || left_out_ > 0; }

 private:
  // Origin, who is there (of an audit alone), place, control.
  using Key = std::tuple<std::string, std::string, std::string, std::string>;
  struct Entry {
    Clock::time_point told;
    std::uint64_t changes = 0;  // since
    std::string before = {}, after = {};
  };
  void look_at_clock(Clock::time_point now);
  bool take_room();
  void audit(const Key& key, const Entry& entry) const;
  void tell(const Key& key, const Entry& entry);
  void tell_left_out();

  Sink sink_;
  AuditPort* audit_ = nullptr;
  std::map<Key, Entry> entries_;  // of controls told within kQuietTime
  Clock::time_point last_{};
  Clock::duration room_ = kMostLines * kLineTime;
  std::uint64_t left_out_ = 0;
};

}  // namespace skerry::server

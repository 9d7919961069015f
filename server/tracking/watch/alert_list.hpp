// AlertList: what a mariner is told to look at, and what has become of it.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "protocol/quantity/time.hpp"
#include "protocol/wire/targets.pb.h"

namespace skerry::server {

enum class AlertKind : std::uint8_t {
  approach,
  new_target,
  lost_target,
  lost_input,
  capacity_exceeded,
  capacity_near,
};

// Of all alerts of a kind.
struct AlertRow {
  AlertKind kind;
  std::uint32_t number;
  wire::AlertPriority priority;
  std::string_view category, title;
  // Unacknowledged, it stays when its cause is gone.
  bool stays_rectified;
  // It tells what has happened, not what is: done with once it is acknowledged.
  bool is_event;
};

// Source of the numbers: IEC 62923-2, table A.1, quoted at second hand; the categories are
// provisional (README.md says what is not verified).
const AlertRow& row_of(AlertKind kind);

// Whose it is: of a tracked target, an AIS target, or of something else by a name.
struct AlertSubject {
  std::uint32_t target = 0, mmsi = 0;
  std::string what;
  friend auto operator<=>(const AlertSubject&, const AlertSubject&) = default;
};

// Alerts in the shape of IEC 62923-1, as quoted at second hand: an instance for each subject, a
// revision with every change.
//
// Time: go_on() first, with times that do not go back; else clear().
class AlertList {
 public:
  // More: the least important, oldest one goes.  Above all causes that there can be at once: 200
  // tracked and 240 AIS targets, 50 lost ones, and inputs.
  static constexpr std::size_t kMost = 600;
  static constexpr Duration kSilence = std::chrono::seconds(30);
  static constexpr Duration kEscalates = std::chrono::seconds(60);
  static constexpr std::uint32_t kLastInstance = 999'999;

  void go_on(UtcTime now);
  // The cause is there; without effect while it has been.  `text` tells of it as it begins.
  void raise(AlertKind kind, const AlertSubject& subject, std::string text);
  // The cause is gone.
  void end(AlertKind kind, const AlertSubject& subject);
  // Its subject is none any more.
  void remove(const AlertSubject& subject);
  // `to` is the same as `from` from now on, or is split off from it: its alert of this kind, unless
  // it has its own.
  void move(AlertKind kind, const AlertSubject& from, const AlertSubject& to);
  void copy(AlertKind kind, const AlertSubject& from, const AlertSubject& to);
  void clear() { alerts_.clear(); }

  bool has(AlertKind kind, const AlertSubject& subject) const;
  bool has(std::uint32_t number, std::uint32_t instance) const;
  bool is_unacknowledged(AlertKind kind, const AlertSubject& subject) const;

  // `instance` 0: all of that number.
  void acknowledge(std::uint32_t number, std::uint32_t instance);
  void silence();

  // Alarms first, then the newest first.
  std::vector<wire::Alert> told() const;

 private:
  struct Entry {
    wire::AlertState state = wire::ALERT_ACTIVE;
    std::uint32_t instance = 0, revision = 1, escalations = 0;
    std::string text;
    UtcTime changed{}, raised{}, silenced{};
  };
  using Key = std::pair<AlertKind, AlertSubject>;
  void change(Entry& entry, wire::AlertState state);
  void make_room();
  std::uint32_t new_instance(AlertKind kind);

  std::map<Key, Entry> alerts_;
  std::map<AlertKind, std::uint32_t> instances_;
  UtcTime now_{};
};

// The row of this number; nullptr: there is none.
const AlertRow* find_alert_row(std::uint32_t number);

}  // namespace skerry::server

// TrafficWriter: ships as AIS has them into a log of sentences or a table.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/nmea/ais_messages.hpp"
#include "protocol/quantity/time.hpp"
#include "server/core/traffic.hpp"

namespace skerry::server {

enum class TrafficForm : std::uint8_t { nmea, csv };

// Who reports when: by the intervals of ITU-R M.1371 (ais_reports.hpp), counted in whole seconds,
// and at once when a ship appears, changes her interval, or turns or changes her speed at once.
// The last place before she vanishes is reported too.  Names and sizes of a log come with the first
// report and every six minutes.  In a log each sentence has a TAG block with its time; aids to
// navigation are left out of a table.
// Thread: one at a time.
class TrafficWriter {
 public:
  using Sink = std::function<void(std::string_view)>;
  // `every`: instead of the intervals.
  TrafficWriter(TrafficForm form, std::optional<Duration> every, Sink sink);

  // Once a second of the exercise: all that is on the water.
  void second(const std::vector<TrafficItem>& items, UtcTime utc);
  // After the last second: whoever has not reported then does.
  void finish();

  std::uint64_t reports() const { return reports_; }  // of positions
  std::size_t ships() const { return ships_seen_; }

 private:
  struct Ship {
    TrafficItem item;  // as of the last second
    UtcTime seen{}, reported{}, named{};
    Duration interval{};
    bool has_reported = false;
  };
  bool is_due(const Ship& ship, const TrafficItem& now, UtcTime utc) const;
  void report(Ship& ship);
  void say(const nmea::AisMessage& message, UtcTime utc);
  void row(const TrafficItem& item, UtcTime utc);

  TrafficForm form_;
  std::optional<Duration> every_;
  Sink sink_;
  std::map<std::uint32_t, Ship> ships_;  // by number
  std::uint64_t reports_ = 0;
  std::size_t ships_seen_ = 0;
  unsigned identifier_ = 0;
  bool channel_b_ = false;
};

}  // namespace skerry::server

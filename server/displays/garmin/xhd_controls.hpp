// The controls of a Garmin xHD radar on those of a view: commands into Sets, settings into reports.
#pragma once

#include <cstdint>
#include <optional>

#include "protocol/garmin/xhd_packet.hpp"
#include "protocol/wire/radar.pb.h"
#include "server/displays/display_range.hpp"

namespace skerry::server {

// Remembers what a view cannot hold: the levels of sea and rain while they are off, which range of
// the display's own table is shown, the no-transmit zone while it is off, and what has no
// counterpart here (the level of automatic gain, the times of timed transmission).
// Thread: one at a time.
class XhdControls {
 public:
  XhdControls();

  // The command as a Set; empty if it only changes a value that is remembered here, or is not for a
  // view (transmit).
  std::optional<wire::Set> set_of(const garmin::Command& command, const wire::Settings& now) const;
  // The command took effect; `after` is what came of it.
  void accept(const garmin::Command& command, const wire::Settings& after);
  // The settings changed, by whomever: levels are kept for when sea or rain is switched off.
  void observe(const wire::Settings& now);

  // The value of a report of that type; empty for types that are no settings.
  std::optional<std::int64_t> report(garmin::Type type, const wire::Settings& now) const;

  const DisplayRanges& ranges() const { return ranges_; }
  double range_m(const wire::Settings& now) const;

 private:
  void add_no_transmit(wire::Set& set, std::int64_t from, std::int64_t to) const;
  std::int64_t sea_mode(const wire::Settings& now) const;
  bool rain_is_on(const wire::Settings& now) const;
  bool zone_is_ours(const wire::Settings& now) const;

  DisplayRanges ranges_;
  Remembered<double> range_;  // by range scale, NM
  Remembered<std::int64_t> rejection_, speed_;
  std::int64_t gain_auto_level_ = 1;
  std::int64_t rain_level_ = 3200, sea_level_ = 5000, sea_auto_level_ = 1;
  bool rain_on_ = false, sea_by_hand_ = false;
  std::int64_t zone_from_ = 170 * 32, zone_to_ = -170 * 32;
  std::int64_t timed_on_ = 0, timed_idle_ = 300, timed_run_ = 60;
};

}  // namespace skerry::server

#include "protocol/picture/label_text.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <cstdlib>

#include "protocol/wire/printable_text.hpp"

namespace skerry {
namespace {

// Degrees and minutes to a thousandth, so that 59.9996 minutes become the next degree.
std::string degrees_minutes(double degrees, int digits, char positive, char negative) {
  const long thousandths = std::lround(std::abs(degrees) * 60000.0);
  return fmt::format("{:0{}}^{:06.3f}'{}", thousandths / 60000, digits,
                     static_cast<double>(thousandths % 60000) / 1000.0,
                     degrees < 0 ? negative : positive);
}

}  // namespace

std::string three_digits(int degrees) { return fmt::format("{:03}", degrees); }

std::string bearing_text(double degrees) {
  const long tenths = std::lround(degrees * 10.0) % 3600;
  return fmt::format("{:05.1f}^", static_cast<double>(tenths) / 10.0);
}

std::string position_text(GeoPoint point) {
  return degrees_minutes(point.latitude_deg, 2, 'N', 'S') + " " +
         degrees_minutes(point.longitude_deg, 3, 'E', 'W');
}

std::string utc_text(UtcTime time) {
  const auto whole = std::chrono::floor<std::chrono::seconds>(time);
  const auto milliseconds =
      std::chrono::duration_cast<std::chrono::milliseconds>(time - whole).count();
  return fmt::format("{:%Y-%m-%dT%H:%M:%S}.{:03}Z",
                     fmt::gmtime(std::chrono::system_clock::to_time_t(
                         std::chrono::time_point_cast<std::chrono::system_clock::duration>(whole))),
                     milliseconds);
}

std::string range_text(RangeScale scale) { return fmt::format("{:g}", scale.in_nautical_miles()); }

LabelText label_text(const Scan& scan, Orientation orientation, const PpiLabels& labels) {
  LabelText text;
  if (!labels.radar.empty()) text.top_left.push_back({printable(labels.radar, 28)});
  const Spoke* newest = scan.newest();
  if (!newest) {
    text.top_left.push_back({"NO VIDEO", true});
    return text;
  }
  const SpokeHeader& header = newest->header;
  const int rings = header.range_scale.ring_count();
  text.top_left.push_back({fmt::format("RANGE {} NM", range_text(header.range_scale))});
  text.top_left.push_back(
      {fmt::format("RINGS {:.3g} NM", header.range_scale.in_nautical_miles() / rings)});
  text.top_left.push_back({orientation == Orientation::head_up ? "HEAD UP RM" : "NORTH UP RM"});

  if (labels.own_ship) text.top_right.push_back({printable(labels.own_ship->name(), 28)});
  const bool no_heading = labels.own_ship && labels.own_ship->no_heading();
  text.top_right.push_back(
      {no_heading ? std::string("HDG ---")
                  : fmt::format("HDG {}", bearing_text(header.heading.in_degrees()))});
  if (labels.own_ship) {
    // A recording that knows no motion has no log either.
    const wire::OwnShip& own = *labels.own_ship;
    const bool no_speed = own.no_log() || (own.no_motion() && own.speed_kn() == 0.0);
    text.top_right.push_back({no_speed
                                  ? std::string("SPD --- KN")
                                  : fmt::format("SPD {:.1f} KN", labels.own_ship->speed_kn())});
  }
  if (labels.own_ship && labels.own_ship->no_position()) {
    text.top_right.push_back({"NO POSITION"});
  } else {
    const std::string position = position_text(header.own_ship);
    text.top_right.push_back({position.substr(0, position.find(' '))});
    text.top_right.push_back({position.substr(position.find(' ') + 1)});
  }

  if (labels.settings) {
    text.bottom_left.push_back({fmt::format("GAIN {:.0f}", labels.settings->gain())});
    text.bottom_left.push_back({fmt::format("SEA {:.0f}", labels.settings->sea())});
    text.bottom_left.push_back({fmt::format("RAIN {:.0f}", labels.settings->rain())});
  }
  if (!labels.warning.empty()) text.bottom_left.push_back({printable(labels.warning, 60), true});
  if (!scan.has_one_range_scale()) text.bottom_left.push_back({"RANGE CHANGED", true});

  const std::string utc = utc_text(header.utc);
  if (scan.missing() > 0) {
    text.bottom_right.push_back(
        {fmt::format("{} OF {} {}", scan.missing(), scan.geometry.spokes_per_turn,
                     labels.formed_of_pulses ? "EMPTY" : "LOST"),
         true});
  }
  text.bottom_right.push_back({fmt::format("SCAN {}", scan.number)});
  text.bottom_right.push_back({fmt::format("CELL {:.2f} M", header.cell_size().in_metres())});
  text.bottom_right.push_back({utc.substr(0, utc.find('T'))});
  text.bottom_right.push_back({utc.substr(utc.find('T') + 1, 8) + " UTC"});
  return text;
}

}  // namespace skerry

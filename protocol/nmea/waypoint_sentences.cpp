#include "protocol/nmea/waypoint_sentences.hpp"

#include <algorithm>

#include "protocol/nmea/optional_fields.hpp"
#include "protocol/nmea/ranged_fields.hpp"
#include "protocol/nmea/track_sentences.hpp"

namespace skerry::nmea {
namespace {

// Two names and a position leave no room for more: 0.93 m.
constexpr int kWaypointDecimals = 3;
constexpr double kMostReadOffTrackNm = 1000.0;
constexpr Range kRangeToWaypoint{0.0, 99'999.999};
constexpr Range kClosingSpeed{-999.9, 999.9};

// What follows the names of an RMB: ",llll.lll,N,yyyyy.yyy,E,999.9,359.9,-999.9,V,S".
constexpr std::size_t kBehindNames = 46;

std::optional<double> at_most(std::optional<double> value, double most) {
  if (!value) return std::nullopt;
  return std::clamp(*value, -most, most);
}

std::optional<double> true_bearing(FieldReader& in, std::size_t index) {
  return in.number_in(index, 'T', kAnyBearing.min, kAnyBearing.max);
}

}  // namespace

std::string encode(const Rmb& rmb, std::string_view talker) {
  SentenceWriter out('$', talker, "RMB");
  add_status(out, rmb.valid && (rmb.mode == 'A' || rmb.mode == 'D'));
  add_sided(out, at_most(rmb.off_track_nm, 9.99), 2, 9.99, 'L', 'R');
  // Half of the room is the origin's; 1 is the comma of the second name.
  const std::size_t room = out.room(kBehindNames + 1);
  out.text(rmb.origin, std::min(kMostWaypointName, room / 2));
  out.text(rmb.destination, std::min(kMostWaypointName, out.room(kBehindNames)));
  optional_position(out, rmb.position, kWaypointDecimals);
  add_number(out, at_most(rmb.range_nm, 999.9), 1, {0.0, 999.9});
  optional_angle(out, rmb.bearing_deg, 1);
  add_number(out, rmb.closing_kn, 1, kClosingSpeed);
  return add_status(out, rmb.arrived).letter(rmb.mode).finish();
}

Result<Rmb, WireError> decode_rmb(const Sentence& sentence) {
  FieldReader in(sentence);
  Rmb rmb;
  rmb.valid = read_status(in, 0);
  rmb.off_track_nm = read_sided(in, 1, kMostReadOffTrackNm, 'L', 'R');
  rmb.origin = in.text(3);
  rmb.destination = in.text(4);
  rmb.position = in.position(5);
  rmb.range_nm = read_number(in, 9, kRangeToWaypoint);
  rmb.bearing_deg = read_number(in, 10, kAnyBearing);
  rmb.closing_kn = read_number(in, 11, kClosingSpeed);
  rmb.arrived = read_status(in, 12);
  rmb.mode = read_mode(in, 13);
  return answer(in, std::move(rmb));
}

std::string encode(const Bwc& bwc, std::string_view talker) {
  SentenceWriter out('$', talker, "BWC");
  optional_time(out, bwc.time_of_day);
  optional_position(out, bwc.position, kWaypointDecimals);
  optional_angle(out, bwc.bearing_deg, 1).letter('T').empty().letter('M');
  add_number(out, bwc.range_nm, 3, kRangeToWaypoint).letter('N');
  return out.text(bwc.waypoint, std::min(kMostWaypointName, out.room(2))).letter(bwc.mode).finish();
}

Result<Bwc, WireError> decode_bwc(const Sentence& sentence) {
  FieldReader in(sentence);
  Bwc bwc;
  bwc.time_of_day = in.time(0);
  bwc.position = in.position(1);
  bwc.bearing_deg = true_bearing(in, 5);
  bwc.range_nm = in.number_in(9, 'N', kRangeToWaypoint.min, kRangeToWaypoint.max);
  bwc.waypoint = in.text(11);
  bwc.mode = read_mode(in, 12);
  return answer(in, std::move(bwc));
}

std::string encode(const Bod& bod, std::string_view talker) {
  SentenceWriter out('$', talker, "BOD");
  optional_angle(out, bod.bearing_deg, 1).letter('T').empty().letter('M');
  return out.text(bod.destination, kMostWaypointName).text(bod.origin, kMostWaypointName).finish();
}

Result<Bod, WireError> decode_bod(const Sentence& sentence) {
  FieldReader in(sentence);
  Bod bod;
  bod.bearing_deg = true_bearing(in, 0);
  bod.destination = in.text(4);
  bod.origin = in.text(5);
  return answer(in, std::move(bod));
}

}  // namespace skerry::nmea

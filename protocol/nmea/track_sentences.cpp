#include "protocol/nmea/track_sentences.hpp"

#include <algorithm>

#include "protocol/nmea/optional_fields.hpp"
#include "protocol/nmea/ranged_fields.hpp"

namespace skerry::nmea {
namespace {

constexpr double kMostOffTrackNm = 99.999;

// Magnitude, the side to steer to, and the unit.
void add_off_track(SentenceWriter& out, std::optional<double> off_track_nm) {
  add_sided(out, off_track_nm, 3, kMostOffTrackNm, 'L', 'R').letter('N');
}

std::optional<double> read_off_track(FieldReader& in, std::size_t index) {
  const auto off_track = read_sided(in, index, kMostOffTrackNm, 'L', 'R');
  return in.letter(index + 2) == 'N' ? off_track : std::nullopt;
}

bool both_valid(FieldReader& in) {
  const bool fix = read_status(in, 0), lock = read_status(in, 1);
  return fix && lock;
}

}  // namespace

std::string encode(const Xte& xte, std::string_view talker) {
  SentenceWriter out('$', talker, "XTE");
  add_status(add_status(out, xte.valid), xte.valid);
  add_off_track(out, xte.off_track_nm);
  return out.letter(xte.mode).finish();
}

Result<Xte, WireError> decode_xte(const Sentence& sentence) {
  FieldReader in(sentence);
  Xte xte;
  xte.valid = both_valid(in);
  xte.off_track_nm = read_off_track(in, 2);
  xte.mode = read_mode(in, 5);
  return answer(in, xte);
}

std::string encode(const Apb& apb, std::string_view talker) {
  SentenceWriter out('$', talker, "APB");
  add_status(add_status(out, apb.valid), apb.valid);
  add_off_track(out, apb.off_track_nm);
  add_status(add_status(out, apb.arrival_circle_entered), apb.perpendicular_passed);
  optional_angle(out, apb.track_deg, 1).letter('T').text(apb.waypoint, kMostWaypointName);
  optional_angle(out, apb.bearing_deg, 1).letter('T');
  return optional_angle(out, apb.heading_deg, 1).letter('T').letter(apb.mode).finish();
}

Result<Apb, WireError> decode_apb(const Sentence& sentence) {
  FieldReader in(sentence);
  const auto bearing = [&](std::size_t index) {
    return in.number_in(index, 'T', kAnyBearing.min, kAnyBearing.max);
  };
  Apb apb;
  apb.valid = both_valid(in);
  apb.off_track_nm = read_off_track(in, 2);
  apb.arrival_circle_entered = read_status(in, 5);
  apb.perpendicular_passed = read_status(in, 6);
  apb.track_deg = bearing(7);
  apb.waypoint = in.text(9);
  apb.bearing_deg = bearing(10);
  apb.heading_deg = bearing(12);
  apb.mode = read_mode(in, 14);
  return answer(in, std::move(apb));
}

}  // namespace skerry::nmea

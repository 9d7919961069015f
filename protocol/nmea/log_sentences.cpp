#include "protocol/nmea/log_sentences.hpp"

#include "protocol/nmea/optional_fields.hpp"
#include "protocol/nmea/ranged_fields.hpp"

namespace skerry::nmea {
namespace {

constexpr Range kDistanceRun{0.0, 999'999.999};
constexpr Range kDrift{0.0, 100.0};

}  // namespace

std::string encode(const Vlw& vlw, std::string_view talker) {
  SentenceWriter out('$', talker, "VLW");
  for (const auto& distance :
       {vlw.water_total_nm, vlw.water_trip_nm, vlw.ground_total_nm, vlw.ground_trip_nm}) {
    add_number(out, distance, 3, kDistanceRun).letter('N');
  }
  return out.finish();
}

Result<Vlw, WireError> decode_vlw(const Sentence& sentence) {
  FieldReader in(sentence);
  const auto distance = [&](std::size_t index) {
    return in.number_in(index, 'N', kDistanceRun.min, kDistanceRun.max);
  };
  Vlw vlw;
  vlw.water_total_nm = distance(0);
  vlw.water_trip_nm = distance(2);
  vlw.ground_total_nm = distance(4);
  vlw.ground_trip_nm = distance(6);
  return answer(in, vlw);
}

std::string encode(const Vdr& vdr, std::string_view talker) {
  SentenceWriter out('$', talker, "VDR");
  optional_angle(out, vdr.set_deg, 1).letter('T').empty().letter('M');
  return add_number(out, vdr.drift_kn, 2, kDrift).letter('N').finish();
}

Result<Vdr, WireError> decode_vdr(const Sentence& sentence) {
  FieldReader in(sentence);
  Vdr vdr;
  vdr.set_deg = in.number_in(0, 'T', kAnyBearing.min, kAnyBearing.max);
  vdr.drift_kn = in.number_in(4, 'N', kDrift.min, kDrift.max);
  return answer(in, vdr);
}

}  // namespace skerry::nmea

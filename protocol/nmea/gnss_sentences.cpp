#include "protocol/nmea/gnss_sentences.hpp"

#include <algorithm>

#include "protocol/nmea/optional_fields.hpp"
#include "protocol/nmea/ranged_fields.hpp"

namespace skerry::nmea {
namespace {

constexpr std::size_t kMostSystems = 6, kDatumCode = 3;
constexpr unsigned kMostSatellites = 99;
constexpr Range kDilution{0.0, 99.9};
constexpr Range kAntennaAltitude{-999.9, 99'999.9};
constexpr Range kGeoidSeparation{-999.9, 999.9};
constexpr Range kDatumHeight{-9999.9, 9999.9};
constexpr double kMostDatumMinutes = 59.9999;

std::string modes_field(FieldReader& in, std::size_t index) {
  const std::string_view field = in.text(index);
  if (field.size() > kMostSystems ||
      field.find_first_not_of("ADEFMNPRS") != std::string_view::npos) {
    in.fail(index, "at most six of the letters ADEFMNPRS");
  }
  return std::string(field);
}

std::string datum_field(FieldReader& in, std::size_t index) {
  const std::string_view field = in.text(index);
  if (field.size() > kDatumCode) in.fail(index, "at most three characters");
  return std::string(field);
}

}  // namespace

std::string encode(const Gns& gns, std::string_view talker) {
  SentenceWriter out('$', talker, "GNS");
  optional_position(optional_time(out, gns.time_of_day), gns.position);
  out.text(gns.modes, kMostSystems).whole(std::min(gns.satellites, kMostSatellites), 2);
  add_number(out, gns.dilution, 1, kDilution);
  add_number(out, gns.altitude_m, 1, kAntennaAltitude);
  add_number(out, gns.geoid_m, 1, kGeoidSeparation);
  // No differential corrections.
  return out.empty().empty().letter(gns.navigation_status).finish();
}

Result<Gns, WireError> decode_gns(const Sentence& sentence) {
  FieldReader in(sentence);
  Gns gns;
  gns.time_of_day = in.time(0);
  gns.position = in.position(1);
  gns.modes = modes_field(in, 5);
  gns.satellites = in.whole(6, 0, kMostSatellites).value_or(0);
  gns.dilution = read_number(in, 7, kDilution);
  gns.altitude_m = read_number(in, 8, kAntennaAltitude);
  gns.geoid_m = read_number(in, 9, kGeoidSeparation);
  gns.navigation_status = read_one_of(in, 12, "SCUV").value_or('V');
  return answer(in, std::move(gns));
}

std::string encode(const Dtm& dtm, std::string_view talker) {
  SentenceWriter out('$', talker, "DTM");
  out.text(dtm.local, kDatumCode).letter(dtm.subdivision);
  add_sided(out, dtm.north_min, 4, kMostDatumMinutes, 'N', 'S');
  add_sided(out, dtm.east_min, 4, kMostDatumMinutes, 'E', 'W');
  return add_number(out, dtm.up_m, 1, kDatumHeight).text(dtm.reference, kDatumCode).finish();
}

Result<Dtm, WireError> decode_dtm(const Sentence& sentence) {
  FieldReader in(sentence);
  Dtm dtm;
  dtm.local = datum_field(in, 0);
  dtm.subdivision = in.letter(1);
  dtm.north_min = read_sided(in, 2, kMostDatumMinutes, 'N', 'S');
  dtm.east_min = read_sided(in, 4, kMostDatumMinutes, 'E', 'W');
  dtm.up_m = read_number(in, 6, kDatumHeight);
  dtm.reference = datum_field(in, 7);
  return answer(in, std::move(dtm));
}

}  // namespace skerry::nmea

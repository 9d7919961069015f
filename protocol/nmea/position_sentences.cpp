#include "protocol/nmea/position_sentences.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "protocol/nmea/field_reader.hpp"
#include "protocol/nmea/optional_fields.hpp"
#include "protocol/nmea/ranged_fields.hpp"

namespace skerry::nmea {
namespace {

using std::chrono::days;
using std::chrono::year_month_day;

year_month_day date_of(UtcTime utc) { return year_month_day(std::chrono::floor<days>(utc)); }

constexpr Range kGroundSpeed{0.0, kMostSpeedKn};

bool is_valid_mode(char mode) { return mode == 'A' || mode == 'D'; }

std::optional<UtcTime> utc_of(std::optional<Duration> of_day, year_month_day date) {
  if (!of_day || !date.ok()) return std::nullopt;
  return UtcTime(std::chrono::sys_days(date)) + *of_day;
}

// ddmmyy, years 80 .. 79 of this century or the last.
std::optional<year_month_day> date_field(FieldReader& in, std::size_t index) {
  const std::string_view field = in.text(index);
  if (field.empty()) return std::nullopt;
  const bool digits =
      field.size() == 6 && field.find_first_not_of("0123456789") == std::string_view::npos;
  const auto pair = [&](std::size_t at) { return (field[at] - '0') * 10 + field[at + 1] - '0'; };
  const int year = digits ? pair(4) : 0;
  const auto date = year_month_day(std::chrono::year(year < 80 ? 2000 + year : 1900 + year),
                                   std::chrono::month(digits ? static_cast<unsigned>(pair(2)) : 0),
                                   std::chrono::day(digits ? static_cast<unsigned>(pair(0)) : 0));
  if (!date.ok()) {
    in.fail(index, "a date as ddmmyy");
    return std::nullopt;
  }
  return date;
}

}  // namespace

Duration time_of_day(UtcTime utc) { return utc - std::chrono::floor<days>(utc); }

std::string encode(const Rmc& rmc, std::string_view talker) {
  SentenceWriter out('$', talker, "RMC");
  optional_time(out, rmc.utc ? std::optional(time_of_day(*rmc.utc)) : std::nullopt);
  out.letter(is_valid_mode(rmc.mode) && rmc.valid ? 'A' : 'V');
  optional_position(out, rmc.position);
  add_number(out, rmc.speed_kn, 2, kGroundSpeed);
  optional_angle(out, rmc.course_deg, 1);
  if (rmc.utc) {
    const year_month_day date = date_of(*rmc.utc);
    out.text(fmt::format("{:02}{:02}{:02}", static_cast<unsigned>(date.day()),
                         static_cast<unsigned>(date.month()), static_cast<int>(date.year()) % 100));
  } else {
    out.empty();
  }
  // No magnetic variation; of navigational status nothing is said.
  return out.empty().empty().letter(rmc.mode).letter('V').finish();
}

Result<Rmc, WireError> decode_rmc(const Sentence& sentence) {
  FieldReader in(sentence);
  Rmc rmc;
  const auto of_day = in.time(0);
  const auto date = date_field(in, 8);
  if (date) rmc.utc = utc_of(of_day, *date);
  rmc.valid = in.letter(1) == 'A';
  rmc.position = in.position(2);
  rmc.speed_kn = in.number(6, 0, kMostSpeedKn);
  rmc.course_deg = in.number(7, 0, 360);
  const char mode = in.letter(11);
  if (mode != '\0') rmc.mode = mode;  // before NMEA 2.3 there was none
  if (rmc.mode == 'N') rmc.valid = false;
  return answer(in, rmc);
}

std::string encode(const Gga& gga, std::string_view talker) {
  SentenceWriter out('$', talker, "GGA");
  optional_time(out, gga.time_of_day);
  optional_position(out, gga.position);
  out.whole(std::min(gga.quality, 9u)).whole(std::min(gga.satellites, 99u), 2);
  add_number(out, gga.dilution, 1, {0.0, 99.9});
  return add_number(out, gga.altitude_m, 1, {-9999.9, 99999.9})
      .letter('M')
      .number(0, 1)
      .letter('M')
      .empty()
      .empty()
      .finish();
}

Result<Gga, WireError> decode_gga(const Sentence& sentence) {
  FieldReader in(sentence);
  Gga gga;
  gga.time_of_day = in.time(0);
  gga.position = in.position(1);
  gga.quality = in.whole(5, 0, 9).value_or(0);
  gga.satellites = in.whole(6, 0, 99).value_or(0);
  gga.dilution = in.number(7, 0, 1e6).value_or(0);
  gga.altitude_m = in.number_in(8, 'M', -1e5, 1e5).value_or(0);
  return answer(in, gga);
}

std::string encode(const Gll& gll, std::string_view talker) {
  SentenceWriter out('$', talker, "GLL");
  optional_time(optional_position(out, gll.position), gll.time_of_day);
  return add_status(out, is_valid_mode(gll.mode) && gll.valid).letter(gll.mode).finish();
}

Result<Gll, WireError> decode_gll(const Sentence& sentence) {
  FieldReader in(sentence);
  Gll gll;
  gll.position = in.position(0);
  gll.time_of_day = in.time(4);
  const char status = in.letter(5), mode = in.letter(6);
  gll.valid = status == 'A' || status == '\0';
  if (mode != '\0') gll.mode = mode;
  if (gll.mode == 'N') gll.valid = false;
  return answer(in, gll);
}

std::string encode(const Vtg& vtg, std::string_view talker) {
  SentenceWriter out('$', talker, "VTG");
  optional_angle(out, vtg.course_deg, 1).letter('T').empty().letter('M');
  add_number(out, vtg.speed_kn, 2, kGroundSpeed).letter('N');
  const auto speed_kn = within(vtg.speed_kn, kGroundSpeed);
  if (speed_kn) {
    out.number(*speed_kn * kKmhPerKnot, 2);
  } else {
    out.empty();
  }
  return out.letter('K').letter(vtg.mode).finish();
}

Result<Vtg, WireError> decode_vtg(const Sentence& sentence) {
  FieldReader in(sentence);
  Vtg vtg;
  vtg.course_deg = in.number_in(0, 'T', 0, 360);
  vtg.speed_kn = in.number_in(4, 'N', 0, kMostSpeedKn);
  const char mode = in.letter(8);
  if (mode != '\0') vtg.mode = mode;
  return answer(in, vtg);
}

std::string encode(const Zda& zda, std::string_view talker) {
  SentenceWriter out('$', talker, "ZDA");
  if (!zda.utc) return out.empty().empty().empty().empty().empty().empty().finish();
  const year_month_day date = date_of(*zda.utc);
  out.time(time_of_day(*zda.utc));
  out.whole(static_cast<unsigned>(date.day()), 2).whole(static_cast<unsigned>(date.month()), 2);
  // Local time is UTC: on board it is what the clocks are set to, which nobody knows.
  return out.whole(static_cast<unsigned>(static_cast<int>(date.year())), 4)
      .whole(0, 2)
      .whole(0, 2)
      .finish();
}

Result<Zda, WireError> decode_zda(const Sentence& sentence) {
  FieldReader in(sentence);
  const auto of_day = in.time(0);
  const auto day = in.whole(1, 1, 31), month = in.whole(2, 1, 12), year = in.whole(3, 1970, 2200);
  Zda zda;
  if (day && month && year) {
    const year_month_day date(std::chrono::year(static_cast<int>(*year)),
                              std::chrono::month(*month), std::chrono::day(*day));
    if (!date.ok()) in.fail(1, "a day of that month");
    zda.utc = utc_of(of_day, date);
  }
  return answer(in, zda);
}

}  // namespace skerry::nmea

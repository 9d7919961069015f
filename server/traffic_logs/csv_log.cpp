#include "server/traffic_logs/csv_log.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "protocol/nmea/log_time.hpp"

namespace skerry::server {
namespace {

constexpr std::size_t kMostFields = 256;

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

// Small letters and digits alone: "# Timestamp" and "base_date_time" as one word each.
std::string bare(std::string_view text) {
  std::string word;
  for (const char each : text) {
    const char c = lower(each);
    if ((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9')) word += c;
  }
  return word;
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t' || text.back() == '\r')) {
    text.remove_suffix(1);
  }
  return text;
}

void split(std::string_view row, char separator, std::vector<std::string>& fields) {
  fields.clear();
  std::string field;
  bool quoted = false;
  for (std::size_t i = 0; i < row.size(); ++i) {
    const char c = row[i];
    if (quoted && c == '"' && i + 1 < row.size() && row[i + 1] == '"') {
      field += '"';
      ++i;
    } else if (c == '"') {
      quoted = !quoted;
    } else if (c == separator && !quoted) {
      fields.emplace_back(trimmed(field));
      if (fields.size() >= kMostFields) return;
      field.clear();
    } else {
      field += c;
    }
  }
  fields.emplace_back(trimmed(field));
}

std::string_view without_mark(std::string_view text) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  return text;
}

// "57.5"; "57,5" where fields end otherwise.
std::optional<double> number_of(std::string_view text) {
  std::string plain(text);
  std::replace(plain.begin(), plain.end(), ',', '.');
  double value = 0.0;
  const auto [end, error] = std::from_chars(plain.data(), plain.data() + plain.size(), value);
  if (error != std::errc() || end != plain.data() + plain.size() || plain.empty()) {
    return std::nullopt;
  }
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

std::optional<double> angle_of(std::optional<double> degrees) {
  if (!degrees || *degrees < 0.0 || *degrees > 360.0) return std::nullopt;  // 511: not available
  return *degrees == 360.0 ? 0.0 : *degrees;
}

// AIS types of ships by the words of the Danish Maritime Authority; else by their number.
unsigned type_of(std::string_view text) {
  struct Word {
    std::string_view word;
    unsigned type;
  };
  static constexpr std::array<Word, 20> kWords = {
      {{"fishing", 30},    {"towing", 31},        {"towinglongwide", 32},
       {"dredging", 33},   {"diving", 34},        {"military", 35},
       {"sailing", 36},    {"pleasure", 37},      {"hsc", 40},
       {"pilot", 50},      {"sar", 51},           {"tug", 52},
       {"porttender", 53}, {"antipollution", 54}, {"lawenforcement", 55},
       {"medical", 58},    {"passenger", 60},     {"cargo", 70},
       {"tanker", 80},     {"other", 90}}};
  if (const auto number = number_of(text)) {
    return *number >= 1.0 && *number <= 99.0 ? static_cast<unsigned>(*number) : 0;
  }
  const std::string word = bare(text);
  for (const Word& each : kWords) {
    if (each.word == word) return each.type;
  }
  return 0;
}

// Where the row says that it is no ship's.
std::optional<LeftOut> other_by_word(const std::string& word) {
  if (word == "basestation") return LeftOut::base_station;
  if (word == "aton") return LeftOut::aid;
  if (word == "sarairborne") return LeftOut::aircraft;
  if (word == "searchandrescuetransponder" || word == "sart" || word == "manoverboarddevice") {
    return LeftOut::distress;
  }
  return std::nullopt;
}

std::optional<bool> class_b_of(const std::string& word) {
  if (word == "a" || word == "classa") return false;
  if (word == "b" || word == "classb") return true;
  return std::nullopt;
}

}  // namespace

bool CsvLog::is_header(std::string_view row) {
  row = without_mark(row);
  if (row.find_first_of(",;\t") == std::string_view::npos) return false;
  std::string small;
  for (const char c : row) small += lower(c);
  return small.find("mmsi") != std::string::npos;
}

Result<CsvLog, std::string> CsvLog::open(std::string_view header, TrackBook& book) {
  struct Name {
    std::string_view name;
    Column column;
  };
  static constexpr std::array<Name, 42> kNames = {{
      {"mmsi", mmsi},
      {"time", time},
      {"timestamp", time},
      {"basedatetime", time},
      {"datetime", time},
      {"datetimeutc", time},
      {"utc", time},
      {"unixtime", time},
      {"t", time},
      {"lat", latitude},
      {"latitude", latitude},
      {"lon", longitude},
      {"long", longitude},
      {"lng", longitude},
      {"longitude", longitude},
      {"cog", course},
      {"course", course},
      {"courseoverground", course},
      {"heading", heading},
      {"trueheading", heading},
      {"hdg", heading},
      {"name", name},
      {"vesselname", name},
      {"shipname", name},
      {"type", type},
      {"shiptype", type},
      {"vesseltype", type},
      {"length", length},
      {"beam", beam},
      {"width", beam},
      {"breadth", beam},
      {"class", ais_class},
      {"aisclass", ais_class},
      {"transceiver", ais_class},
      {"transceiverclass", ais_class},
      {"typeofmobile", ais_class},
      {"a", to_bow},
      {"b", to_stern},
      // Port and starboard are alike here: only their sum is used.
      {"c", to_port},
      {"d", to_starboard},
      {"sizea", to_bow},
      {"sizeb", to_stern},
  }};
  header = without_mark(header);
  char separator = ',';
  for (const char each : {';', '\t'}) {
    if (std::count(header.begin(), header.end(), each) >
        std::count(header.begin(), header.end(), separator)) {
      separator = each;
    }
  }
  CsvLog log(book, separator);
  split(header, separator, log.fields_);
  for (std::size_t place = 0; place < log.fields_.size(); ++place) {
    const std::string word = bare(log.fields_[place]);
    for (const Name& each : kNames) {
      if (each.name == word && !log.places_[each.column]) log.places_[each.column] = place;
    }
  }
  static constexpr std::array<std::pair<Column, std::string_view>, 4> kNeeded = {
      {{mmsi, "mmsi"}, {time, "time"}, {latitude, "lat"}, {longitude, "lon"}}};
  for (const auto& [column, word] : kNeeded) {
    if (!log.places_[column]) {
      return Failure{"the table has no column \"" + std::string(word) +
                     "\"; expected are mmsi, time, lat and lon by these or other known names"};
    }
  }
  return log;
}

std::string_view CsvLog::field(Column column) const {
  const auto place = places_[column];
  return place && *place < fields_.size() ? std::string_view(fields_[*place]) : std::string_view();
}

std::optional<double> CsvLog::number(Column column) const { return number_of(field(column)); }

double CsvLog::size_of(Column whole, Column one, Column other) const {
  const double said = number(whole).value_or(0.0);
  return std::max(said > 0.0 ? said : number(one).value_or(0.0) + number(other).value_or(0.0), 0.0);
}

void CsvLog::take(std::string_view row) {
  if (trimmed(row).empty()) return;
  split(row, separator_, fields_);
  LeftOutCounts& left_out = book_->left_out();
  const std::string kind = bare(field(ais_class));
  if (const auto other = other_by_word(kind)) return left_out.add(*other);
  const auto number_said = number(mmsi);
  const auto lat = number(latitude), lon = number(longitude);
  const bool no_place = field(latitude).empty() && field(longitude).empty();
  if (!number_said || ((!lat || !lon) && !no_place)) return left_out.add(LeftOut::bad_row);
  if (*number_said < 0.0 || *number_said > 999'999'999.0) return left_out.add(LeftOut::bad_mmsi);
  const auto utc = nmea::log_time_of(field(time));
  if (!utc && !field(time).empty()) return left_out.add(LeftOut::bad_row);
  ++rows_;
  HeardFix fix{.mmsi = static_cast<std::uint32_t>(*number_said), .utc = utc};
  if (lat && lon && std::fabs(*lat) <= 90.0 && std::fabs(*lon) <= 180.0) {
    fix.position = GeoPoint{*lat, *lon};
  }
  fix.heading_deg = angle_of(number(heading));
  fix.course_deg = angle_of(number(course));
  fix.class_b = class_b_of(kind);
  HeardIdentity identity{.mmsi = fix.mmsi};
  identity.name = std::string(field(name));
  identity.ship_type = type_of(field(type));
  identity.length_m = size_of(length, to_bow, to_stern);
  identity.beam_m = size_of(beam, to_port, to_starboard);
  book_->take(fix);
  const bool says_more = !identity.name.empty() || identity.ship_type != 0 ||
                         identity.length_m > 0.0 || identity.beam_m > 0.0;
  if (says_more && book_->knows(fix.mmsi)) book_->take(identity);
}

}  // namespace skerry::server

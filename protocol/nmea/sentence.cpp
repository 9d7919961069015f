#include "protocol/nmea/sentence.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace skerry::nmea {
namespace {

constexpr std::size_t kFrame = 6;  // start, "*hh", CR, LF

// Reserved characters are no part of a field: IEC 61162-1 table 1.
constexpr std::string_view kReserved = "$*,!\\^~";

bool is_field_character(char c) {
  return c >= ' ' && c < '\x7F' && kReserved.find(c) == std::string_view::npos;
}

bool is_address_character(char c) { return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9'); }

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  return -1;
}

// Degrees and minutes, the minutes with `decimals`.
std::string angle_text(double degrees, int degree_digits, int decimals) {
  long long minute = 1;
  for (int i = 0; i < decimals; ++i) minute *= 10;
  const long long degree = 60 * minute;
  const long long units = std::llround(std::abs(degrees) * static_cast<double>(degree));
  const long long rest = units % degree;
  return fmt::format("{:0{}}{:02}.{:0{}}", units / degree, degree_digits, rest / minute,
                     rest % minute, decimals);
}

}  // namespace

std::uint8_t checksum_of(std::string_view between) {
  std::uint8_t sum = 0;
  for (const char c : between) sum = static_cast<std::uint8_t>(sum ^ static_cast<std::uint8_t>(c));
  return sum;
}

std::string checksum_text(std::string_view between) {
  return fmt::format("{:02X}", checksum_of(between));
}

Result<Sentence, WireError> parse_sentence(std::string_view line) {
  while (!line.empty() && (line.back() == '\r' || line.back() == '\n' || line.back() == ' ')) {
    line.remove_suffix(1);
  }
  if (line.size() > kMaxReadSentence) {
    return failure(
        WireErrorKind::oversized, kMaxReadSentence,
        fmt::format("a sentence of {} characters; {} are read", line.size(), kMaxReadSentence));
  }
  if (line.empty() || (line[0] != '$' && line[0] != '!')) {
    return failure(WireErrorKind::malformed, 0, "a sentence begins with '$' or '!'");
  }
  const std::size_t star = line.rfind('*');
  if (star == std::string_view::npos || star + 3 != line.size()) {
    return failure(WireErrorKind::truncated, line.size(),
                   "a sentence ends with '*' and a checksum");
  }
  const std::string_view between = line.substr(1, star - 1);
  const int high = hex_digit(line[star + 1]), low = hex_digit(line[star + 2]);
  if (high < 0 || low < 0 || high * 16 + low != checksum_of(between)) {
    return failure(WireErrorKind::malformed, star + 1,
                   fmt::format("the checksum is wrong: it should be {}", checksum_text(between)));
  }
  Sentence sentence{.start = line[0]};
  const std::size_t comma = std::min(between.find(','), between.size());
  const std::string_view address = between.substr(0, comma);
  if (address.size() < 4 || !std::all_of(address.begin(), address.end(), is_address_character)) {
    return failure(WireErrorKind::malformed, 1,
                   "a sentence's address is of at least four capital letters and digits");
  }
  const std::size_t talker = address[0] == 'P' && address.size() != 5 ? 1 : 2;
  sentence.talker = address.substr(0, talker);
  sentence.formatter = address.substr(talker);
  for (std::size_t at = comma; at < between.size();) {
    const std::size_t end = std::min(between.find(',', at + 1), between.size());
    sentence.fields.push_back(between.substr(at + 1, end - at - 1));
    at = end;
  }
  // '^' begins an escaped character, which a field may have.
  for (std::size_t i = comma; i < between.size(); ++i) {
    const char c = between[i];
    if (c != ',' && c != '^' && !is_field_character(c)) {
      return failure(WireErrorKind::malformed, i + 1, "a character that no field may have");
    }
  }
  return sentence;
}

SentenceWriter::SentenceWriter(char start, std::string_view talker, std::string_view formatter)
    : start_(start) {
  between_.append(talker).append(formatter);
}

SentenceWriter& SentenceWriter::empty() {
  between_ += ',';
  return *this;
}

SentenceWriter& SentenceWriter::letter(char letter) {
  between_ += ',';
  if (letter != '\0') between_ += letter;
  return *this;
}

SentenceWriter& SentenceWriter::text(std::string_view text, std::size_t most) {
  between_ += ',';
  for (const char c : text.substr(0, most)) between_ += is_field_character(c) ? c : ' ';
  return *this;
}

SentenceWriter& SentenceWriter::number(double value, int decimals) {
  if (!std::isfinite(value)) return empty();
  std::string text = fmt::format("{:.{}f}", value, decimals);
  if (text[0] == '-' && text.find_first_not_of("-0.") == std::string::npos) text.erase(0, 1);
  between_ += ',';
  between_ += text;
  return *this;
}

SentenceWriter& SentenceWriter::whole(std::uint64_t value, int digits) {
  between_ += fmt::format(",{:0{}}", value, digits);
  return *this;
}

SentenceWriter& SentenceWriter::angle(double degrees, int decimals) {
  if (!std::isfinite(degrees)) return empty();
  const double scale = std::pow(10.0, decimals);
  double units = std::fmod(std::round(degrees * scale), 360.0 * scale);
  if (units < 0) units += 360.0 * scale;
  return number(units / scale, decimals);
}

SentenceWriter& SentenceWriter::position(GeoPoint point, int decimals) {
  if (!std::isfinite(point.latitude_deg) || !std::isfinite(point.longitude_deg)) {
    return empty().empty().empty().empty();
  }
  const double latitude = std::clamp(point.latitude_deg, -90.0, 90.0);
  const double longitude = std::remainder(point.longitude_deg, 360.0);
  between_ +=
      fmt::format(",{},{},{},{}", angle_text(latitude, 2, decimals), latitude < 0 ? 'S' : 'N',
                  angle_text(longitude, 3, decimals), longitude < 0 ? 'W' : 'E');
  return *this;
}

SentenceWriter& SentenceWriter::time(Duration of_day) {
  const long long hundredths =
      std::chrono::duration_cast<std::chrono::milliseconds>(of_day).count() / 10;
  between_ += fmt::format(",{:02}{:02}{:02}.{:02}", hundredths / 360'000 % 24,
                          hundredths / 6'000 % 60, hundredths / 100 % 60, hundredths % 100);
  return *this;
}

std::size_t SentenceWriter::room(std::size_t after) const {
  const std::size_t used = between_.size() + 1 + kFrame + after;  // 1: this field's comma
  return used < kMaxSentence ? kMaxSentence - used : 0;
}

std::string SentenceWriter::finish() const {
  return start_ + between_ + '*' + checksum_text(between_) + "\r\n";
}

}  // namespace skerry::nmea

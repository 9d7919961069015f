#include "protocol/nmea/field_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace skerry::nmea {
namespace {

constexpr std::size_t kMostDigits = 24;

bool are_digits(std::string_view text) {
  return !text.empty() && text.find_first_not_of("0123456789") == std::string_view::npos;
}

// Digits with at most one point, and a digit before or after it.
std::optional<double> unsigned_number(std::string_view text) {
  if (text.empty() || text.size() > kMostDigits ||
      text.find_first_not_of("0123456789.") != std::string_view::npos) {
    return std::nullopt;
  }
  double value = 0.0;
  const auto [end, error] =
      std::from_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::optional<double> signed_number(std::string_view text) {
  const bool negative = text.starts_with('-');
  if (negative || text.starts_with('+')) text.remove_prefix(1);
  const auto value = unsigned_number(text);
  return value && negative ? -*value : value;
}

}  // namespace

std::string_view FieldReader::text(std::size_t index) const {
  return index < sentence_.fields.size() ? sentence_.fields[index] : std::string_view{};
}

void FieldReader::fail(std::size_t index, const std::string& expected) {
  if (error_) return;
  // The field's offset in the line: fields are views into it, as the talker is.
  const std::size_t offset =
      index < sentence_.fields.size()
          ? static_cast<std::size_t>(sentence_.fields[index].data() - sentence_.talker.data()) + 1
          : 0;
  error_ = WireError{WireErrorKind::malformed, offset,
                     fmt::format("{} field {} is \"{}\"; {} was expected", sentence_.formatter,
                                 index + 1, text(index), expected)};
}

char FieldReader::letter(std::size_t index) {
  const std::string_view field = text(index);
  if (field.size() > 1) fail(index, "one letter");
  return field.size() == 1 ? field[0] : '\0';
}

std::optional<double> FieldReader::number(std::size_t index, double min, double max) {
  const std::string_view field = text(index);
  if (field.empty()) return std::nullopt;
  const auto value = signed_number(field);
  if (!value || *value < min || *value > max) {
    fail(index, fmt::format("a number from {} to {}", min, max));
    return std::nullopt;
  }
  return value;
}

std::optional<unsigned> FieldReader::whole(std::size_t index, unsigned min, unsigned max) {
  const std::string_view field = text(index);
  if (field.empty()) return std::nullopt;
  unsigned value = 0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (error != std::errc{} || end != field.data() + field.size() || value < min || value > max) {
    fail(index, fmt::format("a whole number from {} to {}", min, max));
    return std::nullopt;
  }
  return value;
}

std::optional<double> FieldReader::number_in(std::size_t index, char unit, double min, double max) {
  const auto value = number(index, min, max);
  return letter(index + 1) == unit ? value : std::nullopt;
}

std::optional<double> FieldReader::degrees_and_minutes(std::size_t index, std::size_t degree_digits,
                                                       double most, std::string_view signs) {
  const std::string_view field = text(index);
  if (field.empty()) return std::nullopt;
  const char side = letter(index + 1);
  // Minutes have two digits before the point; what stands before them are degrees, of which some
  // devices leave out leading zeros ("516.0606" is 5 deg 16.0606 min).  At least one digit of
  // degrees: "16.06" could be either.
  const std::size_t point = std::min(field.find('.'), field.size());
  const std::size_t split = point >= 3 && point <= degree_digits + 2 ? point - 2 : 0;
  const std::string_view degrees = field.substr(0, split);
  const std::string_view minute_text = field.substr(split);
  const double whole = split > 0 && are_digits(degrees) ? *unsigned_number(degrees) : -1.0;
  const bool two_digits = minute_text.size() >= 2 && are_digits(minute_text.substr(0, 2));
  const double minutes = two_digits ? unsigned_number(minute_text).value_or(-1.0) : -1.0;
  if (whole < 0.0 || minutes < 0.0 || minutes >= 60.0) {
    fail(index, "degrees and minutes");
    return std::nullopt;
  }
  if (side == '\0' || signs.find(side) == std::string_view::npos) {
    fail(index + 1, fmt::format("{} or {}", signs[0], signs[1]));
    return std::nullopt;
  }
  const double value = whole + minutes / 60.0;
  if (value > most) {
    fail(index, fmt::format("at most {} degrees", most));
    return std::nullopt;
  }
  return side == signs[1] ? -value : value;
}

std::optional<GeoPoint> FieldReader::position(std::size_t index) {
  const auto latitude = degrees_and_minutes(index, 2, 90.0, "NS");
  const auto longitude = degrees_and_minutes(index + 2, 3, 180.0, "EW");
  if (!latitude || !longitude) return std::nullopt;
  return GeoPoint{*latitude, wrapped_longitude(*longitude)};
}

std::optional<Duration> FieldReader::time(std::size_t index) {
  const std::string_view field = text(index);
  if (field.empty()) return std::nullopt;
  const auto seconds = field.size() >= 6 ? unsigned_number(field.substr(4)) : std::nullopt;
  if (field.size() < 6 || !are_digits(field.substr(0, 6)) || !seconds || *seconds >= 61.0) {
    fail(index, "hhmmss.ss");
    return std::nullopt;
  }
  const int hours = (field[0] - '0') * 10 + field[1] - '0';
  const int minutes = (field[2] - '0') * 10 + field[3] - '0';
  if (hours > 23 || minutes > 59) {
    fail(index, "a time of day");
    return std::nullopt;
  }
  return std::chrono::hours(hours) + std::chrono::minutes(minutes) + seconds_as_duration(*seconds);
}

}  // namespace skerry::nmea

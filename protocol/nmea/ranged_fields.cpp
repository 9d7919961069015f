#include "protocol/nmea/ranged_fields.hpp"

#include <fmt/format.h>

#include <cmath>

namespace skerry::nmea {

std::optional<double> within(std::optional<double> value, Range range) {
  if (!value || !(*value >= range.min && *value <= range.max)) return std::nullopt;
  return value;
}

SentenceWriter& add_number(SentenceWriter& out, std::optional<double> value, int decimals,
                           Range range) {
  const auto good = within(value, range);
  return good ? out.number(*good, decimals) : out.empty();
}

std::optional<double> read_number(FieldReader& in, std::size_t index, Range range) {
  return in.number(index, range.min, range.max);
}

SentenceWriter& add_sided(SentenceWriter& out, std::optional<double> value, int decimals,
                          double most, char positive, char negative) {
  const auto good = within(value, {-most, most});
  if (!good) return out.empty().empty();
  return out.number(std::abs(*good), decimals).letter(std::signbit(*good) ? negative : positive);
}

std::optional<double> read_sided(FieldReader& in, std::size_t index, double most, char positive,
                                 char negative) {
  const auto amount = read_number(in, index, {0.0, most});
  const char letters[] = {positive, negative};
  const auto side = read_one_of(in, index + 1, {letters, 2});
  if (!amount) return std::nullopt;
  if (*amount > 0.0 && !side) in.fail(index + 1, fmt::format("{} or {}", positive, negative));
  return side == negative ? -*amount : *amount;
}

SentenceWriter& add_status(SentenceWriter& out, bool valid) {
  return out.letter(valid ? 'A' : 'V');
}

bool read_status(FieldReader& in, std::size_t index) { return read_one_of(in, index, "AV") == 'A'; }

std::optional<char> read_one_of(FieldReader& in, std::size_t index, std::string_view letters) {
  const std::string_view field = in.text(index);
  if (field.empty()) return std::nullopt;
  if (field.size() != 1 || letters.find(field[0]) == std::string_view::npos) {
    in.fail(index, fmt::format("one of the letters {}", letters));
    return std::nullopt;
  }
  return field[0];
}

bool read_is_command(FieldReader& in, std::size_t index) {
  return read_one_of(in, index, "CR") != 'R';
}

char read_mode(FieldReader& in, std::size_t index) {
  // V is none, but is seen.
  return read_one_of(in, index, "ADEFMNPRSV").value_or('A');
}

}  // namespace skerry::nmea

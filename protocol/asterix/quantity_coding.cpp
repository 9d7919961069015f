#include "protocol/asterix/quantity_coding.hpp"

#include <algorithm>
#include <cmath>

#include "protocol/wire/byte_order.hpp"

namespace skerry::asterix {
namespace {

std::optional<std::int64_t> units_of(const QuantityValue& of) {
  const Quantity& quantity = of.quantity;
  if (!std::isfinite(of.value)) return std::nullopt;
  const std::int64_t count = std::int64_t{1} << (8 * quantity.octets);
  if (quantity.is_angle) {
    // Rounded before the turns fall away: just below a turn is 0.
    const double units = std::round(std::remainder(of.value, 360.0) / quantity.unit);
    return static_cast<std::int64_t>(units) & (count - 1);
  }
  const double least = quantity.is_signed ? -static_cast<double>(count / 2) : 0.0;
  const double most = least + static_cast<double>(count - 1);
  double units = std::round(of.value / quantity.unit);
  if (quantity.clamps) units = std::clamp(units, least, most);
  if (units < least || units > most) return std::nullopt;
  return static_cast<std::int64_t>(units);
}

}  // namespace

bool append_quantities(Bytes& out, std::initializer_list<QuantityValue> values) {
  const std::size_t start = out.size();
  for (const QuantityValue& each : values) {
    const auto units = units_of(each);
    if (!units) {
      out.resize(start);
      return false;
    }
    append_big_endian(out, static_cast<std::uint64_t>(*units), each.quantity.octets);
  }
  return true;
}

double quantity_at(std::span<const std::uint8_t> octets, std::size_t at, const Quantity& quantity) {
  std::int64_t units = big_endian_at<std::uint32_t>(octets, at, quantity.octets);
  const std::int64_t count = std::int64_t{1} << (8 * quantity.octets);
  if (quantity.is_signed && units >= count / 2) units -= count;
  return static_cast<double>(units) * quantity.unit;
}

}  // namespace skerry::asterix

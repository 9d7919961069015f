#include "protocol/nmea/demand_fields.hpp"

namespace skerry::nmea {
namespace {

Range range_of(bool in_percent, char unit) {
  if (in_percent) return kPerCent;
  return unit == kSpeedUnit ? kRevolutions : Range{-90.0, 90.0};
}

}  // namespace

SentenceWriter& add_demand(SentenceWriter& out, std::optional<Demand> demand, char unit) {
  const Range range = range_of(!demand || demand->in_percent, unit);
  const auto value = demand ? within(demand->value, range) : std::nullopt;
  if (!value) return out.empty().letter('V');
  return out.number(*value, 1).letter(demand->in_percent ? 'P' : unit);
}

std::optional<Demand> read_demand(FieldReader& in, std::size_t index, char unit) {
  const char letters[] = {'P', unit, 'V'};
  const auto kind = read_one_of(in, index + 1, {letters, 3});
  if (!kind || kind == 'V') return std::nullopt;
  const bool in_percent = kind == 'P';
  const auto value = read_number(in, index, range_of(in_percent, unit));
  if (!value) return std::nullopt;
  return Demand{*value, in_percent};
}

}  // namespace skerry::nmea

#include "server/displays/display_range.hpp"

#include <algorithm>
#include <cmath>

namespace skerry::server {
namespace {

bool is_same(double a_m, double b_m, double share) { return std::abs(a_m - b_m) <= share * b_m; }

}  // namespace

RangeScale scale_holding(double range_m) {
  for (std::size_t i = 0; i < RangeScale::kCount; ++i) {
    const RangeScale scale = *RangeScale::from_index(i);
    if (scale.length().in_metres() * (1.0 + kSameRange) >= range_m) return scale;
  }
  return *RangeScale::from_index(RangeScale::kCount - 1);
}

double nearest_range_m(const DisplayRanges& ranges, double range_m) {
  return *std::min_element(ranges.ranges_m.begin(), ranges.ranges_m.end(), [&](double a, double b) {
    return std::abs(a - range_m) < std::abs(b - range_m);
  });
}

double range_shown_m(const DisplayRanges& ranges, RangeScale scale) {
  const double scale_m = scale.length().in_metres();
  const double nearest_m = nearest_range_m(ranges, scale_m);
  return is_same(nearest_m, scale_m, kSameRange) ? nearest_m : scale_m;
}

std::optional<double> range_of_rows(const DisplayRanges& ranges, const wire::Settings& settings) {
  const double reach_m = settings.instrumented_range_m();
  if (!(reach_m > 0.0)) return std::nullopt;
  const double range_m = nearest_range_m(ranges, reach_m / ranges.span_of_range);
  if (!is_same(range_m * ranges.span_of_range, reach_m, kSameRange)) return std::nullopt;
  return range_m;
}

SpokeSpan spoke_span(const DisplayRanges& ranges, double range_m, RangeScale scale) {
  const double scale_m = scale.length().in_metres();
  const double span_m = std::min(range_m * ranges.span_of_range, 2.0 * scale_m);
  const auto parts = static_cast<std::uint32_t>(std::ceil(scale_m / span_m - 1e-9));
  return {range_m, span_m, std::max(parts, 1u)};
}

SpokeSpan span_of_rows(const DisplayRanges& ranges, RangeScale scale, double reach_m) {
  constexpr double kSameReach = 1e-4;
  const auto candidate = [&](double range_m) -> std::optional<SpokeSpan> {
    const SpokeSpan span = spoke_span(ranges, range_m, scale);
    if (!is_same(span.reach_m(), reach_m, kSameReach)) return std::nullopt;
    return span;
  };
  if (const auto shown = candidate(range_shown_m(ranges, scale))) return *shown;
  for (const double range_m : ranges.ranges_m) {
    if (!(scale_holding(range_m) == scale)) continue;
    if (const auto chosen = candidate(range_m)) return *chosen;
  }
  const double range_m = reach_m / ranges.span_of_range;
  const double nearest_m = nearest_range_m(ranges, range_m);
  return {is_same(nearest_m, range_m, kSameRange) ? nearest_m : range_m, reach_m, 1};
}

}  // namespace skerry::server

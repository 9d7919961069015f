#include "echo/capi/coast.hpp"

#include <algorithm>

#include "echo/capi/call.hpp"

namespace skerry::echo::capi {

std::unique_ptr<CoastPreparer> prepared_around(const SharedChart& chart, const CoastRules& rules,
                                               GeoPoint place, double range_m) {
  // A quarter more than the range and at least 12 NM, so that the ship sails for a while before the
  // chart is read again.
  const double radius = std::max(1.25 * range_m + CoastPreparer::kMaxAnchorDistance,
                                 nautical_miles(12.0).in_metres());
  CoastChart window = chart.load(place, metres(radius));
  return reading_chart(
      [&] { return std::make_unique<CoastPreparer>(std::move(window), place, rules); });
}

void Coast::set_rules(const CoastRules& rules) {
  for (const CoastStyle& style : rules.styles) require_valid(style);
  for (const CoastPlace& place : rules.places) {
    if (place.style) require_valid(*place.style);
  }
  rules_ = rules;
  preparer_ = nullptr;
}

void Coast::refine(GeoPoint place, const RadarResolution& resolution) {
  if (!preparer_ || !preparer_->serves(place, resolution.range_m)) {
    preparer_ = prepared_around(*chart_, rules_, place, resolution.range_m);
  }
  picture_ = preparer_->prepare(place, resolution);
}

const CoastPicture& Coast::picture() const {
  if (!picture_) {
    throw CallError(SKERRY_ECHO_ERROR_STATE,
                    "nothing has been refined: call skerry_echo_coast_refine first");
  }
  return *picture_;
}

}  // namespace skerry::echo::capi

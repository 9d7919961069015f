#include "echo/capi/coast.hpp"

#include <algorithm>

#include "echo/assembly/scene_maker.hpp"
#include "echo/capi/call.hpp"

namespace skerry::echo::capi {

std::unique_ptr<CoastPreparer> prepared_around(const SharedChart& chart, const CoastRules& rules,
                                               GeoPoint place, double range_m) {
  CoastChart window = chart.load(place, chart_window_for(range_m));
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

// Coast: a chart and how its coast is grown; what was refined of it last.
#pragma once

#include <memory>
#include <mutex>

#include "echo/capi/shared_chart.hpp"
#include "echo/scene/coast_picture.hpp"
#include "echo/scene/coast_rules.hpp"

namespace skerry::echo::capi {

// The chart window around a place, laid out for pictures of it.
std::unique_ptr<CoastPreparer> prepared_around(const SharedChart& chart, const CoastRules& rules,
                                               GeoPoint place, double range_m);

// Thread: one at a time, which holds `in_use`.
class Coast {
 public:
  static constexpr std::size_t kMostPlaces = 1000;

  Coast(std::shared_ptr<const SharedChart> chart, std::uint64_t seed) : chart_(std::move(chart)) {
    rules_.seed = seed;
  }

  std::mutex in_use;

  const std::shared_ptr<const SharedChart>& chart() const { return chart_; }
  const CoastRules& rules() const { return rules_; }
  // Coast refined before stays; coast refined next follows `rules`.
  // Error: std::invalid_argument as require_valid() for its styles.
  void set_rules(const CoastRules& rules);

  void refine(GeoPoint place, const RadarResolution& resolution);
  // Error: CallError STATE where nothing was refined yet.
  const CoastPicture& picture() const;

 private:
  std::shared_ptr<const SharedChart> chart_;
  CoastRules rules_;
  std::unique_ptr<CoastPreparer> preparer_;  // of rules_; null: to be made
  CoastPicturePtr picture_;
};

}  // namespace skerry::echo::capi

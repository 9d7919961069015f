// OneRangeRadar: what emulations of radars with one range have in common.
#pragma once

#include <vector>

#include "protocol/video/range_scale.hpp"
#include "server/displays/display_range.hpp"
#include "server/displays/radar_emulation.hpp"

namespace skerry::server {

// A radar that shows range A alone and takes commands at one port, Options::command_port.  Its
// Controls know the ranges it can be set to, ranges(), and the one that settings stand for,
// range_m().
template <typename Options, typename Controls>
class OneRangeRadar : public RadarEmulation {
 public:
  explicit OneRangeRadar(const Options& options) : options_(options) {}

  std::vector<RangeChannel> channels() const override { return {RangeChannel::a}; }
  std::vector<EmulationListen> listens() const override {
    return {{Ipv4Endpoint{0, options_.command_port}}};
  }
  double instrumented_range_m(RangeChannel, const wire::Settings& settings) const override {
    const auto scale = RangeScale::find(settings.range_nm());
    return spoke_span(controls_.ranges(), controls_.range_m(settings), scale.value_or(RangeScale{}))
        .reach_m();
  }

 protected:
  Options options_;
  Controls controls_;
};

}  // namespace skerry::server

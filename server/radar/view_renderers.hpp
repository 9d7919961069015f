// ViewRenderers: what is on the air made once, and received for every view of a radar.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "echo/receiver/view_receiver.hpp"
#include "echo/spoke_returns.hpp"

namespace skerry::server {

// Another range scale or pulse makes returns and receivers anew: what integration and automatic
// controls have learnt is forgotten then.
// Thread: one at a time (the radar's).
class ViewRenderers {
 public:
  // Requires a valid geometry and a set without faults.  No views at first.
  ViewRenderers(const echo::RadarSet& set, const ScanGeometry& geometry,
                const echo::SpokeClock& clock, std::uint32_t radar, RangeScale range,
                const echo::RadarControls& controls, echo::ParallelFor parallel);

  // What is on the air.
  void set_radar(RangeScale range, const echo::RadarControls& controls);

  // `view` is any number of the caller's; a new one is added.  Controls of at most the radar's
  // range scale.
  void set_view(std::uint32_t view, const echo::ViewControls& controls);
  // Keeps only the views for which `is_there` is true.
  template <typename IsThere>
  void keep_views(IsThere is_there) {
    std::erase_if(views_, [&](const auto& entry) { return !is_there(entry.first); });
  }

  // Video of spokes first .. first + count - 1 of every view; count at most
  // echo::SpokeReturns::kMaxSector.
  void render(const echo::Scene& scene, std::uint64_t first, std::uint32_t count);

  // Of a view that is there.
  RangeScale range_of(std::uint32_t view) const;
  std::span<const std::uint8_t> video(std::uint32_t view) const { return views_.at(view).video; }

 private:
  struct View {
    echo::ViewReceiver receiver;
    std::vector<std::uint8_t> video;
  };
  echo::RadarModel model() const;

  echo::RadarSet set_;
  ScanGeometry geometry_;
  echo::SpokeClock clock_;
  std::uint32_t radar_;
  echo::ParallelFor parallel_;
  RangeScale range_;
  echo::RadarControls controls_;
  echo::SpokeReturns returns_;
  std::map<std::uint32_t, View> views_;
};

}  // namespace skerry::server

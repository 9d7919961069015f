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

  // Sets the transmission and the antenna's turning.  A new clock or antenna height makes the
  // returns anew; receivers keep their state.
  void set_radar(RangeScale range, const echo::RadarControls& controls,
                 const echo::SpokeClock& clock);

  // What is wrong with the set; nothing at first.
  void set_faults(const echo::RadarFaults& faults);

  // `view` is any number of the caller's; a new one is added.  Controls of at most the radar's
  // range scale.  Rows reach as far as the view that wants most of them (row_cells_for); others
  // then show the same cells, but for the height of land that the end of the rows cuts.
  void set_view(std::uint32_t view, const echo::ViewControls& controls);
  // Keeps only the views for which `is_there` is true.
  template <typename IsThere>
  void keep_views(IsThere is_there) {
    std::erase_if(views_, [&](const auto& entry) { return !is_there(entry.first); });
  }

  // Video of spokes first .. first + count - 1 of every view; count at most
  // echo::SpokeReturns::kMaxSector.
  void render(const echo::Scene& scene, std::uint64_t first, std::uint32_t count);

  // The range scale of a view that exists.
  RangeScale range_of(std::uint32_t view) const;
  // The end of its last cell; 0 if that is at the range scale.
  Length instrumented_range_of(std::uint32_t view) const;
  std::span<const std::uint8_t> video(std::uint32_t view) const { return views_.at(view).video; }
  // One class per cell of video(), or empty where the view wants none.
  std::span<const DopplerClass> doppler(std::uint32_t view) const {
    return views_.at(view).doppler;
  }

 private:
  struct View {
    echo::ViewReceiver receiver;
    std::vector<std::uint8_t> video;
    std::vector<DopplerClass> doppler = {};
  };
  echo::RadarModel model() const;
  echo::SpokeReturns made_returns() const;
  // Makes the returns anew if the model is another, or the views want rows of another length.
  void fit_returns();

  echo::RadarSet set_;
  ScanGeometry geometry_;
  echo::SpokeClock clock_;
  std::uint32_t radar_;
  echo::ParallelFor parallel_;
  RangeScale range_;
  echo::RadarControls controls_;
  echo::RadarFaults faults_;
  std::uint32_t row_cells_;
  bool returns_fit_ = true;  // they are of the model
  echo::SpokeReturns returns_;
  std::map<std::uint32_t, View> views_;
};

}  // namespace skerry::server

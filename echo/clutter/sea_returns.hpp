// SeaReturns: the echo of the waves.
#pragma once

#include <bitset>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "echo/clutter/sea_field.hpp"
#include "echo/clutter/sea_profile.hpp"
#include "echo/clutter/speckle.hpp"
#include "echo/kernel/aligned_floats.hpp"
#include "echo/radar/radar_model.hpp"
#include "echo/scene/spoke_aim.hpp"

namespace skerry::echo {

// Compound K clutter: mean (SeaProfile: NRL's reflectivity, GIT's wind direction) times texture
// (SeaField bent to the gamma law of the shape law, swell) times speckle.  Power of a cell is that
// of its pulse and beam already: nothing is to be folded with it.
//
// The texture is sampled along bearings a beam width apart, mixed between them with its variance
// kept, and laid every `texture_spokes` spokes; spokes between such rows are joined by straight
// lines. What that costs is measured by tests/bench/error/texture_error.cpp.  A row laid at the end
// of a sector is the first of the next.  Where the plane is anchored anew the texture begins anew.
// Costs nothing at sea state 0 and beyond reach_cells().
class SeaReturns {
 public:
  // texture_spokes: 0 for the power of two that is at most a third of a beam width.
  explicit SeaReturns(const RadarModel& model, std::uint32_t texture_spokes = 0);

  // Lays the texture of spokes first.spoke .. last.spoke, which a sector has tens of, wherever one
  // of them sees water: wet[k] is not 0 where there is any in cells k * kWetCells on; what is not
  // told is water.  Nothing may be added elsewhere.  Thread: the radar's.
  static constexpr std::size_t kWetCells = 64;
  void prepare(const Scene& scene, const SpokeAim& first, const SpokeAim& last,
               std::span<const std::uint8_t> wet = {});

  // What prepare() laid is not added any more: its memory goes to whichever radar is next.  Not
  // needed.  Thread: the radar's.
  void release();

  bool any() const { return profile_->reach() > 0; }
  // Cells from here on have no sea clutter.
  std::uint32_t reach_cells() const { return profile_->reach(); }

  // Adds the clutter of a prepared spoke to power, which holds the radar's cells: to all of them,
  // or to those that are open water, first_cell .. end_cell - 1.  Thread: any, after prepare().
  void add(const SpokeAim& aim, std::span<float> power) const;
  void add(const SpokeAim& aim, std::span<float> power, std::uint32_t first_cell,
           std::uint32_t end_cell) const;

  // Clutter without its speckle: what add() multiplies.  Requires row.size() >= reach_cells().
  void local_mean(const SpokeAim& aim, std::span<float> row) const;
  // The same with the texture made for this very spoke, in double with libm; slow.  After prepare()
  // of this spoke.
  void local_mean_reference(const Scene& scene, const SpokeAim& aim, std::span<double> row);

  std::uint32_t texture_spokes() const { return texture_spokes_; }
  const SeaProfile& profile() const { return *profile_; }

 private:
  // Samples in use, of kSamplesPerLaw.
  static constexpr std::size_t kMostBlocks = Speckle::kLongestRow / kSamplesPerLaw + 1;
  using Blocks = std::bitset<kMostBlocks>;

  // The field along one of the bearings it is sampled at, unit variance.
  struct Node {
    std::uint32_t index = 0;
    std::uint64_t spoke = 0;     // that looks along it
    std::uint64_t used_for = 0;  // spoke of the row laid last with it
    Blocks sampled;
    AlignedFloats values;
  };
  struct Weather {
    Atmosphere atmosphere;
    SeaSurface sea;
    std::uint64_t seed = 0;
  };
  bool unchanged(const Scene& scene) const;
  // The parts of a row of a spoke; refers to nodes_ and looks_.
  struct RowParts {
    TextureMix mix;
    const SeaProfile::Look* look = nullptr;
    double wave_phase = 0.0, wave_step = 0.0;  // turns, and turns per sample
  };
  struct RowPair {
    std::span<const float> first, second;
    float share = 0.0f;
  };
  RowPair rows_about(const SpokeAim& aim) const;
  RowParts parts_of_row(const Scene& scene, const SpokeAim& aim);
  void look_for_water(std::span<const std::uint8_t> wet);
  // Calls use(begin, end) with runs of samples whose blocks are wanted and not yet made.
  template <typename Use>
  void for_missing(const Blocks& wanted, Blocks& made, Use&& use) const;
  void sample_node(const Scene& scene, Node& node);
  void lay_row(const Scene& scene, std::uint64_t spoke, Blocks& laid, std::span<float> row);
  Node& node(const Scene& scene, std::uint32_t index, const SpokeAim& near);
  const SeaProfile::Look& look_towards(std::uint32_t plane_units);
  std::uint32_t node_units(std::uint32_t index) const;

  RadarModel model_;
  std::uint32_t texture_spokes_ = 1, nodes_per_turn_ = 1;
  double clutter_width_;
  std::shared_ptr<const Speckle> speckle_;
  std::uint64_t speckle_key_ = 0;

  std::optional<Weather> weather_;
  std::shared_ptr<const SeaProfile> profile_ = std::make_shared<const SeaProfile>();
  std::optional<SeaField> field_;
  std::vector<Node> nodes_;  // of this sector and, at its end, of the next
  AlignedFloats spare_;      // memory for a node's values
  struct Kept {
    std::uint32_t direction = 0;
    SeaProfile::Look look;
  };
  std::vector<Kept> looks_;
  AlignedFloats octaves_, raw_;
  Blocks wanted_;  // that this sector needs

  std::uint64_t first_row_ = 0;  // its spoke over texture_spokes_
  std::size_t row_count_ = 0;
  std::size_t pitch_ = 0;
  AlignedFloats rows_;        // empty after release()
  AlignedFloats last_row_;    // of them, then
  std::vector<Blocks> laid_;  // of each row
};

}  // namespace skerry::echo

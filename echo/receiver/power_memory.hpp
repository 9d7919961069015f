// PowerMemory: the stages of a receiver that weigh the echo of a spoke against that of others,
// before noise and detector.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "echo/kernel/aligned_floats.hpp"
#include "echo/kernel/power_stages.hpp"
#include "echo/radar/radar_set.hpp"
#include "echo/receiver/controls.hpp"

namespace skerry::echo {

struct PowerStages {
  std::uint32_t reach = 0;  // spokes to either side that a cell is sharpened against; 0: off
  SharpeningLaw law = {1.0f, 0.0f, 0.0f, 0.0f};
  float side_lobe_share = 0.0f;  // of the strongest echo at that range: weaker ones go; 0: off
  float boost = 0.0f;            // by how many times the smallest echoes grow; 0: off
  friend bool operator==(const PowerStages&, const PowerStages&) = default;
};

// Target separation, 0 to 100: a cell's power is multiplied by (power / most)^n, `most` being the
// strongest within half a beam to either side, n from 0 to kMostSharpening: at 100 the two-way
// beam is half as wide.  At most kMostReach spokes to either side.
// Side lobe suppression, 0 to 100: at 50 what lies below the strongest echo that the last turn had
// at that range by the set's side lobes, both ways, goes; kSideLobeSpanDb more at 100, less at 0+.
// Target boost, 0 to 100: up to kMostBoostDb for echoes below kBoostKneeDb over the noise.
inline constexpr double kMostSharpening = 3.0, kSideLobeSpanDb = 12.0, kMostBoostDb = 10.0,
                        kBoostKneeDb = 30.0;
inline constexpr std::uint32_t kMostReach = 48;
PowerStages power_stages(const RadarSet& set, std::uint32_t spokes_per_turn,
                         const ViewControls& controls);

// The memory that one view keeps for these stages: the spokes of half a beam, and the strongest
// echo by range of this turn and the last.  Columns are independent of each other. Thread:
// condition() of different columns at the same time, each column in the order of spokes; the rest
// alone.
class PowerMemory {
 public:
  // A stage loses what it has learnt only when that stage changes.
  void set_up(const PowerStages& stages, std::uint32_t cells, std::uint32_t spokes_per_turn);
  void forget();  // as if no spoke had been

  const PowerStages& stages() const { return stages_; }
  bool any() const {
    return stages_.reach > 0 || stages_.side_lobe_share > 0.0f || stages_.boost > 0.0f;
  }

  // Cells begin .. begin + columns - 1 of spokes first .. first + count - 1.  `rows` holds them and
  // as many of the next spokes as there are, up to stages().reach of which are looked at.
  struct Rows {
    std::span<const float> cells;
    std::size_t pitch;
    std::uint32_t count;  // of rows
  };
  void condition(std::uint64_t first, std::uint32_t count, const Rows& rows, std::size_t begin,
                 std::size_t columns, std::span<float> out, std::size_t out_pitch);
  void end_spokes(std::uint32_t count);

 private:
  void keep_last(std::span<const float* const> rows, std::size_t begin, std::size_t columns);

  PowerStages stages_;
  std::size_t cells_ = 0, pitch_ = 0;
  std::uint32_t spokes_per_turn_ = 1;
  AlignedFloats before_;     // `reach` spokes, oldest first
  std::uint32_t known_ = 0;  // of them, the newest
  AlignedFloats this_turn_, last_turn_;
};

}  // namespace skerry::echo

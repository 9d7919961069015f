// Automatic gain and automatic sea clutter control.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace skerry::echo {

// Looks at the level of bins of range all round, behind the sea control, and sets the threshold
// kOverMedianDb over what half of them stay below: on open water that is gain 50, where noise just
// sparkles; in rain, or amid land, it is less gain, down to kMostDb.  Echoes of ships fill few bins
// and do not move it.  It follows from turn to turn, half of what was and half of what is new, and
// changes where a turn begins.
// Thread: one at a time; const members any.
class AutoGain {
 public:
  static constexpr double kOverMedianDb = 10.0, kLeastDb = 4.0, kMostDb = 16.0;

  // Mean decibels over noise of a bin of range in one spoke.
  void add(double level_db);
  void finish_turn();
  // Forgets a turn begun: the antenna jumped.
  void drop_turn();

  // Over mean noise; kOverMedianDb before the first whole turn.
  double threshold_db() const;

 private:
  static constexpr double kLowestDb = -10.0, kStepDb = 0.25;
  static constexpr std::size_t kClasses = 320;  // to 70 dB

  std::array<std::uint32_t, kClasses> counts_{};
  std::uint64_t bins_ = 0;
  std::optional<double> median_db_;
};

// Learns the level around the ship, by bearing and range: mean decibels of the received power,
// which a few strong echoes hardly move, in kBearings sectors of the turn and bins of kLevelCells
// cells. What it takes off brings surface clutter down to the level of noise, whatever the gain:
//   - the mean of the sector just swept and of this one and the next as they were a turn ago (each
//     half of what it was and half of what was new), smoothed over three bins of range;
//   - no more than kAboveTurnDb over the median of all sectors at that range, so that land on one
//     side is not taken for sea;
//   - never rising with range, nothing beyond kReachNm: clutter falls with range, land and ships
//     do not.
// Levels change at borders of sectors only, so video does not depend on how a turn is cut into
// calls.  Thread: one at a time; const members any.
class AutoSea {
 public:
  static constexpr std::uint32_t kBearings = 64;
  static constexpr double kAboveTurnDb = 6.0;
  static constexpr double kReachNm = 10.0;  // SOURCES.md "Sets": the effect ends at 8 to 10 NM
  static constexpr double kDeadDb = 1.0;    // what is less over noise is noise

  // Range bins wholly within blind_cells are not looked at.  noise_octaves: mean of log2 of noise.
  AutoSea(std::uint32_t spokes_per_turn, std::uint32_t cells, double cell_m,
          std::uint32_t blind_cells, double noise_octaves);

  std::uint32_t bins() const { return bins_; }
  std::uint32_t sector_of(std::uint32_t spoke_in_turn) const;
  std::uint32_t first_spoke_of(std::uint32_t sector) const;  // sector <= kBearings
  // Whether a spoke is looked at: about eight of a sector.
  bool samples(std::uint32_t spoke_in_turn) const;

  // Levels of a sampled spoke (sum_levels, bins() of them), and the end of a sector.
  void add(std::span<const std::int32_t> sums);
  void finish_sector(std::uint32_t sector);
  // Forgets a sector begun: the antenna jumped.
  void drop_sector();

  bool knows(std::uint32_t sector) const;
  // Attenuation by range bin, dB in [0, most_db], `trim_db` more than the above.
  void attenuation(std::uint32_t sector, double trim_db, double most_db,
                   std::span<double> db) const;

 private:
  struct Sector {
    bool known = false;
    std::vector<double> level_db;  // over noise
  };
  void learn_turn();

  std::uint32_t spokes_, bins_, first_bin_, reach_bins_;
  double noise_octaves_;
  std::vector<Sector> sectors_;
  std::vector<double> turn_db_;  // medians; empty before the first whole turn
  std::vector<std::int64_t> sums_;
  std::uint32_t sampled_ = 0;
};

}  // namespace skerry::echo

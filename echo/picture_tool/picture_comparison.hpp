// PictureComparison: two radars' pictures beside each other, in figures and by a classifier.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "echo/picture_tool/made_pictures.hpp"
#include "echo/picture_tool/patch_forest.hpp"
#include "echo/picture_tool/picture_source.hpp"
#include "echo/picture_tool/picture_statistics.hpp"

namespace skerry::echo {

// Figures of one radar's pictures: means over places, and how far single ones lie from them: places
// where there are several, else turns.
struct SpreadStatistics {
  PictureStatistics mean, spread;
  std::size_t places = 0, turns = 0;

  // So little echoes that figures would be those of specks: all but the occupancy are NaN.
  bool empty() const { return mean.occupancy < kLeastShare; }
  static constexpr double kLeastShare = 0.002;
};
SpreadStatistics spread_statistics(std::span<const TurnsOfPicture> places, double beam_deg);

// What the classifier made of two sets, on either view of them.
struct Call {
  std::string name;  // "real | ours"
  std::optional<TellingApart> mask, all;
  std::string why_not;  // where neither is there
};

// The calls of one comparison.  Controls say what a call of two alike sets comes to:
//   real | real   one half of the patches by bearing against the other, begun at four bearings: the
//                 mean; a fold is a quarter of either half
//   ours | ours   every other place against the rest; of one place its halves
//   one | others  each of our places against our others, as the one real place is: the mean
//   null          real and ours with labels shuffled, the mean of 5 to 40 deals
struct Calls {
  Call real_ours, real_real, ours_ours, one_others, null;
  bool leaks = false;  // the null lies outside kNullLeast to kNullMost
};
inline constexpr double kNullLeast = 0.45, kNullMost = 0.55;

// A pure function of its arguments, and takes about a minute for 1500 patches of each.
Calls call_all(std::span<const TurnsOfPicture> real, std::span<const TurnsOfPicture> ours,
               double beam_deg, std::uint64_t seed, const PictureTelling& tell);
// Only the first of them.
Call call_real_ours(std::span<const TurnsOfPicture> real, std::span<const TurnsOfPicture> ours,
                    double beam_deg, std::uint64_t seed);
// One set against another by that name.
Call call_apart(const std::string& name, std::span<const PicturePatch> first,
                std::span<const PicturePatch> second, const TellingRules& rules);

// Patches of the first kPatchTurns turns of each place, numbered from `first_place` on.
inline constexpr std::size_t kPatchTurns = 4;
std::vector<PicturePatch> patches_of_places(std::span<const TurnsOfPicture> places,
                                            std::uint32_t first_place, double beam_deg);

}  // namespace skerry::echo

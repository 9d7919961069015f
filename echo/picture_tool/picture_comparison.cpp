#include "echo/picture_tool/picture_comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace skerry::echo {
namespace {

constexpr std::size_t kStatisticTurns = 8;

std::vector<PictureTurn> turns_of(const TurnsOfPicture& place, double beam_deg, std::size_t most) {
  std::vector<PictureTurn> turns;
  for (std::size_t t = 0; t < std::min(most, place.turns.size()); ++t)
    turns.push_back(place.turn(t, beam_deg));
  return turns;
}

// Those for which `choose` says so, and the others.
template <typename Choose>
std::pair<std::vector<PicturePatch>, std::vector<PicturePatch>> parted(
    std::span<const PicturePatch> patches, const Choose& choose) {
  std::pair<std::vector<PicturePatch>, std::vector<PicturePatch>> parts;
  for (const PicturePatch& p : patches) (choose(p) ? parts.first : parts.second).push_back(p);
  return parts;
}

// Two halves of the turn with as many patches, from `from` eighths of them on; a quarter of either
// half, of neighbouring bearings, is a fold.  Patches of one bearing stay together.
std::pair<std::vector<PicturePatch>, std::vector<PicturePatch>> halves_of(
    std::vector<PicturePatch> patches, std::uint32_t from) {
  std::map<std::uint32_t, double> by_spoke;
  for (const PicturePatch& p : patches) by_spoke[p.spoke] += 1.0;
  std::map<std::uint32_t, std::uint32_t> eighth;
  double before = 0.0;
  for (const auto& [spoke, count] : by_spoke) {
    const double middle = (before + 0.5 * count) / static_cast<double>(patches.size());
    eighth[spoke] = (static_cast<std::uint32_t>(middle * 8.0) + 8 - from) % 8;
    before += count;
  }
  for (PicturePatch& p : patches) {
    p.place = eighth[p.spoke] / 4;
    p.quadrant = eighth[p.spoke] % 4;
  }
  return parted(patches, [](const PicturePatch& p) { return p.place == 0; });
}

// The mean of calls that could be made.
std::optional<TellingApart> mean_of(std::span<const Call> calls,
                                    std::optional<TellingApart> Call::*view) {
  TellingApart mean;
  mean.least = 1.0, mean.most = 0.0;
  double n = 0.0;
  for (const Call& call : calls) {
    const auto& each = call.*view;
    if (!each) continue;
    mean.auc += each->auc, n += 1.0;
    mean.least = std::min(mean.least, each->auc), mean.most = std::max(mean.most, each->auc);
    mean.patches = std::max(mean.patches, each->patches);
    mean.folds = std::max(mean.folds, each->folds);
  }
  if (n == 0.0) return std::nullopt;
  mean.auc /= n;
  return mean;
}

Call mean_call(const std::string& name, std::span<const Call> calls) {
  Call call{name, mean_of(calls, &Call::mask), mean_of(calls, &Call::all), {}};
  if (!call.mask) call.why_not = calls.empty() ? "no other place" : calls.front().why_not;
  return call;
}

// More where chance is greater, so that the mean shows a leak and not chance.
std::uint64_t deals_for(const Call& call) {
  constexpr double kPatchesDealt = 3000.0;
  const auto patches = static_cast<double>(call.mask ? call.mask->patches : 0);
  return patches > 0.0
             ? static_cast<std::uint64_t>(std::clamp(std::ceil(kPatchesDealt / patches), 5.0, 40.0))
             : 1;
}

// One place's patches, one half against the other, begun at four bearings.
Call call_of_halves(const std::string& name, const std::vector<PicturePatch>& patches,
                    std::uint64_t seed) {
  std::vector<Call> each;
  for (std::uint32_t from = 0; from < 4; ++from) {
    const auto halves = halves_of(patches, from);
    each.push_back(call_apart("", halves.first, halves.second, {.seed = seed}));
  }
  return mean_call(name, each);
}

bool is_off(const std::optional<TellingApart>& call) {
  return call && (call->auc < kNullLeast || call->auc > kNullMost);
}

}  // namespace

SpreadStatistics spread_statistics(std::span<const TurnsOfPicture> places, double beam_deg) {
  SpreadStatistics out;
  std::vector<PictureStatistics> by_place, by_turn;
  for (const TurnsOfPicture& place : places) {
    const auto turns = turns_of(place, beam_deg, kStatisticTurns);
    by_place.push_back(picture_statistics(turns, place.follows));
    if (places.size() == 1) {
      for (const PictureTurn& turn : turns) by_turn.push_back(turn_statistics(turn));
    }
    out.turns += turns.size();
  }
  out.places = places.size();
  out.mean = mean_of(by_place);
  out.spread = deviation_of(places.size() == 1 ? by_turn : by_place);
  if (out.empty()) {
    for (const StatisticRow& row : statistic_rows()) {
      if (row.of != &PictureStatistics::occupancy)
        out.mean.*row.of = out.spread.*row.of = std::numeric_limits<double>::quiet_NaN();
    }
  }
  return out;
}

std::vector<PicturePatch> patches_of_places(std::span<const TurnsOfPicture> places,
                                            std::uint32_t first_place, double beam_deg) {
  std::vector<PicturePatch> patches;
  for (const TurnsOfPicture& place : places) {
    const std::uint32_t number = first_place++;
    if (place.spokes < PicturePatch::kSide || place.cells < PicturePatch::kSide) continue;
    for (const PictureTurn& turn : turns_of(place, beam_deg, kPatchTurns)) {
      for (const PicturePatch& p : patches_of(turn, number, kPictureFrom_m)) patches.push_back(p);
    }
  }
  return patches;
}

Call call_apart(const std::string& name, std::span<const PicturePatch> first,
                std::span<const PicturePatch> second, const TellingRules& rules) {
  Call call{name, {}, {}, {}};
  try {
    call.mask = tell_apart(first, second, PatchView::mask, rules);
    call.all = tell_apart(first, second, PatchView::all, rules);
  } catch (const TooFewPatches& few) {
    call.mask.reset();
    call.why_not = fmt::format(
        "too few patches with echoes: {} and {}, of which {} pair up by fold and occupancy; {} "
        "must",
        few.first, few.second, few.matched, kLeastPatches);
  }
  return call;
}

Call call_real_ours(std::span<const TurnsOfPicture> real, std::span<const TurnsOfPicture> ours,
                    double beam_deg, std::uint64_t seed) {
  const auto first = patches_of_places(real, 0, beam_deg);
  const auto second = patches_of_places(ours, static_cast<std::uint32_t>(real.size()), beam_deg);
  return call_apart("real | ours", first, second, {.seed = seed});
}

Calls call_all(std::span<const TurnsOfPicture> real, std::span<const TurnsOfPicture> ours,
               double beam_deg, std::uint64_t seed, const PictureTelling& tell) {
  const auto first = patches_of_places(real, 0, beam_deg);
  const auto ours_from = static_cast<std::uint32_t>(real.size());
  const auto second = patches_of_places(ours, ours_from, beam_deg);
  Calls calls;
  tell("real | ours");
  calls.real_ours = call_apart("real | ours", first, second, {.seed = seed});
  tell("real | real");
  calls.real_real = call_of_halves("real | real", first, seed);
  tell("ours | ours");
  if (ours.size() > 1) {
    const auto halves = parted(second, [](const PicturePatch& p) { return p.place % 2 == 0; });
    calls.ours_ours = call_apart("ours | ours", halves.first, halves.second, {.seed = seed});
  } else {
    calls.ours_ours = call_of_halves("ours | ours", second, seed);
  }
  std::vector<Call> each;
  for (std::uint32_t k = ours_from; ours.size() > 1 && k < ours_from + ours.size(); ++k) {
    tell(fmt::format("one of ours | the others, {} of {}", k - ours_from + 1, ours.size()));
    const auto parts = parted(second, [&](const PicturePatch& p) { return p.place == k; });
    each.push_back(call_apart("", parts.first, parts.second, {.seed = seed}));
  }
  calls.one_others = mean_call("one | others", each);
  each.clear();
  const std::uint64_t deals = deals_for(calls.real_ours);
  for (std::uint64_t deal = 0; deal < deals; ++deal) {
    tell(fmt::format("null, {} of {}", deal + 1, deals));
    each.push_back(call_apart("", first, second, {.seed = seed + deal, .shuffled = true}));
  }
  calls.null = mean_call("null", each);
  calls.leaks = is_off(calls.null.mask) || is_off(calls.null.all);
  return calls;
}

}  // namespace skerry::echo

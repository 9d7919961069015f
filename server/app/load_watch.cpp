#include "server/app/load_watch.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

namespace skerry::server {
namespace {

constexpr int kStallLooks = 3;
constexpr std::size_t kMostNamed = 6;

double seconds(LoadWatch::Steady::duration time) {
  return std::chrono::duration<double>(time).count();
}

std::string names(std::vector<std::uint32_t> radars) {
  const std::size_t more = radars.size() - std::min(radars.size(), kMostNamed);
  radars.resize(radars.size() - more);
  std::string text = fmt::format("{}", fmt::join(radars, ", "));
  if (more > 0) text += fmt::format(" and {} more", more);
  return text;
}

}  // namespace

void LoadWatch::begin(std::span<const RadarPace> radars, Steady now) {
  for (const RadarPace& pace : radars) radars_.push_back({.pace = pace, .moved = now});
  looked_ = now;
}

std::vector<LoadWatch::Line> LoadWatch::look(std::span<const RadarPace> radars, Steady now) {
  if (radars_.size() != radars.size() || looked_ == Steady{}) {
    radars_.clear();
    begin(radars, now);
    return {};
  }
  const auto gap = now - std::exchange(looked_, now);
  const bool stalled = gap >= kLook + kStill;
  if (stalled) {
    stall_s_ = (stall_looks_ > 0 ? stall_s_ : 0.0) + seconds(gap - kLook);
    stall_looks_ = kStallLooks;
    for (Known& known : radars_) known.moved += gap;
  }
  std::uint64_t sectors = 0, skipped = 0, all_skipped = 0;
  std::vector<std::uint32_t> late;
  for (std::size_t i = 0; i < radars.size(); ++i) {
    Known& known = radars_[i];
    const RadarPace before = known.pace;
    const bool counts = look_at_radar(known, radars[i], now);
    const std::uint64_t more = radars[i].skipped - before.skipped;
    all_skipped += more;
    if (!counts) continue;
    sectors += radars[i].sectors - before.sectors;
    skipped += more;
    if (more > 0) late.push_back(radars[i].radar);
  }
  if (stall_looks_ > 0) {
    look_at_stall(all_skipped);
  } else {
    look_at_overload(sectors, skipped, late, now);
  }
  return std::exchange(lines_, {});
}

void LoadWatch::look_at_stall(std::uint64_t skipped) {
  stall_skipped_ += skipped;
  if (--stall_looks_ > 0) return;
  tell(true, fmt::format("the server stood still for {:.1f} s; {} sectors of its radars were never "
                         "made",
                         stall_s_, std::exchange(stall_skipped_, 0)));
}

bool LoadWatch::look_at_radar(Known& known, const RadarPace& pace, Steady now) {
  const bool moves = pace.sectors != known.pace.sectors;
  const auto still = now - known.moved;
  const std::uint64_t skipped_before = known.pace.skipped;
  known.pace = pace;
  if (!moves) {
    if (still >= kStill + kLook && !known.stands_still) {
      known.stands_still = true;
      known.skipped_before = skipped_before;
      tell(true,
           fmt::format("radar {} stands still, for {:.1f} s now", pace.radar, seconds(still)));
    }
    return !known.stands_still;
  }
  known.moved = now;
  if (!std::exchange(known.stands_still, false)) return true;
  tell(true, fmt::format("radar {} goes on after {:.1f} s; {} of its sectors were never made",
                         pace.radar, seconds(still), pace.skipped - known.skipped_before));
  return false;
}

std::string LoadWatch::totals() const {
  return fmt::format("{} of {} sectors ({:.1f} %) were left out in {:.0f} s", overload_.skipped,
                     overload_.sectors,
                     100.0 * static_cast<double>(overload_.skipped) /
                         static_cast<double>(std::max<std::uint64_t>(1, overload_.sectors)),
                     seconds(overload_.last - overload_.since));
}

void LoadWatch::look_at_overload(std::uint64_t sectors, std::uint64_t skipped,
                                 const std::vector<std::uint32_t>& late, Steady now) {
  if (skipped > 0 && !is_overloaded_) {
    is_overloaded_ = true;
    overload_ = {.since = now - kLook, .last = now, .told = now};
    tell(true, fmt::format("overload: {} of {} radars leave out sectors that they have no time for "
                           "(radar {}); fewer spokes, cells, radars or views, or more cores, would "
                           "help",
                           late.size(), radars_.size(), names(late)));
  }
  if (!is_overloaded_) return;
  overload_.calm_sectors += sectors;
  if (skipped > 0) {
    overload_.skipped += skipped;
    overload_.sectors += std::exchange(overload_.calm_sectors, 0);
    overload_.last = now;
  }
  if (now - overload_.told < kAgain) return;
  overload_.told = now;
  is_overloaded_ = now - overload_.last < kCalm;
  tell(is_overloaded_,
       (is_overloaded_ ? "overload goes on: " : "the overload is over: ") + totals());
}

std::vector<LoadWatch::Line> LoadWatch::end() {
  if (std::exchange(is_overloaded_, false)) tell(true, "there was an overload: " + totals());
  return std::exchange(lines_, {});
}

}  // namespace skerry::server

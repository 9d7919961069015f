#include "server/plotter/tracks/suspect_echoes.hpp"

#include <algorithm>
#include <cmath>

namespace skerry::server {
namespace {

bool is_old(ScenarioTime then, ScenarioTime now) {
  const double seconds = std::chrono::duration<double>(now - then).count();
  return !(std::fabs(seconds) <= SuspectEchoes::kRemembered_s);
}

std::size_t bin_of(double range_m) {
  return static_cast<std::size_t>(
      std::clamp(range_m / SuspectEchoes::kBin_m, 0.0, static_cast<double>(SuspectEchoes::kBins)));
}

}  // namespace

void SuspectEchoes::add(const Plot& plot) {
  if (lately_.size() < kLately) lately_.emplace_back();
  lately_[next_] = {plot.range_m, std::min(plot.length_m, kLongestCause_m), plot.bearing,
                    plot.greatest, plot.time};
  next_ = (next_ + 1) % kLately;
  const double half_m = std::min(0.5 * plot.length_m, 1000.0) + 0.5 * kBin_m;
  const std::size_t last = std::min(bin_of(plot.range_m + half_m), kBins - 1);
  for (std::size_t i = bin_of(plot.range_m - half_m); i <= last; ++i) {
    put(rings_[i], plot);
    if (plot.greatest >= kStrong) {
      put(bins_[i], {plot.bearing, plot.greatest, plot.cells, plot.time});
    }
  }
}

void SuspectEchoes::put(Ring& ring, const Plot& plot) {
  const double age_s = std::fabs(in_seconds(plot.time - ring.began));
  if (!(age_s <= kRing_s)) {
    const bool is_next = age_s <= 2.0 * kRing_s;
    ring.before = is_next ? ring.now : 0;
    ring.most_before = is_next ? ring.most_cells : 0;
    ring.now = ring.most_cells = 0;
    ring.began = plot.time;
  }
  const auto sector =
      static_cast<std::uint32_t>(plot.bearing.in_degrees() / 360.0 * kRingSectors) % kRingSectors;
  ring.now |= 1u << sector;
  // Land is large everywhere, and boats before it are not its lobes.
  if (plot.greatest >= kStrong && !plot.extended)
    ring.most_cells = std::max(ring.most_cells, plot.cells);
}

bool SuspectEchoes::is_of_a_ring(const Plot& plot) const {
  const std::size_t at = bin_of(plot.range_m);
  if (at >= kBins || is_old(rings_[at].began, plot.time)) return false;
  const Ring& ring = rings_[at];
  return sectors_of(ring) >= kLeastOfRing &&
         kLargerByFar * plot.cells < std::max(ring.most_cells, ring.most_before);
}

// In place of itself, of one that is old, or of the weakest if that is weaker.
void SuspectEchoes::put(Bin& bin, const Strong& strong) {
  Strong* place = &bin.front();
  for (Strong& other : bin) {
    if (other.level > 0 &&
        std::fabs((other.bearing - strong.bearing).in_degrees()) < kSameCause_deg) {
      if (is_old(other.time, strong.time) || other.level <= strong.level) other = strong;
      return;
    }
    if (is_old(other.time, strong.time)) other.level = 0;
    if (other.level < place->level) place = &other;
  }
  if (place->level <= strong.level) *place = strong;
}

SuspectEchoes::Causes SuspectEchoes::causes_of(const Plot& plot) const {
  Causes causes;
  const std::size_t at = bin_of(plot.range_m);
  if (at >= kBins) return causes;
  // An antenna that shows one lobe far off its beam shows more.
  const bool is_ring = sectors_of(rings_[at]) >= kLeastLobes;
  for (const Strong& strong : bins_[at]) {
    if (strong.level == 0 || is_old(strong.time, plot.time)) continue;
    const double off_deg = (strong.bearing - plot.bearing).in_degrees();
    const bool is_near = std::fabs(off_deg) < kNearLobe_deg;
    if ((strong.level >= plot.greatest + kLobeBelow && (is_near || is_ring)) ||
        (is_near && strong.cells > kLargerByFar * plot.cells)) {
      causes.off_deg[causes.count++] = off_deg;
    }
  }
  return causes;
}

bool SuspectEchoes::Causes::shares_one_with(const Causes& others) const {
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t k = 0; k < others.count; ++k) {
      const double off = std::fabs(off_deg[i] - others.off_deg[k]);
      if (std::min(off, 360.0 - off) < kSameCause_deg) return true;
    }
  }
  return false;
}

bool SuspectEchoes::is_echo_of_a_cause(const Plot& plot) const {
  constexpr int kMostSteps = 11;
  std::array<bool, 2 * kMostSteps + 1> dots{};  // so many steps off, from the farthest before it
  for (const Late& late : lately_) {
    const double off_deg = std::fabs((late.bearing - plot.bearing).in_degrees());
    if (off_deg > kSameBearing_deg || is_old(late.time, plot.time)) continue;
    for (const double times : {2.0, 3.0}) {
      const double off_m = plot.range_m - times * late.range_m;
      // The cause may be several ships in one echo, of which any is seen again.
      const double reach_m =
          40.0 + 0.5 * (plot.length_m + times * late.length_m) + 0.003 * plot.range_m;
      if (late.level >= kStrong && late.level >= plot.greatest && std::fabs(off_m) < reach_m) {
        return true;
      }
    }
    const double steps = (late.range_m - plot.range_m) / kSartStep_m;
    const double whole = std::floor(steps + 0.5);
    if (whole != 0.0 && std::fabs(whole) <= kMostSteps &&
        std::fabs(steps - whole) * kSartStep_m < kSartOff_m) {
      dots[static_cast<std::size_t>(whole + kMostSteps)] = true;
    }
  }
  return std::count(dots.begin(), dots.end(), true) + 1 >= kSartDots;
}

}  // namespace skerry::server

#include "server/plotter/tracks/strong_echoes.hpp"

#include <algorithm>

namespace skerry::server {
namespace {

bool is_old(ScenarioTime then, ScenarioTime now) {
  const double seconds = std::chrono::duration<double>(now - then).count();
  return !(seconds >= -StrongEchoes::kRemembered_s && seconds <= StrongEchoes::kRemembered_s);
}

std::size_t bin_of(double range_m) {
  return static_cast<std::size_t>(
      std::clamp(range_m / StrongEchoes::kBin_m, 0.0, static_cast<double>(StrongEchoes::kBins)));
}

}  // namespace

void StrongEchoes::add(const Plot& plot) {
  if (plot.greatest < kStrong) return;
  const double half_m = std::min(0.5 * plot.length_m, 1000.0) + 0.5 * kBin_m;
  const std::size_t last = std::min(bin_of(plot.range_m + half_m), kBins - 1);
  for (std::size_t i = bin_of(plot.range_m - half_m); i <= last; ++i) {
    Bin& bin = bins_[i];
    if (plot.greatest < bin.level && !is_old(bin.time, plot.time)) continue;
    bin = {plot.greatest, plot.time};
  }
}

bool StrongEchoes::is_suspect(const Plot& plot) const {
  const std::size_t at = bin_of(plot.range_m);
  return at < kBins && bins_[at].level >= plot.greatest + kBelow &&
         !is_old(bins_[at].time, plot.time);
}

}  // namespace skerry::server

#include "server/plotter/tracks/false_plots.hpp"

#include <algorithm>

namespace skerry::server {
namespace {

constexpr double kPerTurn = 0.15;  // of the way to what the last turn had
// What a cell may hold beside what it has shown: no density is known to be nothing.
constexpr double kUnseen = 0.3;
constexpr double kPi = 3.14159265358979323846;

}  // namespace

std::size_t FalsePlots::ring_of(double range_m) {
  std::size_t ring = 0;
  for (double end = kFirst_m; ring + 1 < kRings && range_m >= end; end *= 2.0) ++ring;
  return ring;
}

std::size_t FalsePlots::sector_of(double bearing_deg) {
  const auto sector = static_cast<std::size_t>(std::max(bearing_deg, 0.0) / (360.0 / kSectors));
  return std::min(sector, kSectors - 1);
}

void FalsePlots::add(double range_m, double bearing_deg) {
  cells_[ring_of(range_m)][sector_of(bearing_deg)].now += 1.0;
}

void FalsePlots::pass(double bearing_deg) {
  // A sector begins anew when the antenna enters it: by then all its plots of the turn before have
  // been told.
  const std::size_t sector = sector_of(bearing_deg);
  if (sector == sector_) return;
  sector_ = sector;
  for (auto& ring : cells_) {
    Cell& cell = ring[sector];
    cell.mean += kPerTurn * (cell.now - cell.mean);
    cell.now = 0.0;
  }
}

double FalsePlots::density_per_m2(double range_m, double bearing_deg) const {
  const std::size_t ring = ring_of(range_m);
  double outer = kFirst_m;
  for (std::size_t i = 0; i < ring; ++i) outer *= 2.0;
  const double inner = ring == 0 ? 0.0 : outer / 2.0;
  const double area = kPi * (outer * outer - inner * inner) / kSectors;
  return std::max((cells_[ring][sector_of(bearing_deg)].mean + kUnseen) / area, 1e-8);
}

}  // namespace skerry::server

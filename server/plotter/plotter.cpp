#include "server/plotter/plotter.hpp"

namespace skerry::server {

void Plotter::add(const Spoke& spoke) {
  plots_.clear();
  gone_on_ = extractor_.add(spoke, plots_);
  if (gone_on_) take_row();
}

void Plotter::flush() {
  plots_.clear();
  gone_on_ = extractor_.flush(plots_);
  if (gone_on_) take_row();
}

void Plotter::take_row() {
  for (const Plot& plot : plots_) tracker_.add(plot);
  const VideoRow& row = extractor_.row();
  tracker_.pass({.time = row.time,
                 .utc = row.utc,
                 .own_ship = row.own_ship,
                 .bearing = row.bearing,
                 .reach_m = row.cell_m * static_cast<double>(row.levels.size()),
                 .width_rad = row.width_rad});
}

}  // namespace skerry::server

#include "echo/propagation/propagation.hpp"

#include <cmath>

namespace skerry::echo {

Propagation::Propagation(const RadarSet& set, const Atmosphere& atmosphere, double wave_height_m,
                         double reach_m)
    : conditions_(path_conditions(set, atmosphere, wave_height_m)),
      table_(path_table_for(conditions_, reach_m)) {}

float Propagation::point(double range_m, double height_m) const {
  return table_->point(static_cast<float>(range_m), static_cast<float>(height_m));
}

float Propagation::one_way(double range_m, double height_m) const {
  return std::sqrt(point(range_m, height_m));
}

float Propagation::body(double range_m, double height_m) const {
  return table_->body(static_cast<float>(range_m), static_cast<float>(height_m));
}

float Propagation::gas(double range_m) const { return table_->gas(static_cast<float>(range_m)); }

double Propagation::hidden_height(double range_m) const {
  const double beyond = range_m - horizon_m();
  if (beyond <= 0.0) return 0.0;
  return (1.0 - conditions_.ducting) * beyond * beyond / (2.0 * conditions_.effective_earth_m);
}

double Propagation::horizon_m() const {
  return std::sqrt(2.0 * conditions_.effective_earth_m * conditions_.antenna_height_m);
}

double Propagation::effective_earth_m() const { return conditions_.effective_earth_m; }

}  // namespace skerry::echo

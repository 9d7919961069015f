#include "echo/rain/rain_form.hpp"

#include <algorithm>

namespace skerry::echo {
namespace {

constexpr double kNothing = -200.0;  // octaves

constexpr RainForm kCell = {.columns = 4,
                            .rows = 4,
                            .half_along = 0.97,
                            .half_across = 0.85,
                            .shear = 0.15,
                            .hurst = 0.4,
                            .spread = 1.4,
                            .least = -2.6,
                            .edge = 2.4,
                            .life_s = 1800.0};
constexpr RainForm kShower = {.columns = 8,
                              .rows = 8,
                              .half_along = 0.96,
                              .half_across = 0.9,
                              .shear = 0.25,
                              .hurst = 0.5,
                              .spread = 1.7,
                              .least = 0.4,
                              .edge = 0.4,
                              .life_s = 1200.0};
constexpr RainForm kSquallLine = {.columns = 8,
                                  .rows = 3,
                                  .half_across = 0.375,
                                  .across_drift = true,
                                  .turn_deg = 8.0,
                                  .hurst = 0.33,
                                  .spread = 1.3,
                                  .least = -2.0,
                                  .edge = 0.35,
                                  .front = 60.0,
                                  .back = 9.0,
                                  .bow = 0.3,
                                  .life_s = 2400.0};

}  // namespace

const RainForm& rain_form(RainKind kind) {
  if (kind == RainKind::shower) return kShower;
  if (kind == RainKind::squall_line) return kSquallLine;
  return kCell;
}

double rain_outline(const RainForm& form, double along, double across) {
  const bool band = form.front > 0.0;
  const double q = along * along + (band ? 0.0 : across * across);
  if (q >= 0.99 || across * across >= 0.99) return kNothing;
  double octaves = -form.edge * q / (1.0 - q);
  if (band) {
    const double ahead = across - form.bow * (1.0 - 2.0 * along * along);
    octaves -= (ahead > 0.0 ? form.front : form.back) * ahead * ahead;
  }
  return std::max(octaves, kNothing);
}

}  // namespace skerry::echo

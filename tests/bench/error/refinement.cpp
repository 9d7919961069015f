// The knob: down to which size a coast is refined.
#include <fmt/format.h>

#include <array>

#include "tests/bench/error/leading_edges.hpp"

namespace skerry::bench {

std::vector<ErrorRow> study_refinement(const ErrorStudy& study) {
  study.progress("refinement: the reference");
  const echo::CoastPicturePtr exact = picture_of(study, 0.0);
  const PlanePoint own_ship = exact->plane.to_plane(study.own_ship);
  const std::vector<double> truth =
      leading_edges_by_all(*exact, own_ship, study.range_m, study.rays);
  std::vector<ErrorRow> rows;
  constexpr std::array<double, 8> kFiner = {1.0 / 32, 1.0 / 8, 1.0 / 4, 1.0 / 2, 1.0, 2.0, 4.0, 16};
  for (const double finer : kFiner) {
    ErrorRow row;
    row.knob = "refinement tolerance";
    row.setting =
        finer >= 1.0 ? fmt::format("1/{} cell", 10.0 * finer) : fmt::format("{} cell", 0.1 / finer);
    row.in_use = finer == 1.0;
    study.progress(row.knob + ": " + row.setting);
    double prepare = 0.0;
    const echo::CoastPicturePtr picture = picture_of(study, finer, &prepare);
    std::vector<double> found;
    double cross = 0.0;
    const double index_seconds = median_seconds(
        study.repetitions, [&] { const echo::PolarIndex index(*picture, own_ship, 20.0); });
    const echo::PolarIndex index(*picture, own_ship, 20.0);
    cross = median_seconds(study.repetitions, [&] {
      found = leading_edges(*picture, index, own_ship, study.range_m, study.rays);
    });
    std::vector<double> errors = differences(found, truth, study.range_m);
    fill_errors(errors, row);
    row.microseconds_per_spoke =
        1e6 * (cross / study.rays + (prepare + index_seconds) / kStudySpokes);
    row.dimension = dimension_of(*picture);
    row.setting += fmt::format(" ({} edges)", picture->edge_count());
    rows.push_back(row);
  }
  ErrorRow reference{"refinement tolerance",
                     fmt::format("reference ({} edges)", exact->edge_count()),
                     0.0,
                     0.0,
                     0.0,
                     0.0,
                     dimension_of(*exact),
                     false};
  rows.push_back(reference);
  return rows;
}

}  // namespace skerry::bench

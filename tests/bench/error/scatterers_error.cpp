#include "tests/bench/error/scatterers_error.hpp"

#include "echo/targets/echo_splat.hpp"
#include "tests/bench/error/study.hpp"
#include "tests/unit/targets/mean_echo.hpp"

namespace skerry::bench {
namespace {

using namespace skerry::echo;

RadarModel model_at(double scale_nm) {
  const RadarSet set;
  const ScanGeometry geometry{4096, 1024, 8};
  return radar_model(set, geometry, *RangeScale::find(scale_nm),
                     SpokeClock(set.rpm, geometry.spokes_per_turn), 0);
}

struct Row {
  std::vector<double> errors;
  double nanoseconds = 0.0, scatterers = 0.0;
  int ships = 0;
};

// Nanoseconds per spoke of laying that many points of one body, within a beam and a ship's length.
double lay_time(const RadarModel& model, const ShipStudy& study, ShipDetail detail) {
  std::vector<ShipScatterer> figure;
  std::vector<PointEcho> points;
  EchoSplat splat(model);
  SpokeAim first, last;
  first.spoke = 0, last.spoke = 15;
  constexpr std::uint32_t kStep = 1u << 20;
  last.plane_units = 15 * kStep;
  std::vector<float> row(model.geometry.cells, 0.0f);
  constexpr int kTurns = 200;
  const double begun = thread_seconds();
  for (int turn = 0; turn < kTurns; ++turn) {
    ship_shares(study.identity, detail, 0, figure);
    fluctuate(study.identity, static_cast<std::uint64_t>(turn), figure);
    points.clear();
    for (const ShipScatterer& s : figure) {
      points.push_back({study.range_m + static_cast<double>(s.forward) * study.length_m, 8 * kStep,
                        1e4f * s.share, s.phase, 1, 10.0f});
    }
    splat.prepare(points, first, last);
    SpokeAim aim = first;
    for (std::uint32_t k = 0; k < 16; ++k, aim.plane_units += kStep) splat.add(aim, row);
  }
  return (thread_seconds() - begun) / (16.0 * kTurns) * 1e9;
}

template <typename Detail>
Row row_of(const Detail& detail_for, const std::vector<RadarModel>& models,
           const std::vector<std::vector<double>>& references) {
  Row row;
  std::size_t which = 0;
  for (const RadarModel& model : models) {
    for (const ShipStudy& study : ship_studies()) {
      const ShipDetail detail = detail_for(model, study);
      const auto errors = decibel_errors(mean_echo(model, study, detail), references[which++]);
      row.errors.insert(row.errors.end(), errors.begin(), errors.end());
      row.nanoseconds += lay_time(model, study, detail);
      row.scatterers += detail.count();
      ++row.ships;
    }
  }
  return row;
}

void print(std::FILE* out, const char* name, bool in_use, Row row) {
  std::fprintf(out, "%c%-28s %10.1f %12.0f %9.3f %9.3f %9.3f %9.3f\n", in_use ? '*' : ' ', name,
               row.scatterers / row.ships, row.nanoseconds / row.ships, part_of(row.errors, 0.5),
               part_of(row.errors, 0.95), part_of(row.errors, 0.99), part_of(row.errors, 1.0));
}

}  // namespace

void print_scatterers_error(std::FILE* out) {
  const std::vector<RadarModel> models = {model_at(1.5), model_at(6.0)};
  std::vector<std::vector<double>> references;
  for (const RadarModel& model : models) {
    for (const ShipStudy& study : ship_studies())
      references.push_back(mean_echo(model, study, kManyScatterers));
  }
  std::fprintf(out, "Scatterers per ship: mean echo against 4096 of them, in double\n\n");
  std::fprintf(out, " %-28s %10s %12s %9s %9s %9s %9s\n", "setting", "scatterers", "ns per spoke",
               "p50 dB", "p95 dB", "p99 dB", "max dB");
  for (const double per_resolution : {0.5, 1.0, 2.0, 4.0, 8.0}) {
    char name[40];
    std::snprintf(name, sizeof name, "%.1f to what is resolved", per_resolution);
    print(out, name, per_resolution == kScatterersPerResolution,
          row_of([&](const RadarModel& model,
                     const ShipStudy& study) { return detail_of(model, study, per_resolution); },
                 models, references));
  }
  for (const std::uint32_t along : {1u, 4u, 16u, 64u}) {
    char name[40];
    std::snprintf(name, sizeof name, "%u along, 3 across", along);
    print(out, name, false,
          row_of(
              [&](const RadarModel&, const ShipStudy&) {
                return ShipDetail{along, 3};
              },
              models, references));
  }
  std::fprintf(out, "\n* what the server does\n");
}

}  // namespace skerry::bench

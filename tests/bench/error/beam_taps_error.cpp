#include "tests/bench/error/beam_taps_error.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "echo/kernel/azimuth_sum.hpp"
#include "echo/kernel/pulse_stretch.hpp"
#include "echo/radar/beam.hpp"
#include "echo/returns/moved_rows.hpp"
#include "echo/returns/static_frame.hpp"
#include "protocol/quantity/bearing.hpp"
#include "tests/bench/error/study.hpp"
#include "tests/scenes/scenes.hpp"

namespace skerry::bench {
namespace {

using echo::FrameDetail;
using echo::StaticFrame;

constexpr std::uint32_t kReferenceRays = 16384;
constexpr std::uint32_t kTurnSpokes = 4096, kEvery = 7;  // compared

struct Harbour {
  echo::ScenePtr scene;
  echo::RadarModel model;
};

Harbour place() {
  const RangeScale scale = *RangeScale::find(6.0);
  const ScanGeometry geometry;
  auto chart = scenes::world_chart(scenes::kBergen, scale.length() * 1.3);
  if (!chart) chart = scenes::made_up_chart(scenes::kBergen, scale.length() * 1.3, 120, 7);
  const echo::SpokeClock clock(24.0, geometry.spokes_per_turn);
  return {scenes::scene_at(std::move(*chart), scenes::kBergen, scale, geometry),
          echo::radar_model(echo::RadarSet{}, geometry, scale, clock, 0)};
}

// Spokes in double: every ray made by itself, stretched by the pulse and weighted by the beam.
std::vector<std::vector<double>> reference(const Harbour& at) {
  const echo::Scene& scene = *at.scene;
  const std::uint32_t cells = at.model.geometry.cells;
  echo::StaticView view;
  view.coast = scene.coast.get();
  view.structures = scene.structure_index.get();
  view.at = scene.own_ship;
  view.geo = scene.own_ship_geo;
  view.north_units = TrueBearing::from(degrees(scene.true_north_deg)).units();
  view.ashore = scene.ashore;
  view.water.seed = echo::land_seed(scene.seed);
  const echo::StaticRayModel rays{at.model.cell_m, at.model.set.antenna_height_m, at.model.unit_snr,
                                  kReferenceRays};
  const double step = 360.0 / kReferenceRays, width = at.model.set.beam_width_deg;
  const auto half = static_cast<std::int32_t>(1.25 * width / step);
  echo::StaticScratch scratch;
  std::vector<std::vector<double>> spokes(kTurnSpokes / kEvery + 1);
  std::vector<float> power(cells);
  std::vector<double> stretched(cells);
  for (std::uint32_t ray = 0; ray < kReferenceRays; ++ray) {
    const std::uint32_t units = ray * static_cast<std::uint32_t>(0x100000000ull / kReferenceRays);
    std::fill(power.begin(), power.end(), 0.0f);
    find_crossings(*scene.coast, *scene.index, {view.at, units}, scratch.crossings);
    if (!add_static_ray(view, rays, units, false, scratch, power)) continue;
    echo::stretch_pulse_reference(power, at.model.pulse_cells, stretched);
    for (std::size_t s = 0; s < spokes.size(); ++s) {
      const auto middle = static_cast<std::int32_t>(s * kEvery * (kReferenceRays / kTurnSpokes));
      auto off = static_cast<std::int32_t>(ray) - middle;
      if (off > static_cast<std::int32_t>(kReferenceRays / 2)) off -= kReferenceRays;
      if (off < -half || off > half) continue;
      const double voltage = echo::cosine_taper_voltage(off * step, width);
      if (voltage <= 0.0) continue;
      std::vector<double>& sum = spokes[s];
      sum.resize(cells, 0.0);
      for (std::uint32_t i = 0; i < cells; ++i)
        sum[i] += voltage * voltage * voltage * voltage * stretched[i];
    }
  }
  for (auto& spoke : spokes) spoke.resize(cells, 0.0);
  return spokes;
}

void spoke_of(const StaticFrame& frame, const echo::RadarModel& model, PlanePoint now,
              std::uint32_t spoke, std::vector<float>& power) {
  std::fill(power.begin(), power.end(), 0.0f);
  const PlanePoint moved = now - frame.view().at;
  const double way = std::hypot(moved.east_m, moved.north_m);
  std::vector<echo::MovedRun> runs;
  echo::for_each_part({moved, frame.detail().rows, model.cell_m},
                      spoke * (0x80000000u / (kTurnSpokes / 2)), frame.nearest_m() - way,
                      model.geometry.cells,
                      [&](const echo::RowPart& part) { frame.find(part, runs); });
  echo::add_moved(runs, power);
}

void compare(const Harbour& at, const FrameDetail& detail, double moved_m, bool in_use,
             const std::vector<std::vector<double>>& truth, std::FILE* out) {
  StaticFrame frame(at.model, detail);
  const PlanePoint there = at.scene->own_ship + PlanePoint{0.6 * moved_m, 0.8 * moved_m};
  double best = 1e9;
  for (int i = 0; i < 3; ++i) {
    const double begun = thread_seconds();
    frame.begin(*at.scene, there, 0.0);
    frame.work_crossings(1.0);
    for (std::uint32_t row = 0; row < detail.rows; row += StaticFrame::kMostRows)
      frame.make_rows(row, StaticFrame::kMostRows, echo::serial_for);
    best = std::min(best, thread_seconds() - begun);
  }
  std::vector<float> power(at.model.geometry.cells);
  const double begun = thread_seconds();
  for (std::uint32_t s = 0; s < kTurnSpokes; ++s)
    spoke_of(frame, at.model, at.scene->own_ship, s, power);
  const double adding = thread_seconds() - begun;

  std::vector<double> errors;
  const auto level = [](double p) { return 10.0 * std::log10(1.0 + p); };
  for (std::size_t s = 0; s < truth.size(); ++s) {
    spoke_of(frame, at.model, at.scene->own_ship,
             static_cast<std::uint32_t>(s * kEvery) % kTurnSpokes, power);
    for (std::size_t i = at.model.blind_cells; i < power.size(); ++i) {
      const auto p = static_cast<double>(power[i]);
      if (p >= 1.0 || truth[s][i] >= 1.0)
        errors.push_back(std::fabs(level(p) - level(truth[s][i])));
    }
  }
  std::sort(errors.begin(), errors.end());
  const auto quantile = [&](double share) {
    return errors.empty()
               ? 0.0
               : errors[static_cast<std::size_t>(share * static_cast<double>(errors.size() - 1))];
  };
  std::fprintf(out, "%6u %6.1f %6u %8.0f %10.2f %10.3f %7.3f %7.2f %7.2f %7.1f%s\n", detail.rays,
               detail.rays * at.model.set.beam_width_deg / 360.0, detail.rows, moved_m, 1e3 * best,
               1e9 * adding / kTurnSpokes / at.model.geometry.cells, quantile(0.5), quantile(0.9),
               quantile(0.99), quantile(1.0), in_use ? "  in use" : "");
}

}  // namespace

void print_beam_taps_error(std::FILE* out) {
  const Harbour at = place();
  const auto truth = reference(at);
  const FrameDetail used = echo::frame_detail(at.model);
  std::fprintf(out,
               "land behind the beam, 6 NM, 4096 x 1024, beam %.1f deg; dB over the noise against "
               "%u rays in double\n"
               "  rays a beam   rows  moved m   making ms  adding ns/cell  p50     p90     p99     "
               "max\n",
               at.model.set.beam_width_deg, kReferenceRays);
  for (const std::uint32_t rays : {512u, 1024u, 2048u, 4096u, 8192u}) {
    for (const std::uint32_t rows : {2048u, 4096u, 8192u}) {
      if (rows < rays) continue;
      compare(at, {rays, rows, used.cells}, 0.0, rays == used.rays && rows == used.rows, truth,
              out);
    }
  }
  for (const double moved : {1.0, 3.0, 10.0, 25.0, 50.0, 65.0, 100.0})
    compare(at, used, moved, true, truth, out);
}

}  // namespace skerry::bench

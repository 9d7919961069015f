// Places of echoes in spokes formed of a board's sweeps, against the rows that the spokes are made
// of.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <optional>
#include <vector>

#include "tests/validation/sweep_trial.hpp"

namespace skerry::validation {
namespace {

constexpr std::uint32_t kMarkFirst = 256, kMarkSpokes = 3584, kMarkCells = 2048;
constexpr double kGainDb = -20.0;  // from 10 to 55 dB over noise

// Power over mean noise that a log code stands for.
double power_of(double code) {
  return std::pow(10.0, ((code + 0.5) * 45.0 / 16384.0 - 10.0 - kGainDb) / 10.0);
}

// A point that does not fluctuate.
struct Mark {
  double range_m, bearing_deg;
};
std::vector<Mark> marks() {
  std::vector<Mark> all;
  for (int i = 0; i < 24; ++i) all.push_back({1000.0 + 137.31 * i, 30.0 + 12.37 * i});
  return all;
}

Site with_marks(const std::vector<double>& areas_m2) {
  static const auto made_up = scenes::made_up_scenes();
  scenes::NamedScene base = scene_named(made_up, "open sea");
  auto scene = std::make_shared<echo::Scene>(*base.scene);
  for (std::size_t i = 0; i < areas_m2.size(); ++i) {
    const Mark mark = marks()[i];
    const double at = (mark.bearing_deg + scene->heading_deg) * std::numbers::pi / 180.0;
    echo::PointTarget point;
    point.place = scene->own_ship + PlanePoint{std::sin(at), std::cos(at)} * mark.range_m;
    point.x_band_m2 = areas_m2[i];
    point.fluctuation = echo::Fluctuation::steady;
    point.identity = i + 1;
    scene->points.push_back(point);
  }
  scene->own_velocity = {};
  base.scene = std::move(scene);
  base.controls.range_scale = *RangeScale::find(3.0);
  const double cell_m = base.controls.range_scale.length().in_metres() / kMarkCells;
  return site_of("marks", base, kMarkCells, cell_m, echo::PulseChoice::short_pulse);
}

std::size_t spoke_of(const Mark& mark) {
  return static_cast<std::size_t>(mark.bearing_deg / 360.0 * kRows + 0.5);
}

// All 45 dB over noise.
const Site& with_marks() {
  static const Site site = [] {
    std::vector<double> areas(marks().size(), 1.0);
    const Site trial = with_marks(areas);
    const RowStore rows(trial, kMarkFirst, kMarkSpokes);
    for (std::size_t i = 0; i < areas.size(); ++i) {
      const auto row = rows.row(spoke_of(marks()[i]));
      const auto cell = static_cast<std::size_t>(marks()[i].range_m / trial.model.cell_m);
      areas[i] = std::pow(10.0, 4.5) /
                 static_cast<double>(*std::max_element(row.begin() + static_cast<int>(cell) - 15,
                                                       row.begin() + static_cast<int>(cell) + 15));
    }
    return with_marks(areas);
  }();
  return site;
}

echo::SweepChannel fine_channel(const Site& site) {
  echo::SweepChannel channel = channel_on(site, echo::VideoDetector::log, 14);
  channel.gain_db = kGainDb;
  return channel;
}

// Where, in cells of a profile from the middle of its first, it first comes up to `level` in
// begin .. end.
template <typename Profile>
std::optional<double> leading_edge(const Profile& profile, std::size_t begin, std::size_t end,
                                   double level) {
  for (std::size_t i = std::max<std::size_t>(begin, 1); i < end; ++i) {
    const double low = profile(i - 1), high = profile(i);
    if (high >= level && low < level)
      return static_cast<double>(i) - 1.0 + (level - low) / (high - low);
  }
  return std::nullopt;
}

template <typename Profile>
std::size_t highest(const Profile& profile, std::size_t begin, std::size_t end) {
  std::size_t best = begin;
  for (std::size_t i = begin; i < end; ++i)
    if (profile(i) > profile(best)) best = i;
  return best;
}

struct Extent {
  double peak = 0.0, centroid = 0.0, width = 0.0;  // spokes
};
// For a profile over spokes about `middle`: its centroid above -20 dB of its top, width at -6 dB.
template <typename Profile>
Extent extent_of(const Profile& profile, std::size_t middle) {
  Extent out;
  const std::size_t begin = middle - 40, end = middle + 41;
  const std::size_t top = highest(profile, begin, end);
  out.peak = profile(top);
  double sum = 0.0, moment = 0.0;
  for (std::size_t s = begin; s < end; ++s) {
    if (profile(s) < 0.01 * out.peak) continue;
    sum += profile(s);
    moment += profile(s) * static_cast<double>(s);
  }
  out.centroid = moment / sum;
  const auto rise = leading_edge(profile, begin, top + 1, 0.25 * out.peak);
  const auto mirrored = [&](std::size_t k) { return profile(end - 1 - k); };
  const auto fall = leading_edge(mirrored, 0, end - top, 0.25 * out.peak);
  out.width = rise && fall ? static_cast<double>(end) - 1.0 - *fall - *rise : 0.0;
  return out;
}

struct Picture {
  Site site;
  RowStore rows;
  std::vector<FormedSpoke> spokes;
  double ticks_per_cell;

  Picture(Site place, double ticks_in_a_cell, double pulses)
      : site(std::move(place)),
        rows(site, kMarkFirst, kMarkSpokes),
        ticks_per_cell(ticks_in_a_cell) {
    echo::SweepChannel channel = fine_channel(site);
    channel.sample_clock_hz *= ticks_per_cell;
    channel.samples = static_cast<std::uint32_t>(kMarkCells * ticks_per_cell);
    spokes = formed_spokes(rows, site.grid(), channel, pulses, kMarkFirst, kMarkSpokes);
  }
  double direct(std::size_t spoke, std::size_t cell) const {
    return static_cast<double>(rows.row(spoke)[cell]);
  }
  double formed(std::size_t spoke, std::size_t sample) const {
    return power_of(spokes[spoke - kMarkFirst].samples[sample]);
  }
  // Cells, from the middle of the first, of a place in samples from the middle of the first.
  double in_cells(double sample) const { return (sample + 0.5) / ticks_per_cell - 0.5; }
};

// At 1 tick to a cell both have the same samples.  At 3.7 the row is linear between cells, and so,
// but for the bends at cells' middles, are samples.
TEST(SweepGeometry, APointsLeadingEdgeLiesWhereItsRowHasIt) {
  for (const double ticks : {1.0, 3.7}) {
    const Picture picture(with_marks(), ticks, 5.0);
    ASSERT_EQ(picture.spokes.size(), kMarkSpokes);
    double worst = 0.0, mean = 0.0;
    for (const Mark& mark : marks()) {
      const std::size_t spoke = spoke_of(mark);
      const auto cell = static_cast<std::size_t>(mark.range_m / picture.site.model.cell_m);
      const auto row = [&](std::size_t i) { return picture.direct(spoke, i); };
      const auto seen = [&](std::size_t i) { return picture.formed(spoke, i); };
      const double level = 0.25 * row(highest(row, cell - 15, cell + 15));
      ASSERT_GT(level, 5e3);
      const auto there = leading_edge(row, cell - 15, cell + 15, level);
      const auto here =
          leading_edge(seen, static_cast<std::size_t>(static_cast<double>(cell - 15) * ticks),
                       static_cast<std::size_t>(static_cast<double>(cell + 15) * ticks), level);
      ASSERT_TRUE(there && here) << mark.range_m;
      const double off = (picture.in_cells(*here) - *there) * ticks;
      worst = std::max(worst, std::fabs(off));
      mean += off / static_cast<double>(marks().size());
    }
    std::printf("%g ticks a cell: edges of points off by %.3f ticks at most, %.3f in the mean\n",
                ticks, worst, mean);
    EXPECT_LT(worst, ticks > 1.0 ? 0.25 : 0.05);
    EXPECT_LT(std::fabs(mean), 0.05);
  }
}

TEST(SweepGeometry, APointLiesOnItsBearingAndIsAsWideAsItsRowsHaveIt) {
  for (const double pulses : {5.0, 1.831, 1.0}) {
    const Picture picture(with_marks(), 1.0, pulses);
    double centroid = 0.0, width = 0.0, mean_width = 0.0, bearing = 0.0, power = 0.0;
    for (const Mark& mark : marks()) {
      const std::size_t spoke = spoke_of(mark);
      const auto near = static_cast<std::size_t>(mark.range_m / picture.site.model.cell_m);
      const auto along = [&](std::size_t i) { return picture.direct(spoke, i); };
      const std::size_t cell = highest(along, near - 15, near + 15);
      const Extent there = extent_of([&](std::size_t s) { return picture.direct(s, cell); }, spoke);
      const Extent here = extent_of([&](std::size_t s) { return picture.formed(s, cell); }, spoke);
      centroid = std::max(centroid, std::fabs(here.centroid - there.centroid));
      bearing = std::max(bearing, std::fabs(here.centroid - mark.bearing_deg / 360.0 * kRows));
      width = std::max(width, std::fabs(here.width - there.width));
      mean_width += (here.width - there.width) / static_cast<double>(marks().size());
      power = std::max(power, std::fabs(10.0 * std::log10(here.peak / there.peak)));
    }
    std::printf(
        "%g pulses: centroids off by %.3f spokes at most, %.3f from the bearing; widths %.3f at "
        "most, %+.3f in the mean; peaks %.3f dB\n",
        pulses, centroid, bearing, width, mean_width, power);
    // 1.831 pulses a spoke lie up to 0.27 of it to one side, one or two as it comes: either flank
    // may be off by that, the centroid by a tenth over the nine spokes of a beam.
    // Noise 39 dB below the flanks, of one pulse, moves each by 0.05 (0.02 of five).
    const bool uneven = pulses == 1.831;
    EXPECT_LT(centroid, uneven ? 0.1 : 0.05);
    EXPECT_LT(bearing, uneven ? 0.15 : 0.1);
    EXPECT_LT(width, uneven ? 0.65 : 0.2);
    EXPECT_LT(std::fabs(mean_width), uneven ? 0.15 : 0.1);
    EXPECT_LT(power, 0.2);
  }
}

double quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

// The first 20 dB over noise on every spoke: islands, a mole, a bridge.  A shore that runs along
// the beam moves by more than a tick from spoke to spoke, hence quantiles.  With finer ticks than
// cells, where between two samples the first one rises out of nothing is not known.  Two spokes
// share a row of land (spokes_to_a_row()), so a shore goes in steps of two spokes, of which sweeps
// between them show the middle.
TEST(SweepGeometry, ShoresAndQuaysBeginWhereTheirRowsHaveThem) {
  static const auto made_up = scenes::made_up_scenes();
  const scenes::NamedScene& base = scene_named(made_up, "kinds");
  const double cell_m = base.controls.range_scale.length().in_metres() / kMarkCells;
  for (const double ticks : {1.0, 3.7}) {
    const Picture picture(
        site_of("kinds", base, kMarkCells, cell_m, echo::PulseChoice::short_pulse), ticks, 5.0);
    std::vector<double> off, distance;
    std::size_t only_one = 0;
    for (std::size_t spoke = kMarkFirst; spoke < kMarkFirst + kMarkSpokes; ++spoke) {
      const auto row = [&](std::size_t i) { return picture.direct(spoke, i); };
      const auto seen = [&](std::size_t i) { return picture.formed(spoke, i); };
      const auto there = leading_edge(row, 40, kMarkCells, 100.0);
      const auto here = leading_edge(seen, static_cast<std::size_t>(40 * ticks),
                                     static_cast<std::size_t>(kMarkCells * ticks), 100.0);
      if (there.has_value() != here.has_value()) ++only_one;  // 20 dB give or take noise
      if (!there || !here) continue;
      off.push_back((picture.in_cells(*here) - *there) * ticks);
      distance.push_back(std::fabs(off.back()));
    }
    ASSERT_GT(off.size(), 1000u);
    EXPECT_LT(only_one, off.size() / 50);
    std::printf(
        "%g ticks a cell, %zu shores: median %+.3f, distance median %.3f, 95 %% %.3f ticks\n",
        ticks, off.size(), quantile(off, 0.5), quantile(distance, 0.5), quantile(distance, 0.95));
    const bool finer = ticks > 1.0;
    EXPECT_LT(std::fabs(quantile(off, 0.5)), finer ? 0.5 : 0.05);
    EXPECT_LT(quantile(distance, 0.5), finer ? 0.5 : 0.05);
    EXPECT_LT(quantile(distance, 0.95), finer ? 1.8 : 0.55);
  }
}

}  // namespace
}  // namespace skerry::validation

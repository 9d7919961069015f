// Spokes formed of a board's sweeps against those that the radar's own receiver makes directly: the
// same law, in every region of every scene.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include "echo/kernel/coherent_receiver.hpp"
#include "echo/receiver/log_video.hpp"
#include "echo/receiver/view_receiver.hpp"
#include "tests/scenes/full_scene.hpp"
#include "tests/validation/sample_comparison.hpp"
#include "tests/validation/sweep_trial.hpp"

namespace skerry::validation {
namespace {

constexpr std::uint32_t kFirst = 512, kSpokes = 2048, kCells = 1024;
constexpr std::uint32_t kSectors = 8, kBands = 8;

// On 3 NM by the shortest pulse, 0.08 us: noise alone, sea, rain, land made up, and where a chart
// is installed Bergen with ships, buoys and sea.
const std::vector<Site>& sites() {
  static const std::vector<Site> all = [] {
    const auto made_up = scenes::made_up_scenes();
    std::vector<Site> sites;
    const auto add = [&](const std::string& name, scenes::NamedScene base, auto&& change) {
      auto scene = std::make_shared<echo::Scene>(*base.scene);
      change(*scene);
      base.scene = std::move(scene);
      base.controls.range_scale = *RangeScale::find(3.0);
      const double cell_m = base.controls.range_scale.length().in_metres() / kCells;
      sites.push_back(site_of(name, base, kCells, cell_m, echo::PulseChoice::short_pulse));
    };
    const scenes::NamedScene& open = scene_named(made_up, "open sea");
    add("noise", open, [](echo::Scene&) {});
    add("sea", open, [](echo::Scene& s) { s.sea.state = 4.0; });
    add("rain", open, [](echo::Scene& s) {
      s.rain = {
          {s.own_ship + PlanePoint{2500.0, 500.0}, {}, 3000.0, 16.0, 1, echo::RainKind::even}};
    });
    add("islands", scene_named(made_up, "islands"), [](echo::Scene&) {});
    if (const auto full = scenes::full_scene())
      add("Bergen", *full, [](echo::Scene& s) { s.rain.clear(); });
    return sites;
  }();
  return all;
}

using Regions = std::array<std::array<ValueCounts, kBands>, kSectors>;

void count(Regions& regions, std::uint64_t spoke, std::size_t cell, std::uint32_t value) {
  regions[(spoke - kFirst) * kSectors / kSpokes][cell * kBands / kCells].add(value);
}

// Bounds.  At most 5 x 65 regions a test: 5 deviations pass by chance in 2e-4 of runs, and
// Kolmogorov and Smirnov's distance of two samples of n lies over 2.7 sqrt(2 / n) with probability
// 1e-6.  Neighbouring samples share noise: B / fs of them are independent.
// The echo of a row stands for all pulses of its spoke, with a systematic difference: sea is
// correlated by 0.97 from row to row (speckle_lengths), and what of a pulse's echo is its
// neighbour's, 1.4 % of the variance, is averaged.  That lifts the mean of decibels by 0.03 dB and
// moves the distribution by 0.004.  Rain, which changes twice as fast, has a test of its own.
struct Allowed {
  double variance = 0.0, mean_db = 0.0, distance = 0.0;
};
constexpr Allowed kSameRow{};
constexpr Allowed kBetweenRows{0.016, 0.03, 0.004};

void expect_one_law(const std::string& what, const Regions& formed, const Regions& direct,
                    double independent, double steps_per_db, const Allowed& allowed) {
  Comparison worst;
  const auto check = [&](const std::string& where, const ValueCounts& a, const ValueCounts& b) {
    ASSERT_EQ(a.size(), b.size()) << where;
    if (a.size() < 1000.0) return;
    if (b.central(2) == 0.0) {  // blind
      EXPECT_EQ(a.mean(), b.mean()) << where;
      EXPECT_EQ(a.central(2), 0.0) << where;
      return;
    }
    const Comparison c = compared(a, b, independent);
    const double deviation_db = std::fabs(c.mean_steps / c.mean_off) / steps_per_db;
    const double allowed_db = 5.0 * (c.mean_off == 0.0 ? 0.0 : deviation_db) + allowed.mean_db;
    EXPECT_LE(std::fabs(c.mean_steps) / steps_per_db, allowed_db) << where;
    const double ratio_deviation =
        c.variance_off == 0.0 ? 0.0 : std::fabs(std::log(c.variance_ratio) / c.variance_off);
    EXPECT_LE(std::fabs(std::log(c.variance_ratio)), 5.0 * ratio_deviation + allowed.variance)
        << where;
    EXPECT_LE(c.distance, 2.7 * std::sqrt(2.0 / (a.size() * independent)) + allowed.distance)
        << where;
    worst.mean_off = std::max(worst.mean_off, std::fabs(c.mean_off));
    worst.variance_off = std::max(worst.variance_off, std::fabs(c.variance_off));
    worst.distance = std::max(worst.distance, c.distance);
  };
  ValueCounts all_formed, all_direct;
  for (std::uint32_t s = 0; s < kSectors; ++s) {
    for (std::uint32_t b = 0; b < kBands; ++b) {
      check(what + ", sector " + std::to_string(s) + ", band " + std::to_string(b), formed[s][b],
            direct[s][b]);
      all_formed.add(formed[s][b]);
      all_direct.add(direct[s][b]);
    }
  }
  check(what + ", all of it", all_formed, all_direct);
  const Comparison all = compared(all_formed, all_direct, independent);
  std::printf(
      "%-32s worst region: mean %.1f, variance %.1f deviations, KS %.4f; all: mean %+.4f dB, "
      "variance %.4f, KS %.4f\n",
      what.c_str(), worst.mean_off, worst.variance_off, worst.distance,
      all.mean_steps / steps_per_db, all.variance_ratio, all.distance);
}

double independent_share(const Site& site, const echo::SweepChannel& channel) {
  return std::min(1.0, site.model.pulse.bandwidth_hz / channel.sample_clock_hz);
}

// One trigger on every spoke's azimuth, 8 bits: what a view shows, but for the noise drawn.
TEST(SweepSpokes, OfOnePulseAreTheVideoOfAView) {
  for (const Site& site : sites()) {
    // A cell of 5.4 m holds 0.72 samples, so neither side decimates.
    echo::ViewControls controls;
    controls.range_scale = site.model.scale;
    controls.gain = 80.0;
    controls.sea = 0.0;
    echo::SweepChannel channel = channel_on(site, echo::VideoDetector::log, 8);
    channel.gain_db = -echo::threshold_db(controls.gain) - echo::kDecibelsBelowNoise * 45.0;
    const RowStore rows(site, kFirst, kSpokes);
    auto formed = std::make_unique<Regions>(), direct = std::make_unique<Regions>();
    const auto spokes = formed_spokes(rows, site.grid(), channel, 1.0, kFirst, kSpokes);
    ASSERT_EQ(spokes.size(), kSpokes);
    echo::ViewReceiver view(site.model, controls);
    std::vector<std::uint8_t> video(kCells);
    for (const FormedSpoke& one : spokes) {
      ASSERT_EQ(one.pulses, 1u);
      view.receive(rows.row(one.spoke), kCells, one.spoke, 1, site.scene->seed, echo::serial_for,
                   video);
      for (std::size_t i = 0; i < kCells; ++i) {
        count(*formed, one.spoke, i, one.samples[i]);
        count(*direct, one.spoke, i, video[i]);
      }
    }
    expect_one_law(site.name, *formed, *direct, independent_share(site, channel), 256.0 / 45.0,
                   kSameRow);
  }
}

// Codes of `pulses` noises of their own on a spoke's own row, detected in double, and their mean as
// the former rounds it.
class DirectSpokes {
 public:
  DirectSpokes(const Site& site, const echo::SweepChannel& channel)
      : channel_(channel),
        noise_(std::min(1.0, site.model.pulse.bandwidth_hz / channel.sample_clock_hz),
               echo::Decimation::peak) {}

  std::vector<std::uint32_t> spoke(std::span<const float> row, std::uint64_t spoke,
                                   std::uint32_t pulses) const {
    std::vector<std::uint32_t> sum(row.size(), pulses / 2);
    std::vector<float> total(row.size());
    const double full = std::exp2(channel_.bits), top = full - 1.0;
    for (std::uint32_t p = 0; p < pulses; ++p) {
      const echo::NoiseRow noise =
          noise_.row(echo::noise_key(99, 7, p, static_cast<std::uint32_t>(spoke)));
      echo::receive_power(row, 1.0f, noise, total);
      for (std::size_t i = 0; i < row.size(); ++i) {
        const double x = static_cast<double>(total[i]);
        const double v = channel_.detector == echo::VideoDetector::log
                             ? full / 45.0 * (10.0 * std::log10(std::max(x, 1e-30)) + 10.0)
                             : full * std::sqrt(x) * std::pow(10.0, -35.0 / 20.0);
        sum[i] += static_cast<std::uint32_t>(std::clamp(v, 0.0, top));
      }
    }
    for (std::uint32_t& s : sum) s /= pulses;
    return sum;
  }

 private:
  echo::SweepChannel channel_;
  echo::ReceiverNoise noise_;
};

void compare_many_pulses(double pulses_per_spoke, echo::VideoDetector detector) {
  for (const Site& site : sites()) {
    if (!site.scene->rain.empty()) continue;
    const echo::SweepChannel channel = channel_on(site, detector, 12);
    const RowStore rows(site, kFirst, kSpokes);
    auto formed = std::make_unique<Regions>(), direct = std::make_unique<Regions>();
    const auto spokes =
        formed_spokes(rows, site.grid(), channel, pulses_per_spoke, kFirst, kSpokes);
    ASSERT_EQ(spokes.size(), kSpokes);
    const DirectSpokes directly(site, channel);
    double pulses = 0.0;
    for (const FormedSpoke& one : spokes) {
      ASSERT_NEAR(one.pulses, pulses_per_spoke, 0.999);
      pulses += one.pulses;
      const auto made = directly.spoke(rows.row(one.spoke), one.spoke, one.pulses);
      for (std::size_t i = site.model.blind_cells; i < kCells; ++i) {
        count(*formed, one.spoke, i, one.samples[i]);
        count(*direct, one.spoke, i, made[i]);
      }
    }
    ASSERT_NEAR(pulses / kSpokes, pulses_per_spoke, 2.0 / kSpokes);
    // A step of linear video is worth what it is at mean noise, 72.8 steps up.
    const double steps_per_db = detector == echo::VideoDetector::log
                                    ? 4096.0 / 45.0
                                    : 4096.0 * std::pow(10.0, -35.0 / 20.0) / 8.69;
    expect_one_law(site.name + ", " + std::to_string(pulses_per_spoke).substr(0, 4), *formed,
                   *direct, independent_share(site, channel), steps_per_db, kBetweenRows);
  }
}

TEST(SweepSpokes, OfFivePulsesAreTheMeanOfFiveDirectOnes) {
  compare_many_pulses(5.0, echo::VideoDetector::log);
}

TEST(SweepSpokes, OfAsManyPulsesAsFallOnThemAreTheMeanOfThoseMany) {
  compare_many_pulses(3000.0 / (24.0 / 60.0 * kRows), echo::VideoDetector::log);  // 1.83
}

TEST(SweepSpokes, OfLinearVideoAreTheMeanOfLinearOnes) {
  compare_many_pulses(5.0, echo::VideoDetector::linear);
}

// Power in steps, from linear codes of 12 bits that are full at so many decibels over noise.
template <int kStepsPerNoise, int kFullDb>
void square(std::vector<std::uint16_t>& samples) {
  const double scale = std::pow(10.0, kFullDb / 10.0) / 4096.0 / 4096.0 * kStepsPerNoise;
  for (std::uint16_t& s : samples)
    s = static_cast<std::uint16_t>(std::min(65535.0, (s + 0.5) * (s + 0.5) * scale + 0.5));
}

// The largest power of a cell on the spokes that any pulse of this one may see, and on as many
// again.
float largest_about(const RowStore& rows, std::uint64_t spoke, std::size_t cell) {
  float largest = 0.0f;
  for (std::uint64_t s = spoke - 8; s <= spoke + 8; ++s)
    largest = std::max(largest, rows.row(s)[cell]);
  return largest;
}

// Behind a square-law detector the receiver's own law of the mean of five samples holds.  Echoes
// over 15 dB are left out: a few of them would be all of the variance.
TEST(SweepSpokes, OfPowerHaveTheReceiversLawOfTheMeanOfFiveSamples) {
  constexpr int kSteps = 400, kFullDb = 35;
  for (const Site& site : sites()) {
    if (!site.scene->rain.empty()) continue;
    const echo::SweepChannel channel = channel_on(site, echo::VideoDetector::linear, 12);
    const RowStore rows(site, kFirst, kSpokes);
    auto formed = std::make_unique<Regions>(), direct = std::make_unique<Regions>();
    const auto spokes =
        formed_spokes(rows, site.grid(), channel, 5.0, kFirst, kSpokes, square<kSteps, kFullDb>);
    const echo::ReceiverNoise mean_of_five(5.0, echo::Decimation::mean);
    std::vector<float> total(kCells);
    for (const FormedSpoke& one : spokes) {
      const auto row = rows.row(one.spoke);
      const auto noise =
          mean_of_five.row(echo::noise_key(98, 6, 0, static_cast<std::uint32_t>(one.spoke)));
      echo::receive_power(row, mean_of_five.gain(), noise, total);
      for (std::size_t i = site.model.blind_cells; i < kCells; ++i) {
        if (largest_about(rows, one.spoke, i) > 30.0f) continue;
        const double power = static_cast<double>(total[i]) / 5.0;
        count(*formed, one.spoke, i, one.samples[i]);
        count(*direct, one.spoke, i,
              static_cast<std::uint32_t>(std::min(65535.0, power * kSteps + 0.5)));
      }
    }
    expect_one_law(site.name + ", power", *formed, *direct, independent_share(site, channel),
                   kSteps * std::log(10.0) / 10.0, kBetweenRows);
  }
}

// Clutter goes on changing from pulse to pulse, so that a spoke of five has less of its speckle
// than one row: pulses 0.4, 0.2, 0, 0.2, 0.4 of a spoke off see the row with weight 0.76 and its
// neighbours with 0.12.  With c_k the correlation of speckle k rows apart, taken from the rows
// themselves, the variance of the power is 0.6064 + 0.3648 c1 + 0.0288 c2 of a row's; E[F^2] /
// E[D^2] is then (1 + that) / 2 whatever the mean.  Rows and spokes are the same draw: what is left
// of scatter is noise, at least 15 dB below.
TEST(SweepSpokes, OfClutterAverageItsSpeckleAsItsCorrelationSays) {
  constexpr int kSteps = 1, kFullDb = 47;
  for (const Site& site : sites()) {
    if (site.name != "sea" && site.name != "rain") continue;
    echo::SweepChannel channel = channel_on(site, echo::VideoDetector::linear, 12);
    channel.gain_db = 35.0 - kFullDb;
    const RowStore rows(site, kFirst, kSpokes);
    const auto spokes =
        formed_spokes(rows, site.grid(), channel, 5.0, kFirst, kSpokes, square<kSteps, kFullDb>);
    double d = 0.0, dd = 0.0, d1 = 0.0, d2 = 0.0, f = 0.0, ff = 0.0, cells = 0.0;
    for (std::uint32_t band = 0; band < 32; ++band) {
      double mean = 0.0;
      for (const FormedSpoke& one : spokes)
        for (std::size_t i = band * 32; i < band * 32 + 32; ++i)
          mean += static_cast<double>(rows.row(one.spoke)[i]) / (32.0 * kSpokes);
      if (mean < 20.0 || mean > 120.0) continue;
      for (const FormedSpoke& one : spokes) {
        for (std::size_t i = band * 32; i < band * 32 + 32; ++i) {
          const auto power = [&](std::uint64_t spoke) {
            return static_cast<double>(rows.row(spoke)[i]);
          };
          const double here = power(one.spoke), made = one.samples[i] / double{kSteps} - 1.0;
          d += here, dd += here * here, f += made, ff += made * made, cells += 1.0;
          d1 += here * power(one.spoke + 1), d2 += here * power(one.spoke + 2);
        }
      }
    }
    ASSERT_GT(cells, 1e5) << site.name;
    const double c1 = 2.0 * d1 / dd - 1.0, c2 = 2.0 * d2 / dd - 1.0;
    const double expected = 0.6064 + 0.3648 * c1 + 0.0288 * c2;
    // Noise adds 2 P / 5 to the square of a mean of five.
    const double found = 2.0 * (ff - 0.4 * d) / dd - 1.0;
    std::printf(
        "%s: c1 %.3f, c2 %.3f; variance of a spoke over that of a row %.4f, expected %.4f\n",
        site.name.c_str(), c1, c2, found, expected);
    EXPECT_NEAR(f / d, 1.0, 0.005) << site.name;
    EXPECT_NEAR(found, expected, 0.01) << site.name;
    EXPECT_GT(found, 0.95) << site.name;
  }
}

// Samples between the middles of cells are means of two of them: at a share s of the way the
// variance of speckle is 1 - 2 s (1 - s) (1 - c) of a cell's, c its correlation from cell to cell;
// 1 - (1 - c) / 3 over all shares.  c is exp(-2 (cell / 0.632 pulses)^2).
TEST(SweepSpokes, BetweenCellsHaveAsMuchLessSpeckleAsTheCellsAreLong) {
  constexpr int kSteps = 1, kFullDb = 47;
  constexpr double kTicks = 3.7;
  for (const Site& site : sites()) {
    if (site.name != "rain") continue;
    const RowStore rows(site, kFirst, kSpokes);
    echo::SweepChannel channel = channel_on(site, echo::VideoDetector::linear, 12);
    channel.gain_db = 35.0 - kFullDb;
    channel.sample_clock_hz *= kTicks;
    channel.samples = static_cast<std::uint32_t>(kCells * kTicks);
    const auto spokes =
        formed_spokes(rows, site.grid(), channel, 1.0, kFirst, kSpokes, square<kSteps, kFullDb>);
    double d = 0.0, dd = 0.0, d1 = 0.0, f = 0.0, ff = 0.0, cells = 0.0, samples = 0.0;
    constexpr std::size_t kFrom = 500, kTo = 900;  // 15 to 20 dB over noise
    for (const FormedSpoke& one : spokes) {
      const auto row = rows.row(one.spoke);
      for (std::size_t i = kFrom; i < kTo; ++i) {
        const double here = static_cast<double>(row[i]);
        d += here, dd += here * here, d1 += here * static_cast<double>(row[i + 1]), cells += 1.0;
      }
      const auto end = static_cast<std::size_t>(kTo * kTicks);
      for (auto i = static_cast<std::size_t>(kFrom * kTicks); i < end; ++i) {
        const double made = one.samples[i] / double{kSteps} - 1.0;
        f += made, ff += made * made, samples += 1.0;
      }
    }
    const double c = 2.0 * d1 / dd - 1.0, expected = 1.0 - (1.0 - c) / 3.0;
    const double length = 0.632 * 0.5 * echo::kLightSpeed * site.model.pulse.length_s;
    const double law = std::exp(-2.0 * std::pow(site.model.cell_m / length, 2.0));
    // Noise adds 2 P + 1 to the square of one pulse's power less the mean noise.
    const double found = 2.0 * (ff - 2.0 * f - samples) / samples / (dd / cells) - 1.0;
    std::printf("mean %.1f, c %.3f, by the law %.3f; variance between cells %.4f, expected %.4f\n",
                d / cells, c, law, found, expected);
    EXPECT_NEAR(f / samples / (d / cells), 1.0, 0.005);
    EXPECT_NEAR(c, law, 0.05);  // its length is rounded to 1/8 octave
    EXPECT_NEAR(found, expected, 0.01);
  }
}

}  // namespace
}  // namespace skerry::validation

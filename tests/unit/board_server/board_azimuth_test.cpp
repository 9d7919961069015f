// Azimuth of a sweep from its metadata against where the antenna points.
#include <numbers>

#include "server/board/azimuth_generator.hpp"
#include "tests/unit/board_server/board_harness.hpp"

namespace skerry::server {
namespace {

using namespace std::chrono_literals;

// The signed difference of two azimuths, in (-1/2, 1/2] turn.
double wrapped(double turns) { return turns - std::floor(turns + 0.5); }

struct Case {
  std::uint32_t clock_hz, milli_rpm, acps;
  std::int32_t arp_error = 0;
};

// Azimuth of a sweep undisturbed, turns clockwise from the ARP, whole turns left out, to 1e-15.
double truth(const Case& c, Tick tick) {
  const Wide turn = Wide{c.clock_hz} * 60'000;
  const Wide place = static_cast<Wide>(tick) * c.milli_rpm % turn;
  return static_cast<double>(place) / static_cast<double>(turn) - c.arp_error / 65'536.0;
}

std::vector<board::Sweep> sweeps_of(const Case& c, Duration from, Duration to,
                                    Harness::Initial more = {}) {
  more.insert(more.begin(), {{Reg::sample_clock_hz, c.clock_hz},
                             {Reg::rotation_millirpm, c.milli_rpm},
                             {Reg::acp_per_turn, c.acps},
                             {Reg::arp_error, static_cast<std::uint32_t>(c.arp_error)}});
  Harness b(Harness::small(more));
  b.wanted = false;
  b.run_to(from, from);
  b.wanted = true;
  return b.run_fresh(to - from).sweeps;
}

const Case kAny[] = {{20'000'000, 24'000, 4096},         {20'000'000, 24'000, 450},
                     {125'000'000, 45'000, 4096},        {99'999'989, 47'311, 16'384},
                     {20'000'000, 24'000, 2048, 12'345}, {61'440'000, 33'333, 360, -777}};

TEST(BoardAzimuth, CountPlusFractionOfTheAcpPeriodIsTrueToHalfATick) {
  // BOARD.md "Sources": spoke azimuth = ACP count + ticks since the ACP / ACP period.
  double worst = 0.0;
  for (const Case& c : kAny) {
    if (c.arp_error != 0) continue;  // whose ARP is itself at a nearest tick
    const double period = c.clock_hz * 60'000.0 / c.milli_rpm / c.acps;
    // A month on.
    for (const board::Sweep& s : sweeps_of(c, 720h, 720h + 3s)) {
      const double acps = s.meta.acp_count + s.meta.ticks_since_acp / period;
      const double off = wrapped(acps / c.acps - truth(c, s.meta.trigger_tick));
      worst = std::max(worst, std::fabs(off) * c.acps * period);
    }
  }
  std::printf("worst: %.4f ticks\n", worst);
  EXPECT_LE(worst, 0.5001);
}

TEST(BoardAzimuth, OfTheMetadataIsTrueToHalfATickWherePeriodsAreWholeTicks) {
  double worst = 0.0;
  for (const Case& c :
       {Case{20'480'000, 24'000, 4096}, Case{18'000'000, 24'000, 450, 0},
        Case{122'880'000, 48'000, 2048, 1024}, Case{20'480'000, 24'000, 4096, -64}}) {
    const auto sweeps = sweeps_of(c, 5s, 11s);
    EXPECT_GT(sweeps.size(), 15'000u);
    for (const board::Sweep& s : sweeps) {
      const double off = wrapped(board::azimuth_turns(s.meta) - truth(c, s.meta.trigger_tick));
      worst = std::max(worst, std::fabs(off) * c.clock_hz * 60'000.0 / c.milli_rpm);
    }
  }
  std::printf("worst: %.4f ticks\n", worst);
  EXPECT_LE(worst, 0.5);
}

// Half a tick where a turn is a whole number of ticks; where not, the ARP itself, like an ARP
// between two ACPs, stands for the tick nearest to it.
TEST(BoardAzimuth, OfTheMetadataIsTrueToHalfATickAtAnyClock) {
  for (const Case& c : kAny) {
    double worst = 0.0;
    for (const board::Sweep& s : sweeps_of(c, 8s, 14s)) {
      const double off = wrapped(board::azimuth_turns(s.meta) - truth(c, s.meta.trigger_tick));
      worst = std::max(worst, std::fabs(off) * c.clock_hz * 60'000.0 / c.milli_rpm);
    }
    const bool whole = Wide{c.clock_hz} * 60'000 % c.milli_rpm == 0;
    std::printf("worst: %.4f ticks\n", worst);
    EXPECT_LE(worst, (c.arp_error == 0 ? (whole ? 0.5 : 1.0) : 1.5) + 1.0 / c.acps);
  }
}

TEST(BoardAzimuth, UnderWowAndGustsItStaysInItsBound) {
  const Case c{20'480'000, 24'000, 1024};
  for (const std::uint32_t waves : {1u, 6u}) {
    const Harness::Initial disturbed{
        {Reg::wow_ppm, 80'000}, {Reg::wow_per_turn, waves}, {Reg::gust_ppm, 250'000}};
    const double a = 0.08 / 1.08, g = 0.25 / 1.25;
    const double bound = 2.0 * std::numbers::pi * (waves * a + g) / c.acps / (1.0 - a - g) +
                         2.5 * 1024 / 51'200'000.0;  // ACPs
    // The antenna itself, by another instance.
    AzimuthGenerator antenna({c.clock_hz, c.milli_rpm, c.acps});
    double worst = 0.0, widest = 0.0;
    FakeEchoes* echoes = nullptr;
    Harness b(Harness::small({{Reg::sample_clock_hz, c.clock_hz}, {Reg::acp_per_turn, c.acps}}));
    for (const auto& [reg, value] : disturbed) b.write(reg, value);
    b.run_to(5s);
    echoes = b.echoes[1].get();
    echoes->asked.clear();
    b.run_fresh(10s);
    // Its direction is known by the rows that were asked for, to a row of 4096; and exactly by
    // the ACP edges, between which the azimuth is that of the neighbours' mean speed.
    const auto acps = b.output.of(board::Line::acp);
    const auto arps = b.output.of(board::Line::arp);
    for (const board::Sweep& s : b.output.sweeps) {
      const auto next = std::upper_bound(acps.begin(), acps.end(), s.meta.trigger_tick);
      if (next == acps.begin() || next == acps.end()) continue;
      const auto from = static_cast<double>(*(next - 1)), to = static_cast<double>(*next);
      const double fraction = (static_cast<double>(s.meta.trigger_tick) - from) / (to - from);
      const double counted = s.meta.acp_count + fraction;
      const double off = wrapped(board::azimuth_turns(s.meta) - counted / c.acps) * c.acps;
      worst = std::max(worst, std::fabs(off));
      const double even = truth(c, s.meta.trigger_tick);
      widest = std::max(widest, std::fabs(wrapped(counted / c.acps - even)));
    }
    std::printf("worst: %.5f of %.5f ACPs; the antenna is up to %.3f deg off\n", worst, bound,
                widest * 360);
    EXPECT_LE(worst, bound);
    EXPECT_GT(worst, 0.1 * bound) << "the bound says something";
    EXPECT_GT(widest * 360, 2.0) << "the antenna is disturbed";
    EXPECT_FALSE(arps.empty());
    EXPECT_EQ(b.read(Reg::faults), 0u) << "wow and gusts are no fault";
  }
}

TEST(BoardAzimuth, RowsAreThoseOnBothSidesOfWhereItPoints) {
  Harness b(Harness::small({{Reg::sample_clock_hz, 20'480'000}, {Reg::arp_error, 5000}}));
  b.run_to(4s);
  const auto& asked = b.echoes[1]->asked;
  ASSERT_GE(asked.size(), 2 * 4096u);
  for (std::size_t i = 0; i + 1 < asked.size(); i += 2) {
    ASSERT_EQ(asked[i].row + 1, asked[i + 1].row);
    ASSERT_EQ(asked[i].when, asked[i + 1].when);
    const double rows =
        static_cast<double>(asked[i].when.time_since_epoch().count()) / 2.5e9 * 4096;
    // Counted from the bow, whatever the ARP's error; the tick begins up to a ns before its time.
    ASSERT_GE(rows + 1e-5, static_cast<double>(asked[i].row));
    ASSERT_LE(rows - 1e-5, static_cast<double>(asked[i + 1].row));
  }
}

TEST(BoardAzimuth, MetadataAreThoseOfTheTrigger) {
  Harness b(Harness::small({{Reg::sample_clock_hz, 20'480'000}, {Reg::arp_error, 40}}));
  b.run_to(4s);
  const auto acps = b.output.of(board::Line::acp);
  const auto arps = b.output.of(board::Line::arp);
  const auto triggers = b.output.of(board::Line::trigger);
  ASSERT_EQ(triggers.size(), b.output.sweeps.size());
  const auto before = [](const std::vector<Tick>& ticks, Tick tick) {
    return static_cast<std::size_t>(std::upper_bound(ticks.begin(), ticks.end(), tick) -
                                    ticks.begin());
  };
  for (std::size_t i = 0; i < triggers.size(); ++i) {
    const board::SweepMeta& meta = b.output.sweeps[i].meta;
    ASSERT_EQ(meta.trigger_tick, triggers[i]);
    ASSERT_EQ(meta.trigger_count, i + 1);
    const std::size_t n = before(acps, triggers[i]), turns = before(arps, triggers[i]);
    ASSERT_EQ(meta.ticks_since_acp, triggers[i] - acps[n - 1]);
    ASSERT_EQ(meta.arp_count, turns);
    const std::size_t at_arp = turns == 0 ? 0 : before(acps, arps[turns - 1]);
    ASSERT_EQ(meta.acp_count, n - at_arp);
    ASSERT_EQ(meta.acp_period, n < 2 ? 0 : acps[n - 1] - acps[n - 2]);
    ASSERT_EQ(meta.arp_ticks, turns == 0 ? 0 : arps[turns - 1] - acps[at_arp - 1]);
    const auto ns = time_of(triggers[i], 20'480'000).time_since_epoch().count();
    ASSERT_EQ(meta.utc_ns, static_cast<std::uint64_t>(1'700'000'000'000'000'000 + ns));
    ASSERT_EQ(meta.radar, 1u);
    ASSERT_EQ(meta.prf_millihertz, 3'000'000u);
    ASSERT_EQ(meta.pulse_ns, 80u);
  }
}

}  // namespace
}  // namespace skerry::server

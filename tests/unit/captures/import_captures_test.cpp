// The recordings of real radars: imported and read back, every spoke is what an independent decoder
// makes of it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "protocol/pcap/pcap_writer.hpp"
#include "tests/unit/captures/imported.hpp"
#include "tests/unit/pcap/radar_captures.hpp"

namespace skerry::captures {
namespace {

struct Capture {
  const char* file;
  const char* name;  // of the radar, as the import finds it out
  double rpm;
  double reach_of_range;  // of the ranges expected_decode.csv has
};

class ImportCaptures : public testing::TestWithParam<Capture> {
 protected:
  void SetUp() override {
    if (!have_radar_captures()) GTEST_SKIP() << kNoRadarCaptures;
    got_ = imported(unpack_radar_capture(GetParam().file));
  }
  const std::vector<Spoke>& spokes() { return got_.spokes[0]; }
  void expect_cells_and_ranges();
  void expect_growth();
  void expect_identity();
  Imported got_;
};

// Cells and ranges are the capture's.
void ImportCaptures::expect_cells_and_ranges() {
  const ExpectedDecode expected = expected_decode(GetParam().file);
  ASSERT_EQ(got_.spokes.size(), 1u);
  DecodedCells cells;
  for (const Spoke& spoke : spokes()) cells.add(spoke.cells);
  expect_cells(cells, expected);

  // Those without a range of their own have that of their neighbours.
  const FittedCounts& counts = got_.report.radars[0].counts;
  const auto zero = expected.spokes_at_range_m.find("0");
  EXPECT_EQ(counts.range_unknown, zero == expected.spokes_at_range_m.end() ? 0 : zero->second);
  std::map<std::string, std::int64_t> more;
  for (const Spoke& spoke : spokes()) {
    const double reach_m = spoke.header.reach().in_metres();
    const auto at = std::min_element(
        expected.spokes_at_range_m.begin(), expected.spokes_at_range_m.end(),
        [&](const auto& a, const auto& b) {
          const auto off = [&](const std::string& range) {
            return std::abs(std::stod(range) * GetParam().reach_of_range - reach_m);
          };
          return off(a.first) < off(b.first);
        });
    ASSERT_NEAR(std::stod(at->first) * GetParam().reach_of_range, reach_m, 0.1 + 1e-3 * reach_m);
    ++more[at->first];
  }
  for (const auto& [range, count] : expected.spokes_at_range_m) {
    if (range != "0") more[range] -= static_cast<std::int64_t>(count);
  }
  std::int64_t unknown = 0;
  for (const auto& [range, count] : more) {
    EXPECT_GE(count, 0) << range;
    unknown += count;
  }
  EXPECT_EQ(static_cast<std::uint64_t>(unknown), counts.range_unknown);
}

// Sequence, scan and time grow, and gaps are told of.
void ImportCaptures::expect_growth() {
  std::uint64_t missing = 0, jumps = 0;
  for (std::size_t i = 1; i < spokes().size(); ++i) {
    const SpokeHeader &before = spokes()[i - 1].header, &now = spokes()[i].header;
    ASSERT_GT(now.sequence, before.sequence) << i;
    ASSERT_GE(now.utc, before.utc) << i;
    jumps += now.sequence - before.sequence - 1;
  }
  for (const auto& event : got_.events) {
    if (event.kind() == recording::Event::GAP) missing += event.count();
  }
  EXPECT_EQ(missing, got_.report.radars[0].counts.missing);
  EXPECT_GE(missing, jumps);
  // Turns that the azimuths tell of, and those of pauses besides.
  const std::uint32_t turns = spokes().back().header.scan - spokes().front().header.scan;
  EXPECT_GE(turns + 2, expected_decode(GetParam().file).azimuth_wraps);
}

// Hello and settings tell what the radar is.
void ImportCaptures::expect_identity() {
  ASSERT_EQ(got_.hello.radars_size(), 1);
  const wire::RadarInfo& info = got_.hello.radars(0);
  EXPECT_EQ(info.name(), GetParam().name);
  EXPECT_NEAR(info.rpm(), GetParam().rpm, 0.06 * GetParam().rpm);
  EXPECT_EQ(info.spokes_per_turn(), spokes()[0].header.geometry.spokes_per_turn);
  EXPECT_EQ(info.cells(), spokes()[0].header.geometry.cells);
  EXPECT_EQ(info.bits(), spokes()[0].header.geometry.bits);
  ASSERT_FALSE(got_.settings.empty());
  EXPECT_EQ(got_.settings[0].range_nm(), spokes()[0].header.range_scale.in_nautical_miles());
  ASSERT_EQ(got_.summary.attachments.size(), 1u);
  EXPECT_EQ(got_.summary.attachments[0].name, "import.json");
}

TEST_P(ImportCaptures, ComeBackAsAnIndependentDecoderReadsThem) {
  expect_cells_and_ranges();
  expect_growth();
  expect_identity();
}

INSTANTIATE_TEST_SUITE_P(
    Recordings, ImportCaptures,
    testing::Values(Capture{"3g-trueheading.pcap.gz", "3G", 24.0, 1.0},
                    Capture{"4g-ranges-nm.pcap.gz", "4G", 20.9, 1.0},
                    Capture{"br24-ranges-nm.pcap.gz", "BR24", 24.0, 1.0},
                    Capture{"halo20-ranges.pcap.gz", "HALO20", 22.0, 1.0},
                    Capture{"halo-velocitytrack-notarget.pcap.gz", "HALO", 51.1, 1.0},
                    Capture{"halo3-5-connect-transmit.pcap.gz", "HALO", 24.0, 1.0},
                    Capture{"garminxhd_txon_txoff.pcap.gz", "Garmin xHD", 24.0, 2093.0 / 1852.0},
                    Capture{"quantum2-solent-03-gain-sea-rain.pcap.gz", "Raymarine Quantum", 24.0,
                            231.0 / 103.0},
                    Capture{"raymarine-e120-analog-tx-stdby.pcap.gz", "Raymarine RD", 24.0, 2.0}),
    [](const auto& each) { return test_name_of(each.param.file); });

TEST(ImportCaptures, TheTrueHeadingAndPlaceOfTheShipComeAlong) {
  if (!have_radar_captures()) GTEST_SKIP() << kNoRadarCaptures;
  const Imported got = imported(unpack_radar_capture("3g-trueheading.pcap.gz"));
  const SpokeHeader& last = got.spokes.at(0).back().header;
  EXPECT_NEAR(last.heading.in_degrees(), 1.6, 1.0);
  EXPECT_NEAR(last.own_ship.latitude_deg, 58.52958, 0.001);
  EXPECT_NEAR(last.own_ship.longitude_deg, 15.00703, 0.001);
  ASSERT_FALSE(got.own_ships.empty());
  EXPECT_NEAR(got.own_ships.back().latitude_deg(), 58.52958, 0.001);
}

TEST(ImportCaptures, WhatNothingTellsOfTheShipIsMarked) {
  if (!have_radar_captures()) GTEST_SKIP() << kNoRadarCaptures;
  const Imported silent = imported(unpack_radar_capture("garminxhd_txon_txoff.pcap.gz"));
  ASSERT_FALSE(silent.own_ships.empty());
  for (const wire::OwnShip& ship : silent.own_ships) {
    EXPECT_TRUE(ship.no_position() && ship.no_motion() && ship.no_heading());
  }
  const Imported told = imported(unpack_radar_capture("3g-trueheading.pcap.gz"));
  const wire::OwnShip& ship = told.own_ships.back();
  EXPECT_FALSE(ship.no_position() || ship.no_heading());
}

TEST(ImportCaptures, StandbyIsToldAlthoughNoSpokesCome) {
  if (!have_radar_captures()) GTEST_SKIP() << kNoRadarCaptures;
  const Imported got = imported(unpack_radar_capture("garminxhd_txon_txoff.pcap.gz"));
  ASSERT_GE(got.settings.size(), 2u);
  EXPECT_FALSE(got.settings.front().standby());
  EXPECT_TRUE(got.settings.back().standby());
}

// Sweeps fill the places of a turn that they pass, so none is missing once the antenna turns.
TEST(ImportCaptures, AFurunosSweepsFillTheTurn) {
  if (!have_radar_captures()) GTEST_SKIP() << kNoRadarCaptures;
  Imported got = imported(unpack_radar_capture("furuno-drs4dnxt.pcap.gz"));
  ASSERT_EQ(got.spokes.size(), 1u);
  EXPECT_EQ(got.hello.radars(0).name(), "Furuno DRS4D-NXT");
  EXPECT_EQ(got.hello.radars(0).spokes_per_turn(), 2048u);
  std::map<std::uint32_t, std::uint32_t> of_turn;
  for (const Spoke& spoke : got.spokes[0]) {
    const SpokeHeader& header = spoke.header;
    ++of_turn[header.scan];
    EXPECT_EQ(header.geometry.cells, 884u);
    EXPECT_NEAR(header.reach().in_metres(), 231.5 * 884 / 496, 0.01);
    EXPECT_EQ(header.range_scale.in_nautical_miles(), 0.125);
  }
  ASSERT_GE(of_turn.size(), 9u);
  for (const auto& [scan, spokes] : of_turn) {
    const bool whole = scan >= 2 && scan + 1 < of_turn.size();
    EXPECT_TRUE(!whole || spokes == 2048u) << spokes << " in turn " << scan;
  }
}

TEST(ImportCaptures, ARadarOfUnknownMakeIsRefusedWithWhatWasThere) {
  recording::RecordingWriter writer([](std::span<const std::uint8_t>) { return true; }, {});
  Bytes capture;
  pcap::PcapWriter out([&](std::span<const std::uint8_t> bytes) {
    capture.insert(capture.end(), bytes.begin(), bytes.end());
  });
  for (int i = 0; i < 449; ++i) {
    out.add(UtcTime(std::chrono::seconds(1'700'000'000 + i)), {ipv4(192, 0, 2, 7), 4000},
            {ipv4(239, 255, 0, 9), 10024}, Bytes(100, 0x77));
  }
  const auto done =
      import_capture([&](const DatagramSink& sink,
                         const ImportProgress&) { return pcap::read_capture(capture, sink); },
                     "unknown.pcap", writer);
  ASSERT_FALSE(done.ok());
  EXPECT_NE(done.error().text.find("449 to 239.255.0.9:10024"), std::string::npos)
      << done.error().text;
}

}  // namespace
}  // namespace skerry::captures

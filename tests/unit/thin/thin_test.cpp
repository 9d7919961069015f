// Thin spokes: what they keep of a picture, what they take of a link, and what is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "protocol/thin/thin_decoder.hpp"
#include "protocol/thin/thin_encoder.hpp"
#include "protocol/wire/spoke_message.hpp"

namespace skerry {
namespace {

using std::chrono::milliseconds;
using testing::HasSubstr;

// A turn of 24 a minute: echoes of several sizes in noise, as a receiver makes them.
class Antenna {
 public:
  // `quiet`: one cell in so many has noise.
  explicit Antenna(ScanGeometry geometry, unsigned quiet = 8)
      : geometry_(geometry), quiet_(quiet), random_(1) {}

  Spoke next() {
    Spoke spoke;
    SpokeHeader& header = spoke.header;
    header.sequence = sequence_;
    header.scan = static_cast<std::uint32_t>(sequence_ / geometry_.spokes_per_turn);
    header.index = static_cast<std::uint32_t>(sequence_ % geometry_.spokes_per_turn);
    header.geometry = geometry_;
    const double t = 2.5 * static_cast<double>(sequence_) / geometry_.spokes_per_turn;
    header.heading = TrueBearing::from(degrees(heading(t)));
    header.own_ship = {60.4 + 1e-4 * t, 179.99999 + 4e-6 * t};
    if (header.own_ship.longitude_deg >= 180.0) header.own_ship.longitude_deg -= 360.0;
    header.scenario_time = ScenarioTime(Duration(static_cast<std::int64_t>(t * 1e9)));
    header.utc = UtcTime(Duration(1'795'000'000'000'000'000 + static_cast<std::int64_t>(t * 1e9)));
    const unsigned full = geometry_.bits == 8 ? 255 : 15;
    const auto random = [&](unsigned below) { return static_cast<unsigned>(random_() % below); };
    for (std::uint32_t c = 0; c < geometry_.cells; ++c) {
      const bool noise = random(quiet_) == 0;
      const bool echo = (header.index / 64 + c / 40) % 23 == 0;
      const unsigned cell = echo ? full - random(full / 4) : noise ? random(full / 4) : 0;
      spoke.cells.push_back(static_cast<std::uint8_t>(cell));
    }
    ++sequence_;
    return spoke;
  }
  // Begins to turn: 0 to 100 deg/min in 3 s.
  static double heading(double t) { return 359.9 + 100.0 / 60.0 * t * t / 6.0; }

 private:
  ScanGeometry geometry_;
  unsigned quiet_;
  std::mt19937 random_;
  std::uint64_t sequence_ = 0;
};

struct Link {
  explicit Link(std::uint32_t level) : encoder(level) {}
  void carry(const Spoke& spoke) {
    encoder.add(spoke, [&](const wire::ThinSpokes& block) {
      bytes += block.ByteSizeLong();
      ++blocks;
      auto made = from_message(block);
      ASSERT_TRUE(made) << made.error().text;
      for (Spoke& each : made.value()) came.push_back(std::move(each));
    });
  }
  ThinEncoder encoder;
  std::vector<Spoke> came;
  std::size_t bytes = 0, blocks = 0;
};

TEST(ThinTest, TheFirstLevelKeepsEverySpokeAndCellInFourBits) {
  for (const std::uint32_t bits : {8u, 4u}) {
    Antenna antenna({512, 257, bits});
    Link link(1);
    std::vector<Spoke> sent;
    for (int i = 0; i < 1100; ++i) {
      sent.push_back(antenna.next());
      link.carry(sent.back());
    }
    ASSERT_EQ(link.came.size(), 1088u);  // the last block is not full
    for (std::size_t i = 0; i < link.came.size(); ++i) {
      const Spoke& came = link.came[i];
      EXPECT_EQ(came.header.sequence, i);
      EXPECT_EQ(came.header.index, sent[i].header.index);
      EXPECT_EQ(came.header.scan, sent[i].header.scan);
      EXPECT_EQ(came.header.geometry, (ScanGeometry{512, 257, 4}));
      for (std::size_t c = 0; c < 257; ++c) {
        ASSERT_EQ(came.cells[c], bits == 8 ? sent[i].cells[c] >> 4 : sent[i].cells[c]);
      }
    }
  }
}

TEST(ThinTest, ThinnerLevelsKeepThePeaksAndLeaveOutTheNoise) {
  for (std::uint32_t level = 2; level <= kThinLevels; ++level) {
    Antenna antenna({4096, 1024, 8});
    Link link(level);
    const ThinShape shape = kThinShapes[level];
    const std::uint32_t by_spoke = 4096 / shape.most_spokes, by_cell = 1024 / shape.most_cells;
    std::vector<std::uint8_t> peaks(std::size_t{shape.most_spokes} * shape.most_cells);
    for (std::uint32_t i = 0; i < 4096; ++i) {
      const Spoke spoke = antenna.next();
      for (std::uint32_t c = 0; c < 1024; ++c) {
        std::uint8_t& peak = peaks[std::size_t{i / by_spoke} * shape.most_cells + c / by_cell];
        peak = std::max(peak, static_cast<std::uint8_t>(spoke.cells[c] >> 4));
      }
      link.carry(spoke);
    }
    ASSERT_EQ(link.came.size(), shape.most_spokes);
    EXPECT_EQ(link.blocks, kThinBlocksPerTurn);
    for (std::size_t i = 0; i < link.came.size(); ++i) {
      for (std::size_t c = 0; c < shape.most_cells; ++c) {
        const std::uint8_t peak = peaks[i * shape.most_cells + c];
        ASSERT_EQ(link.came[i].cells[c], peak < shape.floor ? 0 : peak) << i << " " << c;
      }
    }
  }
}

TEST(ThinTest, LevelsTakeTheirShare) {
  double last = 1e9;
  for (std::uint32_t level = 1; level <= kThinLevels; ++level) {
    Antenna antenna({4096, 1024, 8}, 100);
    Link link(level);
    for (std::uint32_t i = 0; i < 4096; ++i) link.carry(antenna.next());
    const double bytes = static_cast<double>(link.bytes);
    // A spoke as it is has some 1120 bytes.
    EXPECT_LT(bytes, 1.5 * kThinShapes[level].share * 4096 * 1120) << level;
    EXPECT_LT(bytes, 1.1 * last) << level;
    last = bytes;
  }
}

TEST(ThinTest, HeadersBetweenAreStraight) {
  Antenna antenna({4096, 1024, 8}), reference({4096, 1024, 8});
  Link link(3);
  double worst_deg = 0.0;
  for (std::uint32_t i = 0; i < 4 * 4096; ++i) link.carry(antenna.next());
  ASSERT_EQ(link.came.size(), 4096u);
  for (const Spoke& came : link.came) {
    const SpokeHeader& header = came.header;
    Spoke source;
    for (int i = 0; i < 4; ++i) source = reference.next();  // the one that completes it
    const double heading =
        std::remainder(header.heading.in_degrees() - source.header.heading.in_degrees(), 360.0);
    worst_deg = std::max(worst_deg, std::abs(heading));
    EXPECT_LE(std::abs((header.utc - source.header.utc).count()), 2);
    EXPECT_LE(std::abs((header.scenario_time - source.header.scenario_time).count()), 2);
    EXPECT_NEAR(header.own_ship.latitude_deg, source.header.own_ship.latitude_deg, 1e-9);
    EXPECT_NEAR(
        std::remainder(header.own_ship.longitude_deg - source.header.own_ship.longitude_deg, 360.0),
        0.0, 1e-9);
  }
  EXPECT_LT(worst_deg, 0.02);
  EXPECT_GT(worst_deg, 0.0);
}

TEST(ThinTest, ATurnARangeAndAGapEndABlock) {
  Antenna antenna({1024, 256, 8});
  Link link(1);
  for (int i = 0; i < 40; ++i) {
    Spoke spoke = antenna.next();
    if (i >= 10) spoke.header.range_scale = RangeScale::from_index(3).value();
    if (i >= 20) spoke.header.index += 5;
    link.carry(spoke);
  }
  EXPECT_GE(link.blocks, 2u);
  ASSERT_GE(link.came.size(), 20u);
  EXPECT_EQ(link.came[9].header.range_scale, RangeScale());
  EXPECT_EQ(link.came[10].header.range_scale, RangeScale::from_index(3).value());
}

wire::ThinSpokes good_block() {
  Antenna antenna({1024, 256, 8});
  ThinEncoder encoder(1);
  wire::ThinSpokes block;
  while (block.count() == 0) {
    encoder.add(antenna.next(), [&](const wire::ThinSpokes& made) { block = made; });
  }
  return block;
}

std::string refusal_of_block(const std::function<void(wire::ThinSpokes&)>& spoil) {
  wire::ThinSpokes block = good_block();
  spoil(block);
  const auto made = from_message(block);
  return made ? "taken" : made.error().text;
}

TEST(ThinTest, RefusesWhatIsNoBlock) {
  EXPECT_EQ(refusal_of_block([](auto&) {}), "taken");
  EXPECT_THAT(refusal_of_block([](auto& b) { b.set_count(0); }), HasSubstr("count 0"));
  EXPECT_THAT(refusal_of_block([](auto& b) { b.set_count(4'000'000'000); }), HasSubstr("count"));
  EXPECT_THAT(refusal_of_block([](auto& b) { b.set_count(33); }), HasSubstr("no zstd frame"));
  EXPECT_THAT(refusal_of_block([](auto& b) { b.mutable_first()->set_bits(8); }), HasSubstr("bits"));
  EXPECT_THAT(refusal_of_block([](auto& b) { b.mutable_first()->set_cell_count(1u << 31); }),
              HasSubstr("cell_count"));
  EXPECT_THAT(refusal_of_block([](auto& b) { b.mutable_first()->set_index(1000); }),
              HasSubstr("from index 1000"));
  EXPECT_THAT(refusal_of_block([](auto& b) { b.mutable_first()->set_spokes_per_turn(0); }),
              HasSubstr("of 0 in a turn"));
  EXPECT_THAT(refusal_of_block([](auto& b) { b.mutable_first()->set_cells("x"); }),
              HasSubstr("cells or classes"));
  EXPECT_THAT(refusal_of_block([](auto& b) {
                b.mutable_first()->set_sequence(std::numeric_limits<std::uint64_t>::max() - 3);
              }),
              HasSubstr("64 bits"));
  for (const double bad : {1e300, std::numeric_limits<double>::infinity(), std::nan("")}) {
    EXPECT_NE(refusal_of_block([&](auto& b) { b.set_longitude_change_deg(bad); }), "taken");
    EXPECT_NE(refusal_of_block([&](auto& b) { b.set_latitude_change_deg(bad); }), "taken");
    EXPECT_NE(refusal_of_block([&](auto& b) { b.mutable_first()->set_longitude_deg(bad); }),
              "taken");
  }
  EXPECT_NE(refusal_of_block([](auto& b) { b.mutable_cells()->resize(b.cells().size() / 2); }),
            "taken");
  // Whatever bits are turned, it ends, and what is taken is good.
  std::mt19937 random(7);
  for (int i = 0; i < 3000; ++i) {
    wire::ThinSpokes block = good_block();
    std::string& cells = *block.mutable_cells();
    for (int k = 0; k < 3; ++k)
      cells[random() % cells.size()] ^= static_cast<char>(1 << random() % 8);
    const auto made = from_message(block);
    if (made) {
      EXPECT_EQ(made.value().size(), 32u);
    }
  }
}

}  // namespace
}  // namespace skerry

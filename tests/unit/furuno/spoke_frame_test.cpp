// Furuno's frames: those of a real radar, each packing by hand, and what is broken.
#include "protocol/furuno/spoke_frame.hpp"

#include <gtest/gtest.h>

#include <map>
#include <random>

#include "tests/unit/pcap/radar_captures.hpp"

namespace skerry::furuno {
namespace {

constexpr const char* kCapture = "furuno-drs4dnxt.pcap.gz";

class FurunoCapture : public testing::Test {
 protected:
  void SetUp() override {
    if (!have_radar_captures()) GTEST_SKIP() << kNoRadarCaptures;
    datagrams_ = read_radar_capture(kCapture);
  }
  std::vector<CapturedDatagram> datagrams_;
};

// The digest is that of a decoder in another language, written from README.md's table alone.
TEST_F(FurunoCapture, EveryFrameIsReadToItsLastOctet) {
  DecodedCells cells;
  std::uint64_t frames = 0, sweeps = 0, turns = 0;
  int last_angle = -1, last_counter = -1;
  std::map<int, int> steps;
  for (const auto& datagram : datagrams_) {
    if (datagram.to != kSpokeAddress) continue;
    ASSERT_TRUE(is_spoke_frame(datagram.payload));
    const auto frame = decode_spoke_frame(datagram.payload);
    ASSERT_TRUE(frame.ok()) << frame.error().text;
    ++frames;
    EXPECT_EQ(frame->cells, 884u);
    EXPECT_EQ(frame->scale, 496u);
    EXPECT_EQ(frame->range_m, 0.125 * 1852.0);
    EXPECT_FALSE(frame->has_heading);
    EXPECT_FALSE(frame->range_b);
    EXPECT_TRUE(last_counter < 0 || frame->counter == (last_counter + 1) % 256);
    last_counter = frame->counter;
    for (const Sweep& sweep : frame->sweeps) {
      ASSERT_EQ(sweep.cells.size(), 884u);
      cells.add(sweep.cells);
      ++sweeps;
      if (last_angle >= 0) {
        turns += sweep.angle < last_angle;
        ++steps[(sweep.angle - last_angle + 8192) % 8192];
      }
      last_angle = sweep.angle;
      EXPECT_NEAR(sweep.heading * 360.0 / 8192, 211.7, 1.3);
    }
  }
  EXPECT_EQ(frames, 449u);
  EXPECT_EQ(sweeps, 6119u);
  EXPECT_EQ(turns, 9u);
  EXPECT_GT(steps[12] + steps[14], 5000);
  EXPECT_EQ(cells.max(), 252u);
  EXPECT_EQ(cells.sha1(), "a4a6b3ffa27206123540e7e0b8e9d4e525c409fe");
}

TEST_F(FurunoCapture, TheRadarSaysItsModel) {
  std::map<std::string, int> models;
  for (const auto& datagram : datagrams_) {
    if (const auto model = decode_model(datagram.payload)) ++models[*model];
  }
  ASSERT_EQ(models.size(), 1u);
  EXPECT_EQ(models.begin()->first, "DRS4D-NXT");
}

TEST_F(FurunoCapture, CutOrChangedFramesAreRefusedOrReadWithinBounds) {
  std::mt19937 random(7);
  for (std::size_t i = 0; i < datagrams_.size(); i += 20) {
    const auto& whole = datagrams_[i].payload;
    if (!is_spoke_frame(whole)) continue;
    for (std::size_t size = 0; size < whole.size(); size += 7) {
      EXPECT_FALSE(decode_spoke_frame(std::span(whole).first(size)).ok()) << size;
      EXPECT_FALSE(is_spoke_frame(std::span(whole).first(size)));
    }
    for (int change = 0; change < 200; ++change) {
      auto changed = whole;
      changed[random() % changed.size()] = static_cast<std::uint8_t>(random());
      const auto frame = decode_spoke_frame(changed);
      if (!frame) continue;
      for (const Sweep& sweep : frame->sweeps) ASSERT_EQ(sweep.cells.size(), frame->cells);
    }
  }
}

Bytes frame_of(unsigned packing, unsigned cells, const std::vector<Bytes>& packed) {
  Bytes frame(kFrameHeader);
  frame[0] = 2;
  frame[9] = static_cast<std::uint8_t>(packed.size() << 1);
  frame[10] = static_cast<std::uint8_t>(cells);
  frame[11] = static_cast<std::uint8_t>(packing << 3 | cells >> 8);
  frame[12] = 9;
  frame[14] = 8;
  for (const Bytes& sweep : packed) {
    frame.insert(frame.end(), {0x01, 0x02, 0x03, 0x04});
    frame.insert(frame.end(), sweep.begin(), sweep.end());
    while (frame.size() % 4 != 0) frame.push_back(0);
  }
  const std::size_t words = frame.size() / 4 - 3;
  frame[8] = static_cast<std::uint8_t>(words);
  frame[9] = static_cast<std::uint8_t>(frame[9] | words >> 8);
  return frame;
}

using Cells = std::vector<std::vector<std::uint8_t>>;
Cells cells_of(const Bytes& datagram) {
  const auto frame = decode_spoke_frame(datagram);
  EXPECT_TRUE(frame.ok()) << frame.error().text;
  EXPECT_EQ(is_spoke_frame(datagram), frame.ok());
  Cells cells;
  if (!frame) return cells;
  for (const Sweep& sweep : frame->sweeps) cells.push_back(sweep.cells);
  return cells;
}

TEST(FurunoFrames, EachPackingIsUnpacked) {
  EXPECT_EQ(cells_of(frame_of(0, 5, {{1, 2, 3, 4, 5}})), (Cells{{1, 2, 3, 4, 5}}));
  EXPECT_EQ(cells_of(frame_of(1, 5, {{8, 3 << 1 | 1, 12}})), (Cells{{8, 8, 8, 8, 12}}));
  EXPECT_EQ(cells_of(frame_of(2, 4, {{8, 3 << 1 | 1}, {4, 2 << 1 | 1, 16}})),
            (Cells{{8, 8, 8, 8}, {4, 8, 8, 16}}));
  EXPECT_EQ(
      cells_of(frame_of(3, 4, {{8, 3 << 2 | 1}, {4, 2 << 2 | 2, 16}, {1 << 2 | 2, 3 << 2 | 3}})),
      (Cells{{8, 8, 8, 8}, {4, 8, 8, 16}, {4, 4, 4, 4}}));
  // A count of 0 stands for the greatest.
  EXPECT_EQ(cells_of(frame_of(3, 65, {{4, 1}}))[0], std::vector<std::uint8_t>(65, 4));
  EXPECT_EQ(cells_of(frame_of(1, 129, {{4, 1}}))[0], std::vector<std::uint8_t>(129, 4));
}

TEST(FurunoFrames, WhatIsBrokenIsRefusedWithTheReason) {
  const auto refusal = [](const Bytes& datagram) {
    const auto frame = decode_spoke_frame(datagram);
    return frame.ok() ? "read" : frame.error().text;
  };
  const Bytes good = frame_of(3, 4, {{8, 3 << 2 | 1}});
  EXPECT_EQ(refusal(good), "read");
  EXPECT_EQ(refusal(frame_of(3, 4, {{3 << 2 | 2, 8}})), "the first sweep copies one before it");
  EXPECT_EQ(refusal(frame_of(3, 3, {{8, 3 << 2 | 1}})), "sweep 0 does not end with 3 cells");
  EXPECT_EQ(refusal(frame_of(3, 9, {{8, 3 << 2 | 1}})), "sweep 0 does not end with 9 cells");
  Bytes bad = good;
  bad.insert(bad.end(), 4, 0);
  EXPECT_EQ(refusal(bad), "28 octets; it says 24");
  ++bad[8];
  EXPECT_EQ(refusal(bad), "28 octets; its sweeps have 24");
  // A sweep less than it says.
  bad = good;
  bad[9] = 2 << 1;
  EXPECT_EQ(refusal(bad), "read");
  bad[9] = 0;
  EXPECT_EQ(refusal(bad), "0 sweeps of 4 cells, 8 of them the range");
  bad = good;
  bad[17] = 0x20;
  EXPECT_EQ(refusal(bad), "angle 8193 of 8192 a turn");
  bad[0] = 3;
  EXPECT_EQ(refusal(bad), "a frame begins with 3, not 2");
  EXPECT_EQ(refusal({2, 0}), "a frame of 2 octets; with a sweep it has 20 and more");
}

TEST(FurunoFrames, RangesAreThoseOfTheTable) {
  EXPECT_EQ(range_of_index(9), 6 * 1852.0);
  EXPECT_EQ(range_of_index(19), 36 * 1852.0);
  EXPECT_EQ(range_of_index(21), 1852.0 / 16);
  EXPECT_EQ(range_of_index(22), std::nullopt);
}

}  // namespace
}  // namespace skerry::furuno

// Compact mode: what is packed comes back octet by octet, or is not packed.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>

#include "protocol/recording/cell_differences.hpp"
#include "protocol/recording/packed_spokes.hpp"
#include "protocol/recording/recording.pb.h"
#include "protocol/wire/spoke_message.hpp"
#include "tests/unit/recording/recording_kit.hpp"

namespace skerry::recording {
namespace {

std::vector<std::string> unpacked(const Bytes& message) {
  auto unpacker = SpokeUnpacker::open(message);
  EXPECT_TRUE(unpacker.ok()) << unpacker.error();
  std::vector<std::string> spokes;
  while ((*unpacker)->next()) {
    const auto bytes = (*unpacker)->bytes();
    spokes.emplace_back(bytes.begin(), bytes.end());
  }
  EXPECT_FALSE((*unpacker)->broken());
  return spokes;
}

bool add(SpokePacker& packer, const std::string& spoke) {
  wire::Spoke message;
  message.ParseFromString(spoke);
  return packer.add({reinterpret_cast<const std::uint8_t*>(spoke.data()), spoke.size()},
                    message.utc_ns());
}

TEST(CellDifferences, AreUndoneExactly) {
  std::mt19937 random(5);
  for (const std::size_t width : {1U, 2U, 7U, 15U, 16U, 17U, 63U, 64U, 65U, 200U}) {
    for (const std::size_t count : {1U, 2U, 7U, 15U, 16U, 17U, 33U, 64U, 67U, 16'384U, 16'385U}) {
      if (width * count > 1'100'000) continue;
      Bytes rows(width * count);
      for (auto& octet : rows) octet = static_cast<std::uint8_t>(random() >> (random() % 25));
      Bytes out{42};
      append_differences(rows, width, out);
      ASSERT_EQ(out.size(), rows.size() + 1);
      EXPECT_EQ(out[0], 42);
      EXPECT_EQ(rows_of(std::span<const std::uint8_t>(out).subspan(1), width), rows);
    }
  }
  Bytes out;
  append_differences({}, 0, out);
  EXPECT_TRUE(out.empty());
}

// The format of RECORDING.md, octet by octet.
TEST(CellDifferences, AreToTheMedianOfWhatTheNeighboursForetell) {
  std::mt19937 random(6);
  constexpr std::size_t kWidth = 83, kCount = 51;
  Bytes rows(kWidth * kCount);
  for (auto& octet : rows) octet = static_cast<std::uint8_t>(random() >> (random() % 25));
  const auto at = [&](std::size_t i, std::size_t j) {
    return i > 0 && j > 0 ? int{rows[(i - 1) * kWidth + j - 1]} : 0;
  };
  Bytes out;
  append_differences(rows, kWidth, out);
  for (std::size_t j = 1; j <= kWidth; ++j) {
    for (std::size_t i = 1; i <= kCount; ++i) {
      std::array<int, 3> of{at(i, j - 1), at(i - 1, j),
                            at(i, j - 1) + at(i - 1, j) - at(i - 1, j - 1)};
      std::sort(of.begin(), of.end());
      ASSERT_EQ(out[(j - 1) * kCount + i - 1], (at(i, j) - of[1]) & 0xFF) << i << " " << j;
    }
  }
}

// Numbers of any value, cells of any length: compact or not at all.
TEST(PackedSpokes, ComeBackWhateverTheirNumbersAre) {
  std::mt19937_64 random(9);
  std::vector<std::string> packed;
  SpokePacker packer;
  Bytes message;
  const auto any = [&] { return random() >> (random() % 64); };
  std::uint64_t time = 1'000'000;
  for (int i = 0; i < 2000; ++i) {
    wire::Spoke spoke;
    spoke.set_radar(static_cast<std::uint32_t>(any()));
    spoke.set_view(static_cast<std::uint32_t>(any()));
    spoke.set_sequence(any());
    spoke.set_scan(static_cast<std::uint32_t>(any()));
    spoke.set_index(static_cast<std::uint32_t>(any()));
    spoke.set_spokes_per_turn(static_cast<std::uint32_t>(any()));
    spoke.set_range_scale(static_cast<std::uint32_t>(any()));
    spoke.set_bits(static_cast<std::uint32_t>(any()));
    spoke.set_cell_count(static_cast<std::uint32_t>(any()));
    spoke.set_cell_size_m(i % 7 == 0 ? -0.0 : static_cast<double>(any()));
    spoke.set_heading(static_cast<std::uint32_t>(any()));
    spoke.set_latitude_deg(i % 5 == 0 ? std::numeric_limits<double>::quiet_NaN() : 60.0 + i);
    spoke.set_longitude_deg(i % 11 == 0 ? std::numeric_limits<double>::infinity() : -i * 1e-300);
    time += random() % 1'500'000;
    spoke.set_utc_ns(time);
    spoke.set_scenario_ns(any());
    spoke.set_cells(std::string(i / 50 % 3 * 31, static_cast<char>(any())));
    spoke.set_doppler(std::string(i / 70 % 2 * 8, static_cast<char>(any())));
    const std::string bytes = spoke.SerializeAsString();
    if (!add(packer, bytes)) {
      if (!packer.empty()) {
        message.clear();
        packer.finish(message);
        EXPECT_EQ(unpacked(message), packed);
        packed.clear();
      }
      ASSERT_TRUE(add(packer, bytes)) << spoke.ShortDebugString();
    }
    packed.push_back(bytes);
  }
  message.clear();
  packer.finish(message);
  EXPECT_EQ(unpacked(message), packed);
}

TEST(PackedSpokes, AreOfOneSecondAtMost) {
  SpokePacker packer;
  EXPECT_TRUE(add(packer, kit::spoke_item(0).bytes));
  EXPECT_TRUE(add(packer, kit::spoke_item(199).bytes));
  EXPECT_FALSE(add(packer, kit::spoke_item(200).bytes));
  EXPECT_FALSE(add(packer, kit::spoke_item(198).bytes));
  EXPECT_FALSE(add(packer, kit::spoke_item(199, 0, 0, 128).bytes));
  EXPECT_TRUE(add(packer, kit::spoke_item(199).bytes));
  Bytes message;
  packer.finish(message);
  EXPECT_EQ(unpacked(message).size(), 3U);
}

// Bytes that nobody would write of these values are not packed: they would not come back.
TEST(PackedSpokes, AreOnlyThoseThatComeBack) {
  SpokePacker packer;
  const std::string plain = kit::spoke_item(0).bytes;
  EXPECT_FALSE(add(packer, plain + std::string("\x08\x01", 2)));      // radar once more
  EXPECT_FALSE(add(packer, plain + std::string("\xA0\x06\x01", 3)));  // a field of the future
  const std::span<const std::uint8_t> bytes(reinterpret_cast<const std::uint8_t*>(plain.data()),
                                            plain.size());
  EXPECT_FALSE(packer.add(bytes.first(bytes.size() - 1), 0));
  EXPECT_FALSE(packer.add(bytes, 12345)) << "its time is another";
  EXPECT_TRUE(packer.empty());
}

// Whatever they are recorded as, they come back.
TEST(PackedSpokes, OfStrangeSpokesTheWriterKeepsTheBytes) {
  const kit::Folder folder;
  WriterOptions options;
  options.compact = true;
  std::vector<kit::Kept> items;
  for (std::uint32_t number = 0; number < 50; ++number) {
    kit::Kept item = kit::spoke_item(number);
    if (number % 10 == 3) item.bytes += "\x08\x01";
    if (number % 10 == 5) item.bytes = "no message at all";
    items.push_back(item);
  }
  EXPECT_EQ(kit::read_all(folder.put("a.mcap", kit::recording_of(items, options))), items);
}

TEST(PackedSpokes, ThatLieAreRefused) {
  SpokePacker packer;
  for (std::uint32_t number = 0; number < 20; ++number) {
    ASSERT_TRUE(add(packer, kit::spoke_item(number).bytes));
  }
  Bytes message;
  packer.finish(message);
  PackedSpokes packed;
  ASSERT_TRUE(packed.ParseFromArray(message.data(), static_cast<int>(message.size())));
  for (const std::uint32_t count : {0U, 19U, 21U, 0xFFFFFFFFU}) {
    PackedSpokes lie = packed;
    lie.set_count(count);
    const std::string bytes = lie.SerializeAsString();
    EXPECT_FALSE(
        SpokeUnpacker::open({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()})
            .ok());
  }
  std::mt19937 random(2);
  for (int i = 0; i < 3000; ++i) {
    Bytes changed = message;
    changed[random() % std::min<std::size_t>(changed.size(), 600)] =
        static_cast<std::uint8_t>(random());
    auto unpacker = SpokeUnpacker::open(changed);
    if (!unpacker) continue;
    int spokes = 0;
    std::int64_t before = 0;
    while ((*unpacker)->next()) {
      EXPECT_GE((*unpacker)->time(), before);
      before = (*unpacker)->time();
      ++spokes;
    }
    EXPECT_LE(spokes, 20);
  }
}

}  // namespace
}  // namespace skerry::recording

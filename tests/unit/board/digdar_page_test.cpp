#include "protocol/board/digdar_page.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace skerry::board {
namespace {

using enum RegisterError;

// Offsets by the digitiser's own source: 15 registers of control, then counts, live ones, and the
// counts once more.
TEST(DigdarPage, HasEveryRegisterOfTheDigitiserAtItsOffset) {
  std::vector<std::uint32_t> expected;
  for (std::uint32_t offset = 0x00; offset <= 0x38; offset += 4) expected.push_back(offset);
  for (std::uint32_t offset = 0x40; offset <= 0xEC; offset += 4) expected.push_back(offset);
  std::vector<std::uint32_t> found;
  for (const DigdarRegister& row : digdar_page()) {
    found.push_back(row.info->address - kDigdarPage);
    EXPECT_EQ(row.info->name.substr(0, 7), "DIGDAR_");
    EXPECT_EQ(find_register(row.info->address), row.info);
    EXPECT_EQ(find_register(row.info->name), row.info);
    EXPECT_EQ(find_digdar(row.info->address), &row);
  }
  EXPECT_EQ(found, expected);
  EXPECT_EQ(find_digdar(kDigdarPage + 0x3C), nullptr);
  EXPECT_EQ(find_digdar(kDigdarPage + kDigdarBytes), nullptr);
}

const DigdarRegister& at(std::uint32_t offset) { return *find_digdar(kDigdarPage + offset); }

TEST(DigdarPage, NamesItsRegistersAsTheDigitiserDoes) {
  EXPECT_EQ(at(0x00).info->name, "DIGDAR_COMMAND");
  EXPECT_EQ(at(0x0C).info->name, "DIGDAR_DEC_RATE");
  EXPECT_EQ(at(0x38).info->name, "DIGDAR_ARP_LATENCY");
  EXPECT_EQ(at(0x40).info->name, "DIGDAR_TRIG_CLOCK_LOW");
  EXPECT_EQ(at(0x6C).info->name, "DIGDAR_ARP_PREV_CLOCK_HIGH");
  EXPECT_EQ(at(0x70).info->name, "DIGDAR_TRIG_COUNT");
  EXPECT_EQ(at(0x88).info->name, "DIGDAR_CLOCK_SINCE_ACP_AT_ARP");
  EXPECT_EQ(at(0x90).info->name, "DIGDAR_CLOCKS_LOW");
  EXPECT_EQ(at(0x9C).info->name, "DIGDAR_ARP_RAW");
  EXPECT_EQ(at(0xA0).info->name, "DIGDAR_AT_TRIG_TRIG_CLOCK_LOW");
  EXPECT_EQ(at(0xEC).info->name, "DIGDAR_AT_TRIG_TRIG_AT_ARP");
}

TEST(DigdarPage, TakesTheValuesOfTheDigitiser) {
  const auto write = [](std::uint32_t offset, std::int64_t value) {
    return check_write(kDigdarPage + offset, static_cast<std::uint32_t>(value));
  };
  EXPECT_EQ(write(0x00, 3), ok);
  EXPECT_EQ(write(0x00, 4), out_of_range);
  EXPECT_EQ(write(0x04, 4), ok);
  EXPECT_EQ(write(0x04, 5), out_of_range);
  EXPECT_EQ(write(0x08, 16'384), ok);
  EXPECT_EQ(write(0x08, 3), out_of_range);
  EXPECT_EQ(write(0x0C, 65'536), ok);
  EXPECT_EQ(write(0x0C, 65'537), out_of_range);
  EXPECT_EQ(write(0x14, -8192), ok);
  EXPECT_EQ(write(0x14, 8192), out_of_range);
  EXPECT_EQ(write(0x24, -2049), out_of_range);
  EXPECT_EQ(write(0x2C, 1'000'000), ok);
  EXPECT_EQ(write(0x3C, 0), unknown_register);
  EXPECT_EQ(write(0x41, 0), misaligned);
  for (std::uint32_t offset = 0x40; offset <= 0xEC; offset += 4) {
    EXPECT_EQ(write(offset, 0), read_only) << offset;
  }
}

TEST(DigdarPage, AllowsNothingThatTheBoardsOwnRegisterRefuses) {
  for (const DigdarRegister& row : digdar_page()) {
    EXPECT_EQ(row.reg.has_value(), row.use == DigdarUse::same || row.use == DigdarUse::converted)
        << row.info->name;
    if (row.use != DigdarUse::same) continue;
    const RegisterInfo* const own = find_register(address_of(*row.reg));
    ASSERT_NE(own, nullptr) << row.info->name;
    EXPECT_EQ(own->access, row.info->access) << row.info->name;
    if (own->access == Access::read_only) continue;
    EXPECT_GE(row.info->min, own->min) << row.info->name;
    EXPECT_LE(row.info->max, own->max) << row.info->name;
    EXPECT_EQ(row.info->step, own->step) << row.info->name;
    EXPECT_EQ(row.info->reset, own->reset) << row.info->name;
  }
}

TEST(DigdarPage, HalvesOfAClockBelongTogether) {
  for (const DigdarRegister& row : digdar_page()) {
    if (!row.info->name.ends_with("_LOW")) continue;
    const DigdarRegister* const high = find_digdar(row.info->address + 4);
    ASSERT_NE(high, nullptr);
    EXPECT_EQ(row.info->address % 8, 0u);
    EXPECT_TRUE(high->info->name.ends_with("_HIGH")) << high->info->name;
    EXPECT_EQ(high->use, row.use);
    if (!row.reg) continue;
    EXPECT_EQ(address_of(*high->reg), address_of(*row.reg) + 4);
  }
}

}  // namespace
}  // namespace skerry::board

#include "protocol/board/registers.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace skerry::board {
namespace {

using enum RegisterError;

TEST(Registers, StandInAscendingOrderOnceEach) {
  std::set<std::string_view> names;
  std::uint32_t last = 0;
  for (const RegisterInfo& info : all_registers()) {
    EXPECT_TRUE(&info == all_registers().data() || info.address > last) << info.name;
    EXPECT_EQ(info.address % 4, 0u) << info.name;
    EXPECT_LT(info.address, kDigdarPage) << info.name;
    EXPECT_TRUE(names.insert(info.name).second) << info.name;
    EXPECT_FALSE(info.what.empty()) << info.name;
    last = info.address;
  }
  EXPECT_EQ(all_registers().size(), 82u);
}

TEST(Registers, AreFoundByAddressAndByNameInEitherCase) {
  for (const RegisterInfo& info : all_registers()) {
    EXPECT_EQ(find_register(info.address), &info);
    EXPECT_EQ(find_register(info.name), &info);
    std::string lower(info.name);
    for (char& c : lower) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c;
    EXPECT_EQ(find_register(lower), &info);
  }
  EXPECT_EQ(find_register("PRF"), nullptr);
  EXPECT_EQ(find_register(""), nullptr);
  EXPECT_EQ(find_register(0x1D0), nullptr);
  EXPECT_EQ(find_register(0xFFFF'FFFF), nullptr);
}

TEST(Registers, OfChannelBAreThoseOfAFurtherOn) {
  std::size_t channel_registers = 0;
  for (std::uint32_t address = 0x200; address < 0x240; address += 4) {
    const RegisterInfo* const a = find_register(address);
    const RegisterInfo* const b = find_register(address + kChannelStride);
    ASSERT_EQ(a == nullptr, b == nullptr) << address;
    if (a == nullptr) continue;
    ++channel_registers;
    EXPECT_EQ(std::string(a->name.substr(0, a->name.size() - 2)) + "_B", b->name);
    EXPECT_EQ(a->min, b->min);
    EXPECT_EQ(a->max, b->max);
    EXPECT_EQ(a->what, b->what);
  }
  EXPECT_EQ(channel_registers, 12u);
  EXPECT_EQ(find_register(address_of(Reg::source_b))->reset, 0);
  EXPECT_EQ(find_register("detector_b")->reset, 1);
  EXPECT_EQ(find_register("test_value_b")->address, address_of(Reg::test_value_b));
}

TEST(Registers, AtTheStartHoldWhatMayBeWritten) {
  for (const RegisterInfo& info : all_registers()) {
    if (info.access == Access::read_only) {
      EXPECT_EQ(check_write(info.address, 0), read_only) << info.name;
      continue;
    }
    EXPECT_EQ(check_write(info.address, static_cast<std::uint32_t>(info.reset)), ok) << info.name;
  }
}

TEST(Registers, RefuseWhatLiesBeyondTheirRange) {
  for (const RegisterInfo& info : all_registers()) {
    if (info.access != Access::read_write) continue;
    const auto check = [&](std::int64_t value) {
      return check_write(info.address, static_cast<std::uint32_t>(value));
    };
    EXPECT_EQ(check(info.min), ok) << info.name;
    EXPECT_EQ(check(info.max), ok) << info.name;
    EXPECT_EQ(check(info.max + 1), out_of_range) << info.name;
    EXPECT_EQ(info.is_signed, info.min < 0) << info.name;
    const std::int64_t below = info.is_signed || info.min > 0 ? info.min - 1 : info.max + 2;
    const bool meant = info.or_zero && below == 0;
    EXPECT_EQ(check(below), meant ? ok : out_of_range) << info.name;
    EXPECT_EQ(check(std::int64_t{1} << 31), out_of_range) << info.name;
  }
}

TEST(Registers, TakeNegativeNumbersOnlyWhereTheyAreSigned) {
  EXPECT_EQ(check_write(address_of(Reg::arp_error), 0xFFFF'8000), ok);
  EXPECT_EQ(check_write(address_of(Reg::arp_error), 0xFFFF'7FFF), out_of_range);
  EXPECT_EQ(check_write(address_of(Reg::gain_a), static_cast<std::uint32_t>(-6000)), ok);
  EXPECT_EQ(check_write(address_of(Reg::jitter_ppm), 0xFFFF'FFFF), out_of_range);
  EXPECT_EQ(value_of(*find_register("GAIN_A"), 0xFFFF'FFFF), -1);
  EXPECT_EQ(value_of(*find_register("CLOCKS_LOW"), 0xFFFF'FFFF), 4'294'967'295);
}

TEST(Registers, TakeZeroAndStepsAsTheirTableSays) {
  EXPECT_EQ(check_write(address_of(Reg::prf_millihertz), 0), ok);
  EXPECT_EQ(check_write(address_of(Reg::prf_millihertz), 1), out_of_range);
  EXPECT_EQ(check_write(address_of(Reg::prf_millihertz), 3'000'000), ok);
  EXPECT_EQ(check_write(address_of(Reg::spokes_per_turn), 0), ok);
  EXPECT_EQ(check_write(address_of(Reg::spokes_per_turn), 255), out_of_range);
  for (std::uint32_t bits = 0; bits < 20; ++bits) {
    const bool allowed = bits == 8 || bits == 10 || bits == 12 || bits == 14;
    EXPECT_EQ(check_write(address_of(Reg::bits_a), bits), allowed ? ok : out_of_range) << bits;
  }
  EXPECT_EQ(check_write(channel_address(Reg::samples_a, 1), 2047), out_of_range);
  EXPECT_EQ(check_write(channel_address(Reg::samples_a, 1), 2046), ok);
}

TEST(Registers, AreClearedByAnyBits) {
  for (const Reg reg : {Reg::faults_latched, Reg::events}) {
    for (const std::uint32_t bits : {0u, 0x41u, 0x80u, 0x8000'0000u, 0xFFFF'FFFFu}) {
      EXPECT_EQ(check_write(address_of(reg), bits), ok) << bits;
    }
  }
}

TEST(RefusalText, SaysWhatWasWrongAndWhatIsAllowed) {
  const auto text = [](Reg reg, std::int64_t value) {
    const auto bits = static_cast<std::uint32_t>(value);
    return refusal_text(address_of(reg), bits, check_write(address_of(reg), bits));
  };
  EXPECT_EQ(text(Reg::prf_millihertz, 0), "");
  EXPECT_EQ(text(Reg::prf_millihertz, 5),
            "PRF_MILLIHERTZ: 5 is out of range; allowed: 0, or 10000 to 20000000 mHz");
  EXPECT_EQ(text(Reg::gain_a, -6001),
            "GAIN_A: -6001 is out of range; allowed: -6000 to 6000 0.01 dB");
  EXPECT_EQ(text(Reg::bits_a, 9), "BITS_A: 9 is out of range; allowed: 8 to 14 bits in steps of 2");
  EXPECT_EQ(text(Reg::status, 1), "STATUS is read only");
  EXPECT_EQ(refusal_text(0x1D0, 1, unknown_register), "the board has no register at 0x1D0");
  EXPECT_EQ(refusal_text(0x121, 1, misaligned),
            "0x121 is no address of a register: they are multiples of 4");
}

TEST(RefusalText, OfASourceThatIsNotOnThisShipSaysSo) {
  for (const Reg reg : {Reg::source_a, Reg::source_b}) {
    EXPECT_EQ(refusal_text(address_of(reg), 3, out_of_range),
              std::string(find_register(address_of(reg))->name) +
                  ": no radar 2 on this own ship; allowed: 0, or a radar of the same own ship + 1");
  }
  EXPECT_EQ(refusal_text(address_of(Reg::source_a), 65, out_of_range),
            "SOURCE_A: 65 is out of range; allowed: 0 to 64");
}

TEST(BitNames, AreGivenForEachAndForSeveral) {
  EXPECT_EQ(fault_names(0), "");
  EXPECT_EQ(fault_names(fault::stalled | fault::acp_missing), "acp_missing, stalled");
  EXPECT_EQ(fault_names(fault::late | 0x300), "late, 0x300");
  EXPECT_EQ(event_name(event::fault_raised), "fault_raised");
  EXPECT_EQ(event_name(0x80), "unknown");
  EXPECT_EQ(event_name(event::arp | event::heading), "unknown");
}

TEST(Registers, ThatAreNotThereAreUnknownAndBetweenTwoMisaligned) {
  for (const std::uint32_t address :
       {0x028u, 0x118u, 0x230u, 0x368u, 0x1000u - 4, 0x10F0u, 0x0001'0000u, 0xFFFF'FFFCu}) {
    EXPECT_EQ(check_write(address, 0), unknown_register) << address;
  }
  EXPECT_EQ(check_write(0x121, 0), misaligned);
  EXPECT_EQ(check_write(0xFFFF'FFFF, 0), misaligned);
}

TEST(Registers, OfTheFaultReasonAreFoundAndReadOnly) {
  for (std::uint32_t n = 0; n < kFaultReasonBytes / 4; ++n) {
    const RegisterInfo* const info = find_register(address_of(Reg::fault_reason) + 4 * n);
    ASSERT_NE(info, nullptr);
    EXPECT_EQ(info->name, "FAULT_REASON_" + std::to_string(n));
    EXPECT_EQ(check_write(info->address, 0), read_only);
  }
}

std::string there_and_back(std::string_view reason) {
  std::vector<std::uint32_t> words;
  for (std::uint32_t n = 0; n < kFaultReasonBytes / 4; ++n) {
    words.push_back(fault_reason_word(reason, n));
  }
  return fault_reason_text(words);
}

TEST(FaultReason, IsReadBackFromItsRegisters) {
  EXPECT_EQ(fault_reason_word("FIFO", 0), 0x4F464946u);
  EXPECT_EQ(fault_reason_word("FIFO", 1), 0u);
  EXPECT_EQ(there_and_back(""), "");
  EXPECT_EQ(there_and_back("PRF_MILLIHERTZ: too high"), "PRF_MILLIHERTZ: too high");
  EXPECT_EQ(there_and_back(std::string(200, 'x')), std::string(127, 'x'));
  EXPECT_EQ(there_and_back("5 \xC2\xB5s\n"), "5 ??s?");
  const std::uint32_t hostile[] = {0x1B5B'410A, 0xFFFF'FFFF};
  EXPECT_EQ(fault_reason_text(hostile), "?A[?????");
}

}  // namespace
}  // namespace skerry::board

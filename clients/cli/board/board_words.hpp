// How `skerry board` writes registers, bits and records, and reads what a user wrote.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "clients/board/board_reading.hpp"
#include "protocol/board/registers.hpp"
#include "protocol/board/sweep_record.hpp"

namespace skerry::client {

// "acp_missing, stalled"; "none" without a bit that has a name.
std::string fault_words(std::uint32_t faults);
// "FAULTS: ACP_MISSING, STALLED", as a picture warns of them; empty without.
std::string fault_label(std::uint32_t faults);
std::string status_words(std::uint32_t status);
std::string control_words(std::uint32_t control);
std::string event_words(std::uint32_t events);

// The word of a register's value: "rings" of TEST_MODE_A 2, the bits of FAULTS; empty where the
// number says it all.
std::string word_of(const board::RegisterInfo& info, std::uint32_t value);
// The value as a number: two's complement where the register is signed.
std::int64_t number_of(const board::RegisterInfo& info, std::uint32_t value);
// "0 to 100 %", "0 to 1: log, linear".
std::string range_words(const board::RegisterInfo& info);
// Values that may be written: "0, 1000 .. 60000", "8, 10, 12 or 14", "2 .. 16384, even"; empty for
// a read-only register.
std::string range_column(const board::RegisterInfo& info);

// A whole number, decimal or with 0x, negative or not; nothing if it is none or has over 32 bits.
std::optional<std::uint32_t> parse_number(std::string_view text);

// A write as a user gives it: NAME=VALUE or ADDRESS=VALUE, the value decimal, hexadecimal (0x),
// negative, or a word of that register.
struct RegisterWrite {
  std::uint32_t address = 0;
  std::uint32_t value = 0;
};
// Error: what was wrong and what is expected.
Result<RegisterWrite, std::string> parse_write(std::string_view text);

// Why the board did not take a write, with what it would have taken.
std::string refusal(const RegisterWrite& write, board::RegisterError error);

// "channel A: log, 12 bit, 2048 samples of 7.5 m (peak of 1), inverted"; empty if it is off.
std::string channel_words(const board::SweepMeta& meta, std::size_t channel);

// Degrees from the ARP, in [0, 360).
double azimuth_deg(const board::SweepMeta& meta);

}  // namespace skerry::client

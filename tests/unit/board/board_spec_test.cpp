// BOARD.md says what the code does: every row of its tables of registers.
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "protocol/board/digdar_page.hpp"
#include "protocol/board/record_layout.hpp"
#include "protocol/board/registers.hpp"
#include "protocol/board/ring_memory.hpp"
#include "protocol/board/sweep_record.hpp"
#include "protocol/board/sweep_ring.hpp"

namespace skerry::board {
namespace {

using Row = std::vector<std::string>;

std::string trimmed(std::string_view text) {
  const auto from = text.find_first_not_of(' ');
  if (from == std::string_view::npos) return "";
  return std::string(text.substr(from, text.find_last_not_of(' ') - from + 1));
}

// Rows of BOARD.md's tables, by the first line of each.
std::map<std::string, std::vector<Row>> tables() {
  std::ifstream in(std::string(SKERRY_SOURCE_DIR) + "/protocol/BOARD.md");
  std::map<std::string, std::vector<Row>> found;
  std::string line, head;
  while (std::getline(in, line)) {
    if (line.empty() || line[0] != '|') {
      head.clear();
      continue;
    }
    if (head.empty()) head = line;
    Row row;
    for (std::size_t at = 1; at < line.size();) {
      const std::size_t end = std::min(line.find('|', at), line.size());
      row.push_back(trimmed(std::string_view(line).substr(at, end - at)));
      at = end + 1;
    }
    if (line != head && line.find("---") == std::string::npos) found[head].push_back(row);
  }
  return found;
}

std::string hex(std::uint32_t value, int digits) {
  char text[16];
  std::snprintf(text, sizeof text, "0x%0*X", digits, value);
  return text;
}

std::string access_name(Access access) {
  switch (access) {
    case Access::read_only:
      return "r";
    case Access::read_write:
      return "rw";
    case Access::write_ones_to_clear:
      return "w1c";
  }
  return "";
}

std::string range_of(const RegisterInfo& info) {
  if (info.max == 0xFFFF'FFFF) return "32 bits";
  if (info.address == address_of(Reg::identity)) return hex(kIdentity, 8);
  if (info.min == info.max) return std::to_string(info.max);
  return (info.or_zero ? "0, " : "") + std::to_string(info.min) + " .. " +
         std::to_string(info.max) + (info.step == 2 ? ", even" : "");
}

TEST(BoardSpec, HasEveryRegisterOfTheMapAsItIs) {
  const auto rows = tables()["| address | name | access | range | at start | unit | what |"];
  ASSERT_EQ(rows.size(), all_registers().size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const RegisterInfo& info = all_registers()[i];
    const std::string reset = info.address == 0 ? hex(kIdentity, 8) : std::to_string(info.reset);
    const Row expected = {hex(info.address, 3),
                          std::string(info.name),
                          access_name(info.access),
                          range_of(info),
                          reset,
                          std::string(info.unit),
                          std::string(info.what)};
    EXPECT_EQ(rows[i], expected);
  }
}

TEST(BoardSpec, HasEveryRegisterOfTheDigitisersPageAsItIs) {
  const auto rows = tables()["| offset | name | access | range | how | register | what |"];
  ASSERT_EQ(rows.size(), digdar_page().size());
  const char* const uses[] = {"same", "converted", "pulses", "stored", "zero"};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const DigdarRegister& row = digdar_page()[i];
    const std::string own =
        row.reg ? std::string(find_register(address_of(*row.reg))->name) : std::string();
    const Row expected = {hex(row.info->address - kDigdarPage, 2),
                          std::string(row.info->name.substr(7)),
                          access_name(row.info->access),
                          range_of(*row.info),
                          uses[static_cast<std::size_t>(row.use)],
                          own,
                          std::string(row.info->what)};
    EXPECT_EQ(rows[i], expected);
  }
}

TEST(BoardSpec, HasEveryErrorAsItIsCalled) {
  const auto rows = tables()["| error | name | when |"];
  ASSERT_EQ(rows.size(), 5u);
  for (std::uint32_t error = 0; error < rows.size(); ++error) {
    EXPECT_EQ(rows[error][0], std::to_string(error));
    EXPECT_EQ(rows[error][1], board::name_of(static_cast<RegisterError>(error)));
  }
}

TEST(BoardSpec, HasEveryBitWhereItIs) {
  const auto rows = tables()
      ["| bit | CONTROL | STATUS | FAULTS, FAULTS_LATCHED | EVENTS, "
       "EVENT_ENABLE |"];
  ASSERT_EQ(rows.size(), 7u);
  const auto expect = [&](std::size_t column, std::uint32_t bit, const std::string& word) {
    for (std::size_t n = 0; n < rows.size(); ++n) {
      const std::string& cell = rows[n][column];
      const std::string first = cell.substr(0, cell.find_first_of(":, "));
      EXPECT_EQ(first == word, bit == 1u << n) << word << " at bit " << n;
    }
  };
  expect(1, control::run, "run");
  expect(1, control::reset, "reset");
  expect(1, control::arm, "arm");
  expect(1, control::fifo, "fifo");
  expect(2, status::running, "running");
  expect(2, status::armed, "armed");
  expect(2, status::captured, "captured");
  expect(2, status::radiating, "radiating");
  expect(2, status::fault, "fault");
  for (const BitName& each : fault_bits()) expect(3, each.bit, std::string(each.name));
  for (const BitName& each : event_bits()) expect(4, each.bit, std::string(each.name));
  EXPECT_EQ(fault_bits().size(), 7u);
  EXPECT_EQ(event_bits().size(), 7u);
}

// The tables of bytes, in the order of the file: every record, sweep, channel, edges, event, ring.
TEST(BoardSpec, HasEveryFieldOfRecordsAndRingAtItsOffset) {
  const auto rows = tables()["| offset | bytes | field | value |"];
  std::map<std::string, std::vector<std::size_t>> offsets;
  for (const Row& row : rows) offsets[row[2]].push_back(std::stoul(row[0]));
  using Offsets = std::vector<std::size_t>;
  namespace sweep = layout::sweep;
  EXPECT_EQ(offsets["size"], Offsets{layout::kSize});
  EXPECT_EQ(offsets["kind"], Offsets{layout::kKind});
  EXPECT_EQ(offsets["format"], Offsets{layout::kFormat});
  EXPECT_EQ(offsets["sequence"], Offsets{layout::kSequence});
  EXPECT_EQ(offsets["radar"], Offsets{layout::kRadar});
  EXPECT_EQ(offsets["faults"], Offsets{layout::kFaults});
  EXPECT_EQ(offsets["trigger count"], Offsets{sweep::kTriggerCount});
  EXPECT_EQ(offsets["trigger tick"], Offsets{sweep::kTriggerTick});
  EXPECT_EQ(offsets["UTC"], Offsets{sweep::kUtcNs});
  EXPECT_EQ(offsets["sample clock"], (Offsets{sweep::kSampleClock, layout::edges::kSampleClock}));
  EXPECT_EQ(offsets["ACP count"], Offsets{sweep::kAcpCount});
  EXPECT_EQ(offsets["ticks since ACP"], Offsets{sweep::kTicksSinceAcp});
  EXPECT_EQ(offsets["ACP period"], Offsets{sweep::kAcpPeriod});
  EXPECT_EQ(offsets["ACPs per turn"], Offsets{sweep::kAcpPerTurn});
  EXPECT_EQ(offsets["ARP ticks"], Offsets{sweep::kArpTicks});
  EXPECT_EQ(offsets["ARP count"], Offsets{sweep::kArpCount});
  EXPECT_EQ(offsets["delay"], Offsets{sweep::kDelayTicks});
  EXPECT_EQ(offsets["pulse length"], Offsets{sweep::kPulseNs});
  EXPECT_EQ(offsets["PRF"], Offsets{sweep::kPrf});
  EXPECT_EQ(offsets["pulses"], Offsets{sweep::kPulses});
  EXPECT_EQ(offsets["spoke"], Offsets{sweep::kSpoke});
  EXPECT_EQ(offsets["spokes per turn"], Offsets{sweep::kSpokesPerTurn});
  EXPECT_EQ(offsets["channel A"], Offsets{sweep::kChannel});
  EXPECT_EQ(offsets["channel B"], Offsets{sweep::kChannel + sweep::kChannelBytes});
  EXPECT_EQ(offsets["samples of A"], Offsets{kSweepHeader});
  EXPECT_EQ(offsets["samples n"], Offsets{sweep::kSamples});
  EXPECT_EQ(offsets["decimation"], Offsets{sweep::kDecimation});
  EXPECT_EQ(offsets["offset"], Offsets{sweep::kOffset});
  EXPECT_EQ(offsets["bits"], Offsets{sweep::kBits});
  EXPECT_EQ(offsets["mode"], Offsets{sweep::kMode});
  EXPECT_EQ(offsets["detector"], Offsets{sweep::kDetector});
  EXPECT_EQ(offsets["inverted"], Offsets{sweep::kInverted});
  EXPECT_EQ(offsets["from tick"], Offsets{layout::edges::kFromTick});
  EXPECT_EQ(offsets["to tick"], Offsets{layout::edges::kToTick});
  EXPECT_EQ(offsets["edges n"], Offsets{layout::edges::kCount});
  EXPECT_EQ(offsets["edges"], Offsets{kEdgesHeader});
  EXPECT_EQ(offsets["tick"], Offsets{layout::event::kTick});
  EXPECT_EQ(offsets["event"], Offsets{layout::event::kEvent});
  EXPECT_EQ(offsets["value"], Offsets{layout::event::kValue});
  EXPECT_EQ(offsets["header"], (Offsets{layout::kHeader, offsetof(RingHeader, header_bytes)}));
  EXPECT_EQ(offsets["magic"], Offsets{offsetof(RingHeader, magic)});
  EXPECT_EQ(offsets["version"], Offsets{offsetof(RingHeader, version)});
  EXPECT_EQ(offsets["capacity C"], Offsets{offsetof(RingHeader, capacity)});
  EXPECT_EQ(offsets["first sequence"], Offsets{offsetof(RingHeader, first_sequence)});
  EXPECT_EQ(offsets["reserved"], Offsets{offsetof(RingHeader, reserved)});
  EXPECT_EQ(offsets["published"], Offsets{offsetof(RingHeader, published)});
  EXPECT_EQ(offsets["newest"], Offsets{offsetof(RingHeader, newest)});
  EXPECT_EQ(offsets["wakes"], Offsets{offsetof(RingHeader, wakes)});
  EXPECT_EQ(offsets["closed"], Offsets{offsetof(RingHeader, closed)});
  EXPECT_EQ(offsets["records"], Offsets{kRingHeader});
}

}  // namespace
}  // namespace skerry::board

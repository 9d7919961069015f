// What `skerry board` writes and draws.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "clients/cli/board/board_scope.hpp"
#include "clients/cli/board/board_turn.hpp"
#include "clients/cli/board/board_words.hpp"
#include "tests/unit/clients/fake_board.hpp"

namespace skerry::client {
namespace {

using board::Reg;
using testing::HasSubstr;

// 512 samples of 0, but for one of `code` at each of `places`.
board::Sweep spiky(const std::vector<std::size_t>& places, std::uint16_t code = 4095) {
  board::Sweep sweep = fake_sweep(100);
  sweep.meta.channels[0].samples = 512;
  sweep.samples[0].assign(512, 0);
  for (const std::size_t place : places) sweep.samples[0][place] = code;
  return sweep;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t from = 0, to; from < text.size(); from = to + 1) {
    to = std::min(text.find('\n', from), text.size());
    lines.push_back(text.substr(from, to - from));
  }
  return lines;
}
std::size_t characters(const std::string& line) {
  return static_cast<std::size_t>(
      std::count_if(line.begin(), line.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}
// Of a line of braille, the dots at a column.
int dots_at(const std::string& line, std::size_t column) {
  std::size_t at = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if ((line[i] & 0xC0) == 0x80) continue;
    if (at++ != column) continue;
    if (static_cast<unsigned char>(line[i]) != 0xE2) return 0;
    return (static_cast<unsigned char>(line[i + 1]) & 0x03) << 6 |
           (static_cast<unsigned char>(line[i + 2]) & 0x3F);
  }
  return 0;
}

TEST(BoardWords, ReadNumbersAndWordsOfARegister) {
  const auto write = [](const char* text) { return parse_write(text); };
  EXPECT_EQ(write("prf_millihertz=3000000")->address, board::address_of(Reg::prf_millihertz));
  EXPECT_EQ(write("PRF_MILLIHERTZ=3000000")->value, 3'000'000u);
  EXPECT_EQ(write("GAIN_A=-300")->value, static_cast<std::uint32_t>(-300));
  EXPECT_EQ(write("0x210=0xfed4")->value, 0xFED4u);
  EXPECT_EQ(write("FAULTS_LATCHED=0xFFFFFFFF")->value, 0xFFFFFFFFu);
  EXPECT_EQ(write("TEST_MODE_B=Checkerboard")->value, 5u);
  EXPECT_EQ(write("DETECTOR_A=linear")->value, 1u);
  EXPECT_EQ(write("BLANKING=video")->value, 2u);
  for (const char* wrong :
       {"", "=", "GAIN_A", "GAIN_A=", "=3", "WARP=1", "GAIN_A=1.5", "GAIN_A=x", "GAIN_A=4294967296",
        "GAIN_A=-2147483649", "GAIN_A=0x", "TEST_MODE_A=circle", "GAIN_A=rings"}) {
    EXPECT_FALSE(write(wrong)) << wrong;
  }
  EXPECT_THAT(write("TEST_MODE_A=circle").error(), HasSubstr("off, ramp, rings"));
}

TEST(BoardWords, SayWhyAWriteWasRefused) {
  const RegisterWrite write{board::channel_address(Reg::gain_a, 1),
                            static_cast<std::uint32_t>(-9000)};
  EXPECT_EQ(refusal(write, board::RegisterError::out_of_range),
            "GAIN_B: -9000 is out of range; allowed: -6000 to 6000 0.01 dB");
  EXPECT_EQ(refusal({0, 1}, board::RegisterError::read_only), "IDENTITY is read only");
  EXPECT_THAT(refusal({0xFFC, 1}, board::RegisterError::unknown_register), HasSubstr("0xFFC"));
  EXPECT_THAT(refusal({3, 1}, board::RegisterError::misaligned), HasSubstr("0x3"));
  EXPECT_EQ(fault_words(0), "none");
  EXPECT_EQ(fault_words(board::fault::acp_missing | board::fault::stalled), "acp_missing, stalled");
  EXPECT_EQ(fault_label(0), "");
  EXPECT_EQ(fault_label(board::fault::acp_missing | board::fault::stalled),
            "FAULTS: ACP_MISSING, STALLED");
}

TEST(BoardWords, SayThatARadarIsNotOnThisOwnShip) {
  const RegisterWrite write{board::channel_address(Reg::source_a, 0), 7};
  const std::string text = refusal(write, board::RegisterError::out_of_range);
  EXPECT_THAT(text, HasSubstr("SOURCE_A: no radar 6 on this own ship"));
  EXPECT_THAT(text, Not(HasSubstr("to 64")));
  EXPECT_THAT(refusal({write.address, 65}, board::RegisterError::out_of_range),
              HasSubstr("65 is out of range; allowed: 0 to 64"));
}

TEST(BoardWords, ShowRangesWithTheirSteps) {
  const auto range = [](Reg reg) {
    return range_column(*board::find_register(board::address_of(reg)));
  };
  EXPECT_EQ(range(Reg::bits_a), "8, 10, 12 or 14");
  EXPECT_EQ(range(Reg::samples_a), "2 .. 16384, even");
  EXPECT_EQ(range(Reg::gain_a), "-6000 .. 6000");
  EXPECT_THAT(range(Reg::prf_millihertz), testing::StartsWith("0, "));
  EXPECT_EQ(range(Reg::identity), "");
  EXPECT_EQ(range(Reg::faults_latched), "");
}

TEST(BoardScope, WritesZeroWithoutASign) {
  EXPECT_EQ(mark_text(-0.0, 0.5), "0");
  EXPECT_EQ(mark_text(-1e-17, 0.5), "0");
  EXPECT_EQ(mark_text(0.0, 20, true), "0");
  EXPECT_EQ(mark_text(20, 20, true), "+20");
  EXPECT_EQ(mark_text(-20, 20, true), "-20");
  EXPECT_EQ(mark_text(0.5, 0.5), "0.5");
  const board::Sweep sweep = spiky({1});
  EXPECT_THAT(draw_scope_text(sweep, whole_window(sweep.meta), {80, 24}), Not(HasSubstr("-0 ")));
}

TEST(BoardScope, KeepsTheStrongestSampleOfEachColumn) {
  const board::Sweep sweep = spiky({0, 300, 511});
  const auto columns = columns_of(sweep, 0, whole_window(sweep.meta), 64);
  std::vector<std::size_t> high;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    EXPECT_TRUE(columns[i].any);
    EXPECT_EQ(columns[i].low, 0);
    if (columns[i].high > 0) high.push_back(i);
  }
  EXPECT_EQ(high, (std::vector<std::size_t>{0, 300 / 8, 511 / 8}));
}

TEST(BoardScope, ShowsASampleInEveryColumnItReachesInto) {
  const board::Sweep sweep = spiky({10});
  const double step =
      board::sample_range_m(sweep.meta, 0, 1) - board::sample_range_m(sweep.meta, 0, 0);
  const double first = board::sample_range_m(sweep.meta, 0, 10) - 1.5 * step;
  const auto columns = columns_of(sweep, 0, {first, first + 3 * step}, 30);
  for (std::size_t i = 0; i < 30; ++i) {
    EXPECT_EQ(columns[i].high > 0, i >= 9 && i <= 20 && columns[i].high == 4095) << i;
    if (i > 10 && i < 19) {
      EXPECT_EQ(columns[i].low, 4095) << i;
    }
  }
  const auto beyond = columns_of(sweep, 0, {1e6, 2e6}, 4);
  EXPECT_FALSE(beyond[0].any);
  EXPECT_FALSE(columns_of(sweep, 1, {0, 1000}, 1)[0].any) << "the channel is off";
}

TEST(BoardScope, FitsTheTerminalWithAxisAndMetadata) {
  board::Sweep sweep = spiky({256});
  for (const TextSize size : {TextSize{80, 24}, TextSize{40, 12}, TextSize{200, 60}}) {
    const auto lines = lines_of(draw_scope_text(sweep, whole_window(sweep.meta), size));
    EXPECT_EQ(lines.size(), static_cast<std::size_t>(size.rows));
    for (const auto& line : lines) EXPECT_LE(characters(line), std::size_t(size.columns)) << line;
    EXPECT_THAT(lines.back(), HasSubstr("NM"));
  }
  const auto lines = lines_of(draw_scope_text(sweep, whole_window(sweep.meta), {86, 24}));
  EXPECT_THAT(lines[0], HasSubstr("trigger 100"));
  EXPECT_THAT(lines[1], HasSubstr("azimuth 70.3"));
  EXPECT_THAT(lines[3], HasSubstr("channel A: log, 12 bit, 512 samples"));
  EXPECT_THAT(lines[4], testing::StartsWith(" 4095 "));
  // The spike of the middle sample in the middle of 80 columns, from the top; all else below.
  EXPECT_NE(dots_at(lines[4], 6 + 40), 0);
  EXPECT_EQ(dots_at(lines[4], 6 + 38), 0);
  EXPECT_EQ(dots_at(lines[21], 6 + 38), 0xC0) << "code 0 is the lowest row of dots";

  sweep.meta.channels[1] = {.samples = 4, .decimation = 128, .bits = 8};
  sweep.samples[1] = {255, 255, 0, 0};
  const std::string both = draw_scope_text(sweep, whole_window(sweep.meta), {80, 24});
  EXPECT_THAT(both, HasSubstr("\n  255 "));
  EXPECT_THAT(both, HasSubstr("\n 4095 "));
  sweep.samples = {};
  sweep.meta.channels = {};
  EXPECT_THAT(draw_scope_text(sweep, {0, 1}, {80, 24}), HasSubstr("off"));
}

TEST(BoardScope, DrawsTracesAndSignalsAsAPicture) {
  const board::Sweep sweep = spiky({256});
  const auto span = signal_span(sweep.meta);
  EXPECT_GE(span, 3u * 32767u) << "three triggers to either side";
  std::vector<board::Edge> edges = {{sweep.meta.trigger_tick, board::Line::trigger},
                                    {sweep.meta.trigger_tick + span / 2, board::Line::acp},
                                    {sweep.meta.trigger_tick + 3 * span, board::Line::arp}};
  const auto window = whole_window(sweep.meta);
  const RgbaImage image = draw_scope_picture(sweep, edges, window, {1280, 720});
  ASSERT_EQ(image.width, 1280);
  ASSERT_EQ(image.height, 720);
  const auto count = [&](const RgbaImage& in, int left, int right, auto&& wanted) {
    int found = 0;
    for (int y = 0; y < in.height; ++y) {
      for (int x = left; x < right; ++x) found += wanted(in.at(x, y)) ? 1 : 0;
    }
    return found;
  };
  const auto amber = [](Rgba p) { return p.red > 180 && p.green > 150 && p.blue < 90; };
  const auto green = [](Rgba p) { return p.green > 190 && p.red < 150 && p.blue < 170; };
  // The panels begin 104 pixels from the left and end 16 from the right.
  const int middle = 104 + (1280 - 16 - 104) / 2,
            three_quarters = middle + (1280 - 16 - middle) / 2;
  EXPECT_GT(count(image, middle - 3, middle + 3, amber), 250) << "spike and trigger";
  EXPECT_LT(count(image, middle + 20, middle + 26, amber), 30);
  const RgbaImage without = draw_scope_picture(sweep, {}, window, {1280, 720});
  EXPECT_GT(count(image, three_quarters - 3, three_quarters + 3, green),
            count(without, three_quarters - 3, three_quarters + 3, green) + 10)
      << "the ACP half way between trigger and edge";
  const RgbaImage small = draw_scope_picture(sweep, edges, window, {1, 1});
  EXPECT_EQ(small.width, kMinScopePicture.width);
}

TEST(BoardScope, BearsWhateverABoardMaySend) {
  board::Sweep sweep = spiky({1}, 65535);
  sweep.meta.sample_clock_hz = 1;
  sweep.meta.prf_millihertz = 1;
  sweep.meta.acp_period = 0xFFFFFFFF;
  sweep.meta.trigger_tick = ~std::uint64_t{0};
  sweep.meta.utc_ns = ~std::uint64_t{0};
  EXPECT_NE(draw_scope_text(sweep, whole_window(sweep.meta), {80, 24}), "");
  draw_scope_picture(sweep, {{0, board::Line::acp}}, whole_window(sweep.meta), {480, 360});
  EXPECT_GE(spokes_that_fit(sweep.meta, 0), ScanGeometry::kMinSpokes);
}

TEST(BoardTurn, TakesAsManySpokesAsHavePulses) {
  board::SweepMeta meta = fake_sweep(0).meta;  // 512 pulses a turn
  EXPECT_EQ(spokes_that_fit(meta, 4096), 512u);
  EXPECT_EQ(spokes_that_fit(meta, 256), 256u);
  meta.turn_ticks = 4096 * 4096;
  meta.acp_period *= 3;
  EXPECT_EQ(spokes_that_fit(meta, 4096), 512u) << "an ACP was missing just then";
  meta.acp_period = 1;
  EXPECT_EQ(spokes_that_fit(meta, 4096), 512u) << "there was one too many";
  meta.acp_period = 4096;
  meta.turn_ticks = 0;
  meta.prf_millihertz *= 5;
  EXPECT_EQ(spokes_that_fit(meta, 4096), 2048u);
  meta.spokes_per_turn = 1000;
  EXPECT_EQ(spokes_that_fit(meta, 4096), 1000u) << "the board has formed them";
  meta.spokes_per_turn = 0;
  meta.acp_period = 0;
  EXPECT_EQ(spokes_that_fit(meta, 4096), 4096u) << "not known yet";
}

TEST(BoardTurn, CollectsAWholeTurnFromTheBowOn) {
  const ScanGeometry geometry{.spokes_per_turn = 256, .cells = 256, .bits = 8};
  TurnAssembler assembler(geometry, *RangeScale::find(0.125), 0);
  std::optional<Scan> scan;
  for (std::uint64_t n = 300; !scan && n < 2000; ++n) {
    board::Sweep sweep = fake_sweep(n);
    // One strong sample, twice as far every quarter of a turn; a cell is 0.9 m, a sample 22.3 m.
    for (auto& sample : sweep.samples[0]) sample = 0;
    sweep.samples[0][1 + n % 512 / 128] = 4095;
    if (n == 400) sweep.meta.faults = board::fault::arp_missing;  // before the turn
    if (n == 700) sweep.meta.faults = board::fault::stalled;
    if (n == 1024) sweep.meta.faults = board::fault::acp_missing;  // found out at the turn's end
    scan = assembler.feed(sweep, TrueBearing::from(degrees(30)), {60.0, 5.0});
    EXPECT_EQ(scan.has_value(), n == 1025) << n;
  }
  ASSERT_TRUE(scan);
  EXPECT_EQ(scan->number, 1u);
  EXPECT_TRUE(scan->is_complete());
  EXPECT_EQ(assembler.faults(), board::fault::stalled | board::fault::acp_missing);
  for (const std::uint32_t index : {10u, 80u, 140u, 200u}) {
    const auto& cells = scan->spokes[index]->cells;
    const double middle_m = board::sample_range_m(fake_sweep(0).meta, 0, 1 + index / 64);
    const auto cell = static_cast<std::size_t>(middle_m / (0.125 * 1852 / 256));
    EXPECT_EQ(cells[cell], 255) << index;
    EXPECT_EQ(cells[cell - 30], 0) << index;
    EXPECT_EQ(cells[cell + 30], 0) << index;
  }
}

TEST(BoardTurn, TurnsInvertedVideoTheRightWayRound) {
  board::Sweep sweep = spiky({100}, 0);
  for (auto& sample : sweep.samples[0]) sample = static_cast<std::uint16_t>(4095 - sample);
  sweep.samples[0][100] = 0;
  sweep.meta.channels[0].inverted = true;
  const ScanGeometry geometry{.spokes_per_turn = 256, .cells = 512, .bits = 8};
  const auto cells = cells_of(sweep, 0, geometry, *RangeScale::find(6.0));
  EXPECT_EQ(*std::max_element(cells.begin(), cells.end()), 255);
  EXPECT_EQ(cells[10], 0);
}

}  // namespace
}  // namespace skerry::client

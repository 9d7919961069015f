#include "protocol/wire/spoke_message.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "tests/unit/wire/test_spoke.hpp"

namespace skerry {
namespace {

wire::Spoke message_of(const Spoke& spoke) {
  wire::Spoke message;
  to_message(spoke, message);
  return message;
}

TEST(SpokeMessage, ComesBackWithEveryFieldAtEveryGeometry) {
  for (const std::uint32_t bits : {4u, 8u}) {
    for (const std::uint32_t cells : {256u, 257u, 512u, 1023u, 1024u, 4095u, 4096u}) {
      for (const std::uint32_t spokes : {256u, 360u, 4096u, 8192u}) {
        for (std::size_t scale = 0; scale < RangeScale::kCount; ++scale) {
          const Spoke spoke = test_spoke({spokes, cells, bits}, scale, spokes - 1, cells + bits);
          const auto back = from_message(message_of(spoke));
          ASSERT_TRUE(back.ok()) << back.error().text;
          ASSERT_EQ(difference(spoke, *back), "");
        }
      }
    }
  }
}

TEST(SpokeMessage, FourBitCellsHaveTheNearerInTheLowNibble) {
  Spoke spoke = test_spoke({256, 257, 4}, 0, 0);
  spoke.cells[0] = 0x1;
  spoke.cells[1] = 0xE;
  spoke.cells[256] = 0x7;
  const wire::Spoke message = message_of(spoke);
  ASSERT_EQ(message.cells().size(), 129u);
  EXPECT_EQ(static_cast<std::uint8_t>(message.cells()[0]), 0xE1);
  EXPECT_EQ(static_cast<std::uint8_t>(message.cells()[128]), 0x07);
}

TEST(SpokeMessage, MessageUsedAgainHoldsOnlyTheLastSpoke) {
  wire::Spoke used;
  to_message(test_spoke({8192, 4096, 8}, 11, 8191), used);
  const Spoke small = test_spoke({256, 256, 4}, 0, 3);
  to_message(small, used);
  EXPECT_EQ(used.SerializeAsString(), message_of(small).SerializeAsString());
}

TEST(SpokeMessage, LongitudeOf180BecomesMinus180) {
  wire::Spoke message = message_of(test_spoke({256, 256, 8}, 0, 0));
  message.set_longitude_deg(180);
  const auto spoke = from_message(message);
  ASSERT_TRUE(spoke.ok());
  EXPECT_EQ(spoke->header.own_ship.longitude_deg, -180);
}

TEST(SpokeMessage, CarriesDopplerClassesAndAnInstrumentedRange) {
  wire::Spoke used;
  for (const std::uint32_t cells : {256u, 257u, 258u, 1023u, 4096u}) {
    for (const double share : {1.0 / 16.0, 0.3, 0.9999, 1.0001, 1.25, 1.9531, 2.0}) {
      for (const std::size_t scale : {std::size_t{0}, RangeScale::kCount - 1}) {
        const Spoke spoke = far_doppler_spoke({360, cells, 8}, scale, share, cells);
        to_message(spoke, used);
        EXPECT_EQ(used.doppler().size(), (cells + 3) / 4);
        const auto back = from_message(used);
        ASSERT_TRUE(back.ok()) << back.error().text;
        ASSERT_EQ(difference(spoke, *back), "");
      }
    }
  }
  to_message(test_spoke({256, 256, 8}, 0, 3), used);
  EXPECT_TRUE(used.doppler().empty()) << "of the spoke before";
}

TEST(SpokeMessage, DopplerHasTheNearestCellInTheLowestBits) {
  Spoke spoke = test_spoke({256, 257, 8}, 0, 0);
  spoke.doppler.assign(257, DopplerClass::none);
  spoke.doppler[0] = DopplerClass::approaching;
  spoke.doppler[3] = DopplerClass::receding;
  spoke.doppler[256] = DopplerClass::receding;
  const wire::Spoke message = message_of(spoke);
  ASSERT_EQ(message.doppler().size(), 65u);
  EXPECT_EQ(static_cast<std::uint8_t>(message.doppler()[0]), 0x81);
  EXPECT_EQ(static_cast<std::uint8_t>(message.doppler()[64]), 0x02);
}

struct WrongField {
  const char* what;
  std::function<void(wire::Spoke&)> change;
  WireErrorKind kind;
  const char* named;  // in the text
};

class WrongSpokeMessage : public testing::TestWithParam<WrongField> {};

TEST_P(WrongSpokeMessage, IsRefusedByName) {
  wire::Spoke message = message_of(test_spoke({360, 257, 4}, 7, 359));
  ASSERT_TRUE(from_message(message).ok());
  GetParam().change(message);
  const auto spoke = from_message(message);
  ASSERT_FALSE(spoke.ok());
  EXPECT_EQ(name_of(spoke.error().kind), name_of(GetParam().kind));
  EXPECT_NE(spoke.error().text.find(GetParam().named), std::string::npos) << spoke.error().text;
}

constexpr auto kRange = WireErrorKind::out_of_range;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

INSTANTIATE_TEST_SUITE_P(
    EachField, WrongSpokeMessage,
    testing::Values(
        WrongField{"Radar", [](auto& m) { m.set_radar(65536); }, kRange, "radar"},
        WrongField{"View", [](auto& m) { m.set_view(65536); }, kRange, "view"},
        WrongField{"Index", [](auto& m) { m.set_index(360); }, kRange, "index"},
        WrongField{"FewSpokes", [](auto& m) { m.set_spokes_per_turn(127); }, kRange, "spokes"},
        WrongField{"ManySpokes", [](auto& m) { m.set_spokes_per_turn(8193); }, kRange, "spokes"},
        WrongField{"FewCells", [](auto& m) { m.set_cell_count(127); }, kRange, "cells"},
        WrongField{"ManyCells", [](auto& m) { m.set_cell_count(0xFFFFFFFF); }, kRange, "cells"},
        WrongField{"Bits", [](auto& m) { m.set_bits(5); }, kRange, "bits"},
        WrongField{"Scale", [](auto& m) { m.set_range_scale(12); }, kRange, "range_scale"},
        WrongField{"OtherScale", [](auto& m) { m.set_range_scale(5); }, kRange, "cell_size_m"},
        WrongField{"CellSize", [](auto& m) { m.set_cell_size_m(kNan); }, kRange, "cell_size_m"},
        WrongField{"Pole", [](auto& m) { m.set_latitude_deg(90.001); }, kRange, "latitude_deg"},
        WrongField{"NanLatitude", [](auto& m) { m.set_latitude_deg(kNan); }, kRange,
                   "latitude_deg"},
        WrongField{"East", [](auto& m) { m.set_longitude_deg(180.001); }, kRange, "longitude_deg"},
        WrongField{"Infinity", [](auto& m) { m.set_longitude_deg(kInfinity); }, kRange,
                   "longitude_deg"},
        WrongField{"Utc", [](auto& m) { m.set_utc_ns(1ull << 63); }, kRange, "utc_ns"},
        WrongField{"Scenario", [](auto& m) { m.set_scenario_ns(~0ull); }, kRange, "scenario_ns"},
        WrongField{"ShortCells", [](auto& m) { m.mutable_cells()->pop_back(); },
                   WireErrorKind::truncated, "bytes of cells"},
        WrongField{"NoCells", [](auto& m) { m.clear_cells(); }, WireErrorKind::truncated, "bytes"},
        WrongField{"LongCells", [](auto& m) { m.mutable_cells()->push_back(0); },
                   WireErrorKind::oversized, "bytes of cells"},
        WrongField{"TooNear", [](auto& m) { m.set_cell_size_m(m.cell_size_m() * 0.0624); }, kRange,
                   "cell_size_m"},
        WrongField{"TooFar", [](auto& m) { m.set_cell_size_m(m.cell_size_m() * 2.001); }, kRange,
                   "cell_size_m"},
        WrongField{"NoSize", [](auto& m) { m.set_cell_size_m(0.0); }, kRange, "cell_size_m"},
        WrongField{"ShortDoppler", [](auto& m) { m.set_doppler(std::string(64, 0)); },
                   WireErrorKind::truncated, "bytes of doppler"},
        WrongField{"LongDoppler", [](auto& m) { m.set_doppler(std::string(66, 0)); },
                   WireErrorKind::oversized, "bytes of doppler"},
        WrongField{"NoClass",
                   [](auto& m) {
                     m.set_doppler(std::string(65, 0));
                     (*m.mutable_doppler())[1] = 0x0C;
                   },
                   WireErrorKind::malformed, "doppler of cell 5 is 3"},
        WrongField{"ClassOfNoCell",
                   [](auto& m) {
                     m.set_doppler(std::string(65, 0));
                     (*m.mutable_doppler())[64] = 0x04;
                   },
                   WireErrorKind::malformed, "doppler of cell 257 is 1"},
        WrongField{"HalfByte", [](auto& m) { m.mutable_cells()->back() = 0x10; },
                   WireErrorKind::malformed, "nibble"}),
    [](const auto& each) { return std::string(each.param.what); });

}  // namespace
}  // namespace skerry

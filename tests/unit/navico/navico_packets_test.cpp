#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "protocol/navico/command.hpp"
#include "protocol/navico/frame.hpp"
#include "protocol/navico/locator.hpp"
#include "protocol/navico/report.hpp"
#include "protocol/navico/ship_data.hpp"
#include "protocol/wire/byte_order.hpp"

namespace skerry::navico {
namespace {

Bytes hex(const std::string& digits) {
  Bytes bytes;
  for (std::size_t i = 0; i + 1 < digits.size(); i += 2) {
    bytes.push_back(static_cast<std::uint8_t>(std::stoul(digits.substr(i, 2), nullptr, 16)));
  }
  return bytes;
}

struct Written {
  const char* octets;
  Command command;
  bool halo;
};

// The examples of navico/README.md; spaces left out.
const std::vector<Written>& written() {
  using K = CommandKind;
  static const std::vector<Written> all = {
      {"00C101", {K::prepare, 1}, false},
      {"01C101", {K::transmit, 1}, false},
      {"01C100", {K::transmit, 0}, false},
      {"03C116120000", {K::range, 4630}, false},
      {"05C1080E", {K::bearing_alignment, 3592}, false},
      {"06C100000000010000007F", {K::gain, 127, 1}, false},
      {"06C10200000002000000D3", {K::sea, 211, 2}, false},
      {"06C1040000000000000080", {K::rain, 128}, false},
      {"06C10500000001000000C0", {K::side_lobe, 192, 1}, false},
      {"08C103", {K::interference, 3}, false},
      {"09C101", {K::expansion, 1}, false},
      {"12C102", {K::expansion, 2}, true},
      {"0AC102", {K::boost, 2}, false},
      {"0BC102", {K::sea_state, 2}, false},
      {"0DC10200000001", {K::blanking_on, 1, 0, 2}, false},
      {"C0C10300000001E803B004", {K::blanking_angles, 1, 0, 3, 1000, 1200}, false},
      {"0EC102", {K::local_interference, 2}, false},
      {"0FC103", {K::scan_speed, 3}, false},
      {"10C102", {K::mode, 2}, false},
      {"11C100000001", {K::halo_sea_mode, 0, 0}, true},
      {"11C101000001", {K::halo_sea_mode, 0, 1}, true},
      {"11C100191902", {K::halo_sea, 25}, true},
      {"11C10100CE04", {K::halo_sea_adjust, -50, 1}, true},
      {"21C102", {K::noise_rejection, 2}, false},
      {"22C103", {K::target_separation, 3}, false},
      {"23C101", {K::doppler, 1}, true},
      {"24C14D00", {K::doppler_threshold, 77}, true},
      {"30C10100000028230000", {K::antenna_height, 9000}, false},
      {"30C10300000064000000", {K::antenna_offset, 100}, false},
      {"31C102", {K::accent_light, 2}, false},
      {"40C10807", {K::parking, 1800}, false},
      {"A0C1", {K::stay_alive}, false},
      {"03C2", {K::ask_controls}, false},
      {"04C2", {K::ask_identity}, false},
      {"05C2", {K::ask_installation}, false},
      {"0AC2", {K::ask_other}, false},
  };
  return all;
}

TEST(NavicoCommand, IsReadAndWrittenAsDisplaysDo) {
  for (const Written& each : written()) {
    const Bytes octets = hex(each.octets);
    const auto command = decode_command(octets);
    ASSERT_TRUE(command.ok()) << each.octets << ": " << command.error().text;
    EXPECT_EQ(*command, each.command) << each.octets;
    EXPECT_EQ(encode_command(each.command, each.halo), octets) << each.octets;
  }
}

TEST(NavicoCommand, IsRefusedWhereverItIsCut) {
  for (const Written& each : written()) {
    const Bytes octets = hex(each.octets);
    // The height's command has two octets nobody needs.
    const std::size_t needed = each.command.kind == CommandKind::antenna_height ||
                                       each.command.kind == CommandKind::antenna_offset
                                   ? 8
                                   : octets.size();
    for (std::size_t size = 0; size < needed; ++size) {
      const auto command = decode_command(std::span(octets).first(size));
      ASSERT_FALSE(command.ok()) << each.octets << " cut to " << size;
      EXPECT_EQ(command.error().kind, WireErrorKind::truncated);
      EXPECT_EQ(command.error().offset, size);
    }
  }
  EXPECT_EQ(decode_command(Bytes(65, 0x03)).error().kind, WireErrorKind::oversized);
  EXPECT_EQ(decode_command(hex("FFC101")).error().kind, WireErrorKind::unknown_kind);
  EXPECT_EQ(decode_command(hex("06C1070000000000000000")).error().kind,
            WireErrorKind::unknown_kind);
  EXPECT_EQ(decode_command(hex("11C100000003")).error().kind, WireErrorKind::unknown_kind);
}

TEST(NavicoCommand, OfALongerFormIsObeyedAllTheSame) {
  const auto command = decode_command(hex("01C101000000"));
  ASSERT_TRUE(command.ok());
  EXPECT_EQ(command->kind, CommandKind::transmit);
  // A range beyond 31 bits is a range nobody has, not a negative one.
  EXPECT_EQ(decode_command(hex("03C1FFFFFFFF"))->value, 0x7FFFFFFF);
}

TEST(NavicoReport, OfEveryKindComesBackForEveryModel) {
  BlankedSectors sectors;
  sectors[1] = {true, 1000, 1200};
  sectors[3] = {false, 3599, 0};
  for (const Model model : {Model::br24, Model::g3, Model::g4, Model::halo20, Model::halo}) {
    InstallationReport installation{3592, 1800, 9000, 2, {}};
    if (is_halo(model)) installation.sectors = sectors;
    AdvancedReport advanced{2, 3, 1, true, 192, 2, 3};
    if (is_halo(model)) {
      advanced.halo_sea = 25;
      advanced.halo_sea_adjust = -50;
      advanced.doppler = 2;
      advanced.doppler_threshold_cms = 77;
    }
    std::vector<Report> reports = {
        StateReport{RadarState::standby},
        StateReport{RadarState::spinning_up},
        StateReport{RadarState::transmit},
        ControlReport{44480, 2, true, 127, 2, 211, 128, 3, 1, 2},
        IdentityReport{identity_type(model), 0x01020304, "Sep  9 2021", "19:53:32 182"},
        installation,
        advanced,
    };
    if (is_halo(model)) reports.insert(reports.end(), {BlankingReport{sectors}, HeartbeatReport{}});
    for (const Report& each : reports) {
      const Bytes octets =
          std::visit([&](const auto& fields) { return encode(model, fields); }, each);
      const auto read = decode_report(octets);
      ASSERT_TRUE(read.ok()) << read.error().text;
      EXPECT_EQ(*read, each) << name_of(model) << " report " << each.index();
      for (std::size_t size = 0; size < octets.size(); ++size) {
        const auto cut = decode_report(std::span(octets).first(size));
        // 08C4 has four lengths.
        if (octets[0] == 0x08 && (size == 18 || size == 21)) continue;
        ASSERT_FALSE(cut.ok()) << size;
        EXPECT_LE(cut.error().offset, size);
      }
    }
  }
}

TEST(NavicoReport, OfAnUnknownStateOrLengthIsRefused) {
  Bytes state = encode(Model::g4, StateReport{});
  state[2] = 7;
  EXPECT_EQ(decode_report(state).error().kind, WireErrorKind::out_of_range);
  Bytes longer = encode(Model::g4, ControlReport{});
  longer.push_back(0);
  EXPECT_EQ(decode_report(longer).error().kind, WireErrorKind::oversized);
  EXPECT_EQ(decode_report(Bytes(564, 0xC4)).error().kind, WireErrorKind::unknown_kind);
}

TEST(NavicoReport, NewerFirmwareSaysItsBlankingFurtherBack) {
  const BlankedSector sector{true, 900, 1800};
  Bytes report = encode(Model::halo, BlankingReport{{sector, {}, {}, {}}});
  report.insert(report.begin() + 36, 6, 0x00);
  ASSERT_EQ(report.size(), 74u);
  const auto read = decode_report(report);
  ASSERT_TRUE(read.ok());
  EXPECT_EQ(std::get<BlankingReport>(*read).sectors[0], sector);
}

TEST(NavicoLocator, HasTheLengthAndPlacesDisplaysLookAt) {
  const Locator one = make_locator("2005052778", {ipv4(192, 0, 2, 7), 306}, kAddressesA, {});
  const Bytes octets = encode_locator(one);
  ASSERT_EQ(octets.size(), 150u);
  const auto endpoint_at = [](const Bytes& bytes, std::size_t at) {
    return Ipv4Endpoint{ipv4(bytes[at], bytes[at + 1], bytes[at + 2], bytes[at + 3]),
                        static_cast<std::uint16_t>(bytes[at + 4] << 8 | bytes[at + 5])};
  };
  EXPECT_EQ(endpoint_at(octets, 18), (Ipv4Endpoint{ipv4(192, 0, 2, 7), 306}));
  EXPECT_EQ(endpoint_at(octets, 88), kAddressesA.data);
  EXPECT_EQ(endpoint_at(octets, 98), kAddressesA.send);
  EXPECT_EQ(endpoint_at(octets, 108), kAddressesA.report);
  const Locator two = make_locator("1403", {}, kAddressesA, kAddressesB);
  const Bytes dual = encode_locator(two);
  ASSERT_EQ(dual.size(), 222u);
  EXPECT_EQ(endpoint_at(dual, 124), kAddressesB.data);
  EXPECT_EQ(endpoint_at(dual, 134), kAddressesB.send);
  EXPECT_EQ(endpoint_at(dual, 144), kAddressesB.report);
  for (const Bytes& each : {octets, dual}) {
    for (std::size_t size = 0; size < each.size(); ++size) {
      const auto cut = decode_locator(std::span(each).first(size));
      ASSERT_FALSE(cut.ok()) << size;
      EXPECT_EQ(cut.error().kind, WireErrorKind::truncated) << size;
    }
    EXPECT_TRUE(decode_locator(each).ok());
  }
}

TEST(NavicoLocator, ThatLiesAboutItsServicesIsRefused) {
  Bytes lying = encode_locator(make_locator("1", {}, kAddressesA, {}));
  lying[25] = 0xFF;
  EXPECT_EQ(decode_locator(lying).error().kind, WireErrorKind::truncated);
  lying = encode_locator(make_locator("1", {}, kAddressesA, {}));
  lying[28] = 0x21;
  EXPECT_EQ(decode_locator(lying).error().kind, WireErrorKind::malformed);
  EXPECT_EQ(decode_locator(Bytes(1501, 1)).error().kind, WireErrorKind::oversized);
  EXPECT_EQ(decode_locator(encode_locator_question()).error().kind, WireErrorKind::unknown_kind);
}

// The reach that a display computes from a header (navico/README.md), written out again.
double display_reach_m(Model model, const SpokeRange& range) {
  Bytes header(kSpokeHeader);
  std::copy(range.at_4.begin(), range.at_4.end(), header.begin() + 4);
  std::copy(range.at_12.begin(), range.at_12.end(), header.begin() + 12);
  const auto word = [&](std::size_t at) { return header[at] | header[at + 1] << 8; };
  if (is_first_generation(model)) return (word(12) | header[14] << 16) * 10 / std::sqrt(2.0);
  const int large = word(6), small = word(12);
  if (large == 0x80) return small / 4.0;
  return model == Model::g4 ? large * 64.0 : static_cast<double>(large) * small / 512.0;
}

TEST(NavicoSpokeRange, IsWhatADisplayMakesOfItAndCloseToItsShareOfTheRange) {
  double worst = 0.0;
  for (const Model model : {Model::br24, Model::g3, Model::g4, Model::halo20, Model::halo}) {
    const double share = is_first_generation(model) ? 1.769 : model == Model::g4 ? 1.953 : 1.719;
    for (std::uint32_t dm = kMinRangeDm; dm <= max_range_dm(model); dm += 10 + dm / 500) {
      const SpokeRange range = spoke_range(model, dm);
      const double reach_m = range.reach.in_metres();
      ASSERT_NEAR(reach_m, display_reach_m(model, range), 1e-9) << name_of(model) << " " << dm;
      const bool capped = (model == Model::g4 && reach_m == 72704.0) ||
                          (model == Model::halo20 && reach_m == 57860.0);
      if (capped) continue;
      const double step_m = is_first_generation(model) ? 7.1 : model == Model::g4 ? 64.0 : 4.0;
      const double allowed_m =
          (dm < 41000 && !is_first_generation(model) ? 0.51 : step_m) + dm / 10.0 * 0.001;
      ASSERT_NEAR(reach_m, share * dm / 10.0, allowed_m) << name_of(model) << " " << dm;
      worst = std::max(worst, std::abs(reach_m / (share * dm / 10.0) - 1.0));
    }
  }
  RecordProperty("worst", std::to_string(worst));
}

TEST(NavicoFrame, HasNibblesThatKeepEveryEcho) {
  std::array<std::uint8_t, kSpokeCells> cells{};
  std::iota(cells.begin(), cells.end(), std::uint8_t{0});
  std::array<std::uint8_t, kSpokeCells / 2> nibbles;
  pack_cells(cells, nibbles);
  for (std::size_t i = 0; i < kSpokeCells; ++i) {
    const int nibble = nibbles[i / 2] >> (i % 2 * 4) & 0x0F;
    EXPECT_EQ(nibble, (cells[i] + 16) / 17) << int{cells[i]};
  }
}

Bytes frame_of(std::size_t spokes) {
  Bytes out;
  append_frame_header(out, spokes);
  std::array<std::uint8_t, kSpokeCells / 2> nibbles{};
  nibbles[0] = 0x2F;
  for (std::size_t i = 0; i < spokes; ++i) {
    SpokeFields fields;
    fields.scan = static_cast<std::uint16_t>(i);
    fields.angle = static_cast<std::uint16_t>(2 * i);
    fields.heading = heading_field(TrueBearing::from(degrees(90.0)));
    append_spoke(out, fields, spoke_range(Model::g4, 18520), Model::g4, nibbles);
  }
  return out;
}

TEST(NavicoFrame, ComesBackAndIsRefusedWhereverItLies) {
  const Bytes frame = frame_of(32);
  ASSERT_EQ(frame.size(), 17160u);
  const auto spokes = decode_frame(Model::g4, frame);
  ASSERT_TRUE(spokes.ok());
  ASSERT_EQ(spokes->size(), 32u);
  EXPECT_EQ((*spokes)[31].fields.angle, 62);
  EXPECT_EQ((*spokes)[31].cells[0], 15);
  EXPECT_EQ((*spokes)[31].cells[1], 2);
  EXPECT_EQ((*spokes)[31].fields.reach.in_metres(), 3617.0);
  const auto heading = heading_of((*spokes)[0].fields.heading);
  ASSERT_TRUE(heading.has_value());
  EXPECT_EQ(heading->units, 1024);
  EXPECT_TRUE(heading->is_true);
  EXPECT_FALSE(heading_of(0x8000).has_value());
  EXPECT_FALSE(heading_of(0x9234).has_value());
  EXPECT_EQ(decode_frame(Model::g4, frame_of(1))->size(), 1u);

  for (std::size_t size = 0; size < frame.size(); size += 7) {
    EXPECT_FALSE(decode_frame(Model::g4, std::span(frame).first(size)).ok()) << size;
  }
  for (const std::size_t at : {0u, 5u, 7u, 8u, 8u + 9u}) {
    Bytes wrong = frame;
    wrong[at] ^= 0x10;
    EXPECT_EQ(decode_frame(Model::g4, wrong).error().kind, WireErrorKind::malformed) << at;
  }
}

TEST(NavicoShipData, ComesBackToWithinAStep) {
  for (double degrees = 0.0; degrees < 360.0; degrees += 7.77) {
    const double speed = degrees / 20.0;
    const auto heading = decode_ship_packet(encode(HeadingPacket{0x1234, degrees}));
    const auto navigation = decode_ship_packet(encode(NavigationPacket{7, degrees, speed}));
    const auto moving = decode_ship_packet(encode(SpeedPacket{speed, degrees}));
    ASSERT_TRUE(heading.ok() && navigation.ok() && moving.ok());
    EXPECT_EQ(std::get<HeadingPacket>(*heading).counter, 0x1234);
    EXPECT_NEAR(std::get<HeadingPacket>(*heading).heading_deg, degrees, 0.003);
    EXPECT_NEAR(std::get<NavigationPacket>(*navigation).course_deg, degrees, 0.003);
    EXPECT_NEAR(std::get<NavigationPacket>(*navigation).speed_mps, speed, 0.0051);
    EXPECT_NEAR(std::get<SpeedPacket>(*moving).course_deg, degrees, 0.051);
    EXPECT_NEAR(std::get<SpeedPacket>(*moving).speed_mps, speed, 0.051);
  }
  // In a capture with HDT 296.0 and spokes at 296.02 deg the heading packet says 51657: 295.97 deg.
  Bytes captured = encode(HeadingPacket{1, 296.0});
  EXPECT_EQ(little_endian_at<std::uint16_t>(captured, 65), 51662);
  captured[65] = 0xC9;
  captured[66] = 0xC9;
  EXPECT_NEAR(std::get<HeadingPacket>(*decode_ship_packet(captured)).heading_deg, 295.97, 0.005);
  const Bytes heading = encode(HeadingPacket{1, 359.9999});
  EXPECT_EQ(little_endian_at<std::uint16_t>(heading, 65), 0);
  EXPECT_EQ(heading[36], 0x12);
  EXPECT_EQ(heading[37], 0xF1);
  EXPECT_EQ(encode(SpeedPacket{}).size(), 23u);
  EXPECT_EQ(decode_ship_packet(Bytes(71)).error().kind, WireErrorKind::truncated);
  EXPECT_EQ(decode_ship_packet(Bytes(72)).error().kind, WireErrorKind::unknown_kind);
  Bytes beyond = heading;
  beyond[66] = 0xFF;
  EXPECT_EQ(decode_ship_packet(beyond).error().kind, WireErrorKind::out_of_range);
}

}  // namespace
}  // namespace skerry::navico

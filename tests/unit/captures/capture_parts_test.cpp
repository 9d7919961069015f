// Files of captures, the writer of captures, own ship in them.
#include <gtest/gtest.h>

#include <cstdlib>

#include "protocol/captures/navico_facts.hpp"
#include "protocol/captures/ship_track.hpp"
#include "protocol/navico/locator.hpp"
#include "protocol/navico/report.hpp"
#include "protocol/navico/ship_data.hpp"
#include "protocol/nmea/motion_sentences.hpp"
#include "protocol/nmea/position_sentences.hpp"
#include "protocol/nmea/udp450.hpp"
#include "tests/unit/captures/imported.hpp"

namespace skerry::captures {
namespace {

constexpr Ipv4Endpoint kTo{ipv4(239, 1, 2, 3), 8600};
constexpr UtcTime kMoment{Duration(1'714'564'800'123'456'789)};

Bytes numbers(std::size_t count) {
  Bytes bytes(count);
  for (std::size_t i = 0; i < count; ++i) bytes[i] = static_cast<std::uint8_t>(i * 7 + i / 256);
  return bytes;
}

Bytes capture_of(const std::vector<Bytes>& payloads) {
  Bytes bytes;
  pcap::PcapWriter writer([&](std::span<const std::uint8_t> more) {
    bytes.insert(bytes.end(), more.begin(), more.end());
  });
  for (const Bytes& payload : payloads) writer.add(kMoment, kFrom, kTo, payload);
  return bytes;
}

TEST(PcapWriter, WritesWhatTheReaderReads) {
  std::vector<Bytes> payloads;
  for (const std::size_t size : {0u, 1u, 1472u, 1473u, 17160u, 65507u}) {
    payloads.push_back(numbers(size));
  }
  std::vector<Bytes> got;
  const auto counts = pcap::read_capture(capture_of(payloads), [&](const auto& datagram) {
    EXPECT_EQ(datagram.time, kMoment);
    EXPECT_EQ(datagram.from, kFrom);
    EXPECT_EQ(datagram.to, kTo);
    got.emplace_back(datagram.payload.begin(), datagram.payload.end());
  });
  ASSERT_TRUE(counts.ok()) << counts.error().text;
  EXPECT_EQ(got, payloads);
  EXPECT_EQ(counts->incomplete, 0u);
  EXPECT_EQ(counts->others, 0u);
}

std::size_t datagrams_of(const std::string& path, std::string* problem = nullptr,
                         std::size_t* offset = nullptr) {
  std::size_t count = 0;
  double share = 0.0;
  const auto done = pcap::read_capture_file(
      path, [&](const auto&) { ++count; },
      [&](double so_far) {
        EXPECT_GE(so_far, share);
        EXPECT_LE(so_far, 1.0);
        share = so_far;
        return true;
      });
  if (problem) *problem = done ? "" : done.error().text;
  if (offset) *offset = done ? 0 : done.error().offset;
  return count;
}

TEST(CaptureFile, IsReadPlainAndPacked) {
  const TestFile file(".pcap");
  const std::vector<Bytes> payloads(300, numbers(5000));
  file.write(capture_of(payloads));
  EXPECT_EQ(datagrams_of(file.path()), 300u);
  ASSERT_EQ(std::system(("gzip -kf " + file.path()).c_str()), 0);
  EXPECT_EQ(datagrams_of(file.path() + ".gz"), 300u);

  // Cut: what is before is given.
  ASSERT_EQ(std::system(("truncate -s -3000 " + file.path() + ".gz").c_str()), 0);
  std::string problem;
  const std::size_t got = datagrams_of(file.path() + ".gz", &problem);
  EXPECT_GT(got, 0u);
  EXPECT_LT(got, 300u);
  EXPECT_EQ(problem, "capture: its gzip stream ends too early");
  ::unlink((file.path() + ".gz").c_str());

  std::size_t offset = 0;
  ASSERT_EQ(std::system(("truncate -s 30000 " + file.path()).c_str()), 0);
  EXPECT_GT(datagrams_of(file.path(), &problem, &offset), 3u);
  EXPECT_GT(offset, 20'000u);
  EXPECT_LT(offset, 30'000u);
  EXPECT_NE(problem, "");
}

TEST(CaptureFile, WhatIsNoneIsToldWhy) {
  std::string problem;
  EXPECT_EQ(datagrams_of("/nowhere/at/all.pcap", &problem), 0u);
  EXPECT_EQ(problem, "capture: cannot open it: No such file or directory");
  EXPECT_EQ(datagrams_of(testing::TempDir(), &problem), 0u);
  EXPECT_EQ(problem, "capture: it is a folder");
  const TestFile file(".pcap");
  EXPECT_EQ(datagrams_of(file.path(), &problem), 0u);
  EXPECT_NE(problem, "");
  file.write(numbers(5000));
  EXPECT_EQ(datagrams_of(file.path(), &problem), 0u);
  EXPECT_NE(problem, "");
}

TEST(CaptureFile, IsGivenUpWhenAsked) {
  const TestFile file(".pcap");
  file.write(capture_of({numbers(60'000), numbers(60'000)}));
  const auto done = pcap::read_capture_file(
      file.path(), [](const auto&) {}, [](double) { return false; });
  ASSERT_FALSE(done.ok());
  EXPECT_EQ(done.error().text, "capture: given up");
}

class ShipTrackTest : public testing::Test {
 protected:
  bool hear(const Bytes& payload) { return ship_.hear({kMoment, kFrom, kTo, payload}); }
  bool hear(const std::string& text) { return hear(Bytes(text.begin(), text.end())); }
  ShipTrack ship_;
};

TEST_F(ShipTrackTest, HearsNmeaBareAndInDatagramsOf61162450) {
  EXPECT_FALSE(ship_.known());
  EXPECT_TRUE(hear("noise\r\n") == false);
  EXPECT_TRUE(hear(nmea::encode(nmea::Hdt{123.5}) + nmea::encode(nmea::Rot{-3.0})));
  EXPECT_NEAR(ship_.heading()->in_degrees(), 123.5, 1e-6);
  nmea::Gga gga;
  gga.position = GeoPoint{-33.5, 179.75};
  nmea::Udp450Encoder encoder("GP0001");
  const std::vector<std::string> lines = {nmea::encode(gga)};
  for (const Bytes& datagram : encoder.encode(lines)) EXPECT_TRUE(hear(datagram));
  nmea::Vtg vtg;
  vtg.course_deg = 200.0;
  vtg.speed_kn = 12.5;
  EXPECT_TRUE(hear(nmea::encode(vtg)));
  const wire::OwnShip own = ship_.own_ship(2, kMoment);
  EXPECT_EQ(own.radar(), 2u);
  EXPECT_NEAR(own.latitude_deg(), -33.5, 1e-6);
  EXPECT_NEAR(own.longitude_deg(), 179.75, 1e-6);
  EXPECT_NEAR(own.rate_of_turn_deg_min(), -3.0, 1e-6);
  EXPECT_NEAR(own.course_over_ground_deg(), 200.0, 1e-6);
  EXPECT_NEAR(own.speed_over_ground_kn(), 12.5, 1e-6);
  EXPECT_EQ(own.utc_ns(), 1'714'564'800'123'456'789u);
}

TEST_F(ShipTrackTest, HearsThePacketsOfAHalosNetwork) {
  EXPECT_TRUE(hear(navico::encode(navico::HeadingPacket{1, 270.0})));
  EXPECT_TRUE(hear(navico::encode(navico::NavigationPacket{1, 45.0, 5.0})));
  EXPECT_NEAR(ship_.heading()->in_degrees(), 270.0, 0.01);
  EXPECT_NEAR(ship_.own_ship(0, kMoment).speed_over_ground_kn(), 9.719, 0.01);
  EXPECT_FALSE(ship_.position().has_value());
}

// Both send 22 octets of advanced report; only the HALO24 names a second range.
TEST(NavicoFacts, TellAHalo24FromAHalo20) {
  for (const bool two_ranges : {false, true}) {
    NavicoFacts facts;
    const auto take = [&](const Bytes& payload) {
      facts.take({.time = kMoment, .from = kFrom, .to = kTo, .payload = payload});
    };
    take(navico::encode_locator(
        navico::make_locator("1501000123", kFrom, navico::kAddressesA,
                             two_ranges ? std::optional(navico::kAddressesB) : std::nullopt)));
    take(navico::encode(navico::Model::halo20, navico::AdvancedReport{}));
    EXPECT_EQ(facts.model_of(kFrom.address, {}),
              two_ranges ? navico::Model::halo : navico::Model::halo20);
    EXPECT_EQ(facts.name_of(kFrom.address, {}), two_ranges ? "HALO24" : "HALO20");
  }
}

TEST_F(ShipTrackTest, SaysWhatItHasNotHeard) {
  wire::OwnShip own = ship_.own_ship(0, kMoment);
  EXPECT_TRUE(own.no_position() && own.no_motion() && own.no_heading());
  EXPECT_TRUE(hear(nmea::encode(nmea::Hdt{123.5})));
  own = ship_.own_ship(0, kMoment);
  EXPECT_TRUE(own.no_position() && own.no_motion());
  EXPECT_FALSE(own.no_heading());
  nmea::Rmc rmc;
  rmc.utc = kMoment;
  rmc.position = GeoPoint{1.0, 2.0};
  rmc.speed_kn = 3.0;
  rmc.course_deg = 4.0;
  EXPECT_TRUE(hear(nmea::encode(rmc)));
  own = ship_.own_ship(0, kMoment);
  EXPECT_FALSE(own.no_position() || own.no_motion() || own.no_heading());
}

TEST_F(ShipTrackTest, BelievesNothingThatIsNotValid) {
  nmea::Rmc rmc;
  rmc.utc = kMoment;
  rmc.position = GeoPoint{1.0, 2.0};
  rmc.valid = false;
  rmc.mode = 'N';
  EXPECT_FALSE(hear(nmea::encode(rmc)));
  std::string broken = nmea::encode(nmea::Hdt{10.0});
  broken[8] = '9';
  EXPECT_FALSE(hear(broken));
  EXPECT_FALSE(ship_.known());
}

}  // namespace
}  // namespace skerry::captures

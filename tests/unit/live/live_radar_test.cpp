// A live radar has the cells that the import of a capture of the same datagrams has, is found and
// lost, and is not disturbed by others.
#include "server/live/live_radar.hpp"

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "protocol/navico/model.hpp"
#include "tests/unit/captures/imported.hpp"
#include "tests/unit/pcap/radar_captures.hpp"

namespace skerry::server {
namespace {

using captures::Imported;

LiveSource source_of(const std::string& kind) {
  LiveSource source;
  source.kind = find_live_kind(kind);
  EXPECT_NE(source.kind, nullptr) << kind;
  return source;
}

pcap::Datagram datagram_of(const CapturedDatagram& from) {
  return {from.time, from.from, from.to, from.payload};
}

// Everything that the datagrams of a capture bring, and the name of the radar.
struct Heard {
  LiveRadar::News news;
  std::string name;
};
Heard heard_of(LiveRadar& radar, const std::vector<CapturedDatagram>& capture) {
  Heard heard;
  for (const CapturedDatagram& each : capture) {
    radar.take(datagram_of(each), heard.news);
    radar.look(each.time, heard.news);
    if (radar.picture()) heard.name = radar.picture()->name;
  }
  // The end of a capture that is shorter than a survey.
  radar.look(capture.back().time + LiveRadar::kSurvey, heard.news);
  if (radar.picture()) heard.name = radar.picture()->name;
  return heard;
}

struct Capture {
  const char* file;
  const char* kind;
  const char* name;
  // The first 1.5 s have a sixteenth of a turn, so that the time of a turn is known.  Without it
  // spokes that are missing are not counted.
  bool steady = true;
};

class LiveCaptures : public testing::TestWithParam<Capture> {
 protected:
  void SetUp() override {
    if (!have_radar_captures()) GTEST_SKIP() << kNoRadarCaptures;
  }
};

TEST_P(LiveCaptures, HaveTheCellsOfTheirImport) {
  const Imported file = captures::imported(unpack_radar_capture(GetParam().file));
  LiveRadar radar(source_of(GetParam().kind));
  const auto [news, name] = heard_of(radar, read_radar_capture(GetParam().file));
  const std::vector<Spoke>& expected = file.spokes.at(0);
  ASSERT_EQ(news.spokes.size(), expected.size());
  EXPECT_EQ(name, GetParam().name);
  bool doppler = false;  // the import knows beforehand what a later report tells
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const SpokeHeader &live = news.spokes[i].header, &imported = expected[i].header;
    ASSERT_EQ(news.spokes[i].cells, expected[i].cells) << i;
    doppler |= !news.spokes[i].doppler.empty();
    if (doppler) {
      ASSERT_EQ(news.spokes[i].doppler, expected[i].doppler) << i;
    }
    ASSERT_EQ(live.index, imported.index) << i;
    if (GetParam().steady) {
      ASSERT_EQ(live.sequence, imported.sequence) << i;
    }
    ASSERT_EQ(live.heading.units(), imported.heading.units()) << i;
    // A recording has a picture's range in decimetres.
    ASSERT_NEAR(live.reach().in_metres(), imported.reach().in_metres(),
                0.05 + 1e-6 * imported.reach().in_metres())
        << i;
  }
  const wire::OwnShip ship = radar.own_ship(file.summary.end);
  ASSERT_FALSE(file.own_ships.empty());
  EXPECT_EQ(ship.no_heading(), file.own_ships.back().no_heading());
}

// Every tenth datagram is lost, and each pair of the rest comes in the other order.
TEST_P(LiveCaptures, BearLossAndReordering) {
  std::vector<CapturedDatagram> all = read_radar_capture(GetParam().file), some;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (i % 10 != 9) some.push_back(all[i]);
  }
  for (std::size_t i = 0; i + 1 < some.size(); i += 2) {
    std::swap(some[i], some[i + 1]);
    std::swap(some[i].time, some[i + 1].time);
  }
  LiveRadar radar(source_of(GetParam().kind));
  const LiveRadar::News news = heard_of(radar, some).news;
  ASSERT_GT(news.spokes.size(), 500u);
  for (std::size_t i = 1; i < news.spokes.size(); ++i) {
    const SpokeHeader &before = news.spokes[i - 1].header, &now = news.spokes[i].header;
    ASSERT_GT(now.sequence, before.sequence);
    ASSERT_GE(now.scan, before.scan);
    ASSERT_LE(now.scan, before.scan + 1);
  }
}

INSTANTIATE_TEST_SUITE_P(
    RealRadars, LiveCaptures,
    testing::Values(Capture{"3g-trueheading.pcap.gz", "navico_3g", "3G"},
                    Capture{"4g-ranges-nm.pcap.gz", "navico_4g", "4G"},
                    Capture{"br24-ranges-nm.pcap.gz", "navico_br24", "BR24"},
                    Capture{"halo20-ranges.pcap.gz", "navico_halo20", "HALO20"},
                    Capture{"halo-velocitytrack-notarget.pcap.gz", "navico_halo", "HALO"},
                    Capture{"halo3-5-connect-transmit.pcap.gz", "navico_halo", "HALO", false},
                    Capture{"garminxhd_txon_txoff.pcap.gz", "garmin_xhd", "Garmin xHD"},
                    Capture{"quantum2-solent-03-gain-sea-rain.pcap.gz", "raymarine_quantum",
                            "Raymarine Quantum"},
                    Capture{"raymarine-e120-analog-tx-stdby.pcap.gz", "raymarine_rd",
                            "Raymarine RD"},
                    Capture{"furuno-drs4dnxt.pcap.gz", "furuno_drs", "Furuno DRS4D-NXT"}),
    [](const auto& one) { return test_name_of(one.param.file); });

// A frame of 32 spokes of a BR24 as it leaves one.
std::vector<std::uint8_t> br24_frame(std::uint16_t first) {
  std::vector<std::uint8_t> frame = {1, 0, 0, 0, 0, 32, 0, 2};
  for (std::uint32_t i = 0; i < 32; ++i) {
    const std::uint32_t angle = (first + i) * 2 % 4096, scan = first + i;
    std::vector<std::uint8_t> spoke(536);
    spoke[0] = 24;
    spoke[1] = 2;
    spoke[2] = static_cast<std::uint8_t>(scan);
    spoke[3] = static_cast<std::uint8_t>(scan >> 8 & 15);
    spoke[5] = 0x44;
    spoke[6] = 0x0D;
    spoke[7] = 0x0E;
    spoke[8] = static_cast<std::uint8_t>(angle);
    spoke[9] = static_cast<std::uint8_t>(angle >> 8);
    spoke[11] = 0x80;  // no heading
    spoke[13] = 0x10;
    for (std::size_t c = 24; c < spoke.size(); ++c) spoke[c] = static_cast<std::uint8_t>(c);
    frame.insert(frame.end(), spoke.begin(), spoke.end());
  }
  return frame;
}

constexpr UtcTime kNow{std::chrono::seconds(1'714'564'800)};
constexpr std::uint32_t kRadar = ipv4(192, 0, 2, 7), kOther = ipv4(192, 0, 2, 8);

// Frames of `seconds`, 24 turns a minute; the number of the next.
std::uint16_t feed(LiveRadar& radar, std::uint32_t from, UtcTime& now, double seconds,
                   LiveRadar::News& news, std::uint16_t first = 0,
                   Ipv4Endpoint to = navico::kAddressesA.data) {
  constexpr auto kStep = std::chrono::microseconds(39'062);
  for (UtcTime end = now + seconds_as_duration(seconds); now < end; now += kStep) {
    const auto frame = br24_frame(first);
    radar.take({now, {from, 6678}, to, frame}, news);
    radar.look(now, news);
    first = static_cast<std::uint16_t>((first + 32) % 2048);
  }
  return first;
}

TEST(LiveRadar, IsFoundWithNothingLostOfWhatCameMeanwhile) {
  LiveRadar radar(source_of("navico_br24"));
  LiveRadar::News news;
  UtcTime now = kNow;
  feed(radar, kRadar, now, 1.0, news);
  EXPECT_TRUE(news.spokes.empty());
  EXPECT_FALSE(radar.picture());
  feed(radar, kRadar, now, 1.0, news, 26 * 32);
  ASSERT_TRUE(radar.picture());
  EXPECT_TRUE(news.anew);
  EXPECT_EQ(radar.picture()->name, "BR24");
  EXPECT_NEAR(radar.picture()->rpm, 24.0, 0.5);
  EXPECT_EQ(news.spokes.size(), 52u * 32u);
  EXPECT_EQ(news.spokes.back().header.sequence, 52u * 32u - 1);
  EXPECT_FALSE(radar.settings().standby());
}

TEST(LiveRadar, IsInStandbyAfterSilenceAndComesBack) {
  LiveRadar radar(source_of("navico_br24"));
  LiveRadar::News news;
  UtcTime now = kNow;
  feed(radar, kRadar, now, 2.0, news);
  radar.look(now + std::chrono::milliseconds(4900), news);
  EXPECT_FALSE(news.lost);
  now += std::chrono::milliseconds(5100);
  news = {};
  radar.look(now, news);
  EXPECT_TRUE(news.lost);
  EXPECT_TRUE(news.settings);
  EXPECT_TRUE(radar.settings().standby());
  news = {};
  feed(radar, kRadar, now, 2.0, news);
  EXPECT_TRUE(news.anew);
  EXPECT_FALSE(radar.settings().standby());
  EXPECT_EQ(news.spokes.size(), 52u * 32u);
}

TEST(LiveRadar, BearsAClockThatIsSetBack) {
  LiveRadar radar(source_of("navico_br24"));
  LiveRadar::News news;
  UtcTime now = kNow;
  std::uint16_t next = feed(radar, kRadar, now, 2.0, news);
  now -= std::chrono::hours(1);
  news = {};
  feed(radar, kRadar, now, 1.0, news, next);
  EXPECT_EQ(news.spokes.size(), 26u * 32u);
  news = {};
  radar.look(now + std::chrono::seconds(6), news);
  EXPECT_TRUE(news.lost);
}

TEST(LiveRadar, LeavesASecondRadarAlone) {
  LiveRadar radar(source_of("navico_br24"));
  LiveRadar::News news;
  UtcTime now = kNow;
  feed(radar, kRadar, now, 2.0, news);
  const std::size_t before = news.spokes.size();
  feed(radar, kOther, now, 1.0, news);
  EXPECT_EQ(news.spokes.size(), before);
  EXPECT_EQ(radar.others(), 26u);
}

TEST(LiveRadar, TakesTheOneThatWasNamed) {
  LiveSource source = source_of("navico_br24");
  source.from = kOther;
  LiveRadar radar(source);
  LiveRadar::News news;
  UtcTime now = kNow;
  feed(radar, kRadar, now, 3.0, news);
  EXPECT_FALSE(radar.picture());
  feed(radar, kOther, now, 2.0, news);
  ASSERT_TRUE(radar.picture());
  EXPECT_EQ(radar.picture()->traits.key.from, kOther);
}

TEST(LiveRadar, TakesTheRangeThatWasAskedFor) {
  for (const bool second : {false, true}) {
    LiveSource source = source_of("navico_4g");
    source.second_range = second;
    LiveRadar radar(source);
    LiveRadar::News news;
    UtcTime now = kNow;
    feed(radar, kRadar, now, 2.0, news, 0, navico::kAddressesB.data);
    EXPECT_EQ(radar.picture().has_value(), second);
    feed(radar, kRadar, now, 2.0, news, 0, navico::kAddressesA.data);
    ASSERT_TRUE(radar.picture().has_value());
    EXPECT_EQ(radar.picture()->traits.key.to,
              second ? navico::kAddressesB.data : navico::kAddressesA.data);
  }
}

TEST(LiveRadar, OwnShipThatWasPutIsOnItsSpokes) {
  LiveRadar radar(source_of("navico_br24"));
  radar.put_own_ship({GeoPoint{60.5, 5.0}, 90.0, 95.0, 10.0, {}});
  LiveRadar::News news;
  UtcTime now = kNow;
  feed(radar, kRadar, now, 2.0, news);
  ASSERT_FALSE(news.spokes.empty());
  EXPECT_NEAR(news.spokes.front().header.own_ship.latitude_deg, 60.5, 1e-9);
  EXPECT_NEAR(news.spokes.front().header.heading.in_degrees(), 90.0, 0.01);
  const wire::OwnShip ship = radar.own_ship(now);
  EXPECT_FALSE(ship.no_position());
  EXPECT_DOUBLE_EQ(ship.speed_over_ground_kn(), 10.0);
}

// Frames that are cut, lengthened, of false angles and of noise: refused or read, never more held
// than promised, and the radar's own spokes go on.
TEST(LiveRadar, BearsBrokenDatagrams) {
  std::mt19937 random(7);
  LiveRadar radar(source_of("navico_br24"));
  LiveRadar::News news;
  UtcTime now = kNow;
  std::uint16_t next = feed(radar, kRadar, now, 2.0, news);
  news = {};
  for (int i = 0; i < 3000; ++i) {
    auto frame = br24_frame(static_cast<std::uint16_t>(i * 32 % 2048));
    for (int k = 0; k < 8; ++k) frame[random() % 400] = static_cast<std::uint8_t>(random());
    if (i % 3 == 0) frame.resize(random() % frame.size());
    radar.take({now, {kRadar, 6678}, navico::kAddressesA.data, frame}, news);
    radar.take({now, {kRadar, 6679}, navico::kAddressesA.report, frame}, news);
    radar.take({now, {kRadar, 6878}, navico::kLocatorGroup, frame}, news);
    now += std::chrono::milliseconds(1);
  }
  EXPECT_LE(radar.groups().all().size(), LiveGroups::kMost);
  for (const Spoke& spoke : news.spokes) {
    ASSERT_LT(spoke.header.index, spoke.header.geometry.spokes_per_turn);
    ASSERT_EQ(spoke.cells.size(), spoke.header.geometry.cells);
  }
  news = {};
  feed(radar, kRadar, now, 1.0, news, next);
  EXPECT_EQ(news.spokes.size(), 26u * 32u);
}

// The flood of a radar that is looked for is bounded by octets, not by time.
TEST(LiveRadar, HoldsABoundedPartOfAFlood) {
  LiveRadar radar(source_of("navico_br24"));
  LiveRadar::News news;
  const auto frame = br24_frame(0);
  std::size_t frames = 0;
  while (!radar.picture() && frames < 10'000) {
    radar.take({kNow, {kRadar, 6678}, navico::kAddressesA.data, frame}, news);
    ++frames;
  }
  EXPECT_EQ(frames, LiveRadar::kMostHeld / frame.size() + 1);
}

}  // namespace
}  // namespace skerry::server

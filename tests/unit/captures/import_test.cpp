// Imports of captures made for the test: what captures of real radars do not show.
#include <gtest/gtest.h>

#include <algorithm>

#include "protocol/asterix/cat240.hpp"
#include "protocol/nmea/motion_sentences.hpp"
#include "protocol/nmea/position_sentences.hpp"
#include "protocol/raymarine/quantum_report.hpp"
#include "protocol/raymarine/quantum_spoke.hpp"
#include "protocol/wire/byte_order.hpp"
#include "protocol/wire/datagram.hpp"
#include "tests/unit/captures/imported.hpp"

namespace skerry::captures {
namespace {

constexpr Ipv4Endpoint kCat240{ipv4(239, 1, 2, 3), 8600}, kQuantum{ipv4(232, 1, 1, 1), 2574};

class TestCapture {
 public:
  TestCapture()
      : writer_([this](std::span<const std::uint8_t> bytes) {
          bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
        }) {}

  void add(Duration since_begin, Ipv4Endpoint to, const Bytes& payload) {
    writer_.add(kBegin + since_begin, kFrom, to, payload);
  }
  void add(Duration since_begin, Ipv4Endpoint to, const std::string& text) {
    add(since_begin, to, Bytes(text.begin(), text.end()));
  }
  const Bytes& bytes() const { return bytes_; }

 private:
  Bytes bytes_;
  pcap::PcapWriter writer_;
};

Bytes cells_of(std::size_t count, std::uint32_t index) {
  Bytes cells(count);
  for (std::size_t n = 0; n < count; ++n) cells[n] = static_cast<std::uint8_t>(index * 7 + n);
  return cells;
}

Spoke spoke_of(const ScanGeometry& geometry, std::uint32_t index, double heading_deg) {
  Spoke spoke;
  spoke.header.geometry = geometry;
  spoke.header.index = index;
  spoke.header.heading = TrueBearing::from(degrees(heading_deg));
  spoke.header.range_scale = *RangeScale::find(6.0);
  spoke.header.utc = kBegin;
  spoke.cells = cells_of(geometry.cells, index);
  return spoke;
}

constexpr Duration kStep = std::chrono::milliseconds(7);  // between spokes

// Two views in one stream are two radars; a datagram that is lost takes its spoke with it.
TEST(Import, NativeDatagramsComeBackSpokeBySpoke) {
  for (const std::size_t max_datagram : {kMaxDatagram, kMinDatagram}) {
    constexpr ScanGeometry kGeometry{360, 512, 4};
    TestCapture capture;
    std::vector<Spoke> sent;
    for (std::uint32_t i = 0; i < 2 * 360; ++i) {
      for (std::uint32_t view = 0; view < 2; ++view) {
        Spoke spoke = spoke_of(kGeometry, i % 360, 30.0);
        spoke.header.view = view;
        spoke.header.sequence = i;
        spoke.header.scan = i / 360;
        for (std::uint8_t& cell : spoke.cells) cell = (cell + view) & 15;
        wire::ServerMessage message;
        to_message(spoke, *message.mutable_spoke());
        const std::string body = message.SerializeAsString();
        Bytes scratch;
        std::size_t part = 0;
        for_each_datagram({0, static_cast<std::uint16_t>(view), i},
                          {reinterpret_cast<const std::uint8_t*>(body.data()), body.size()},
                          max_datagram, scratch, [&](std::span<const std::uint8_t> datagram) {
                            if (i == 100 && part++ == 0) return;  // lost
                            capture.add(kStep * i, {ipv4(192, 0, 2, 9), 7411},
                                        Bytes(datagram.begin(), datagram.end()));
                          });
        if (view == 0 && i != 100) sent.push_back(std::move(spoke));
      }
    }
    Imported got = imported(capture.bytes());
    ASSERT_EQ(got.spokes.size(), 2u);
    EXPECT_EQ(got.hello.radars(0).name(), "Skerry radar 0 view 0");
    EXPECT_EQ(got.hello.radars(1).name(), "Skerry radar 0 view 1");
    EXPECT_EQ(got.report.radars[0].counts.missing, 1u);
    ASSERT_EQ(got.spokes[0].size(), sent.size());
    for (std::size_t i = 0; i < sent.size(); ++i) {
      const Spoke &before = sent[i], &now = got.spokes[0][i];
      ASSERT_EQ(now.cells, before.cells) << i;
      ASSERT_EQ(now.header.index, before.header.index);
      ASSERT_EQ(now.header.geometry, before.header.geometry);
      ASSERT_EQ(now.header.heading, before.header.heading);
      ASSERT_EQ(now.header.reach(), before.header.reach());
    }
  }
}

TEST(Import, Cat240KeepsItsBearingsWhetherTheHeadingIsKnownOrNot) {
  constexpr ScanGeometry kGeometry{360, 512, 8};
  for (const bool with_heading : {false, true}) {
    TestCapture capture;
    if (with_heading) {
      capture.add(Duration{}, {ipv4(192, 0, 2, 255), 10110}, nmea::encode(nmea::Hdt{40.3}));
    }
    std::vector<Spoke> sent;
    for (std::uint32_t i = 0; i < 2 * 360; ++i) {
      sent.push_back(spoke_of(kGeometry, i % 360, 40.3));
      capture.add(kStep * i, kCat240, encode_cat240_video(sent.back(), {1, 2}, i));
    }
    const Imported got = imported(capture.bytes());
    ASSERT_EQ(got.hello.radars_size(), 1);
    EXPECT_EQ(got.hello.radars(0).name(), "CAT240 1/2");
    EXPECT_EQ(got.hello.radars(0).spokes_per_turn(), 360u);
    EXPECT_NEAR(got.hello.radars(0).rpm(), 60.0 / (360 * 0.007), 0.2);
    const auto& spokes = got.spokes.at(0);
    ASSERT_EQ(spokes.size(), sent.size());
    for (std::size_t i = 0; i < sent.size(); ++i) {
      EXPECT_EQ(spokes[i].cells, sent[i].cells);
      EXPECT_NEAR((spokes[i].header.bearing() - sent[i].header.bearing()).in_degrees(), 0.0, 0.003);
      EXPECT_NEAR((spokes[i].header.heading - TrueBearing::from(degrees(with_heading ? 40.3 : 0.0)))
                      .in_degrees(),
                  0.0, 0.51);
      EXPECT_NEAR(spokes[i].header.reach().in_nautical_miles(), 6.0, 1e-3);
      EXPECT_EQ(spokes[i].header.utc, kBegin + kStep * static_cast<std::int64_t>(i));
    }
  }
}

TEST(Import, SpokesThatTheCaptureMissesAreGapsInSequenceAndEvents) {
  constexpr ScanGeometry kGeometry{360, 256, 8};
  TestCapture capture;
  for (std::uint32_t i = 0; i < 720; ++i) {
    if (i == 100 || (i >= 400 && i < 410)) continue;
    capture.add(kStep * i, kCat240,
                encode_cat240_video(spoke_of(kGeometry, i % 360, 0.0), {1, 2}, i));
  }
  const Imported got = imported(capture.bytes());
  std::vector<std::uint64_t> gaps;
  for (const auto& event : got.events) {
    if (event.kind() == recording::Event::GAP) gaps.push_back(event.count());
  }
  EXPECT_EQ(gaps, (std::vector<std::uint64_t>{1, 10}));
  EXPECT_EQ(got.spokes.at(0).back().header.sequence, 719u);
  EXPECT_EQ(got.spokes.at(0).size(), 709u);
}

TEST(Import, ShortQuantumSpokesAreFilledUpAtTheirOwnCellSizeAndWaitForTheRange) {
  TestCapture capture;
  for (std::uint32_t i = 0; i < 600; ++i) {
    raymarine::QuantumSpoke spoke;
    spoke.sequence = static_cast<std::uint16_t>(i);
    spoke.cells_per_range = 50;
    spoke.azimuth = static_cast<std::uint16_t>(i % 250);
    spoke.cells = cells_of(100, i);
    for (auto& cell : spoke.cells) cell = std::min<std::uint8_t>(cell, 200);
    Bytes bytes;
    append_quantum_spoke(bytes, spoke);
    capture.add(kStep * i, kQuantum, bytes);
    if (i == 30) {
      raymarine::QuantumStatus status;
      status.transmits = true;
      status.range_index = 7;  // 1 NM
      status.controls[0].gain = 40;
      capture.add(kStep * i, kQuantum, encode_quantum_status(status));
    }
  }
  const Imported got = imported(capture.bytes());
  const auto& spokes = got.spokes.at(0);
  ASSERT_EQ(spokes.size(), 600u);
  const FittedCounts& counts = got.report.radars[0].counts;
  EXPECT_EQ(counts.range_unknown, 31u);
  EXPECT_EQ(counts.padded, 600u);
  EXPECT_EQ(got.report.radars[0].picture.cells, 100u);
  for (const Spoke& spoke : spokes) {
    ASSERT_EQ(spoke.cells.size(), ScanGeometry::kMinCells);
    EXPECT_NEAR(spoke.header.cell_size().in_metres(), 1852.0 / 50.0, 1e-6);
    EXPECT_EQ(spoke.cells[100], 0);
  }
  // From the stern.
  EXPECT_EQ(spokes[0].header.index, 125u);
  EXPECT_EQ(got.settings.back().gain(), 40.0);
  EXPECT_NE(got.summary.attachments.at(0).bytes.find("\"cells_decoded\": 100"), std::string::npos);
}

TEST(Import, TwoRadarsBecomeTwoAndOwnShipIsOfBoth) {
  TestCapture capture;
  nmea::Rmc rmc;
  rmc.utc = kBegin;
  rmc.position = GeoPoint{60.5, 5.25};
  rmc.speed_kn = 10.0;
  rmc.course_deg = 90.0;
  constexpr Ipv4Endpoint kNmea{ipv4(239, 192, 0, 4), 60004};
  for (std::uint32_t i = 0; i < 800; ++i) {
    if (i % 20 == 0) capture.add(kStep * i, kNmea, nmea::encode(rmc));
    const std::uint8_t sic = i % 2 == 0 ? 1 : 2;
    const ScanGeometry geometry{sic == 1 ? 360u : 720u, 256, 4};
    Spoke spoke = spoke_of(geometry, i / 2, 0.0);
    for (auto& cell : spoke.cells) cell &= 0x0F;
    capture.add(kStep * i, kCat240, encode_cat240_video(spoke, {9, sic}, i / 2));
  }
  const Imported got = imported(capture.bytes());
  ASSERT_EQ(got.spokes.size(), 2u);
  EXPECT_EQ(got.hello.radars(0).spokes_per_turn(), 360u);
  EXPECT_EQ(got.hello.radars(1).spokes_per_turn(), 720u);
  EXPECT_EQ(got.spokes.at(1).size(), 400u);
  EXPECT_EQ(got.spokes.at(1)[3].header.geometry.bits, 4u);
  // Once a second, of each radar.
  EXPECT_EQ(got.own_ships.size(), 10u);
  EXPECT_EQ(got.own_ships[1].radar(), 1u);
  EXPECT_NEAR(got.own_ships[1].speed_over_ground_kn(), 10.0, 1e-6);
  EXPECT_NEAR(got.spokes.at(0)[10].header.own_ship.latitude_deg, 60.5, 1e-6);
}

TEST(Import, OfACutCaptureWhatIsBeforeTheCutIsThereAndTheByteIsTold) {
  TestCapture capture;
  for (std::uint32_t i = 0; i < 400; ++i) {
    capture.add(kStep * i, kCat240,
                encode_cat240_video(spoke_of({360, 256, 8}, i % 360, 0.0), {1, 2}, i));
  }
  const std::size_t frame = (capture.bytes().size() - 24) / 400;
  const Imported got = imported(std::span(capture.bytes()).first(24 + 300 * frame + frame / 2));
  EXPECT_EQ(got.spokes.at(0).size(), 300u);
  ASSERT_TRUE(got.report.damage.has_value());
  EXPECT_EQ(got.report.damage->offset, 24 + 300 * frame);
}

TEST(Import, MorePicturesThanThereMayBeAreLeftOut) {
  TestCapture capture;
  for (std::uint32_t i = 0; i < 40; ++i) {
    capture.add(
        kStep * i, kCat240,
        encode_cat240_video(spoke_of({360, 256, 8}, i, 0.0), {1, static_cast<std::uint8_t>(i)}, i));
  }
  const Imported got = imported(capture.bytes());
  EXPECT_EQ(got.spokes.size(), kMaxPictures);
  EXPECT_EQ(got.report.left_out, 40 - kMaxPictures);
}

// Such spokes never learn how far they reach.
TEST(Import, Cat240OfCellsWithoutDurationIsCountedAndLeftOut) {
  TestCapture capture;
  for (std::uint32_t i = 0; i < 20; ++i) {
    Bytes sent = encode_cat240_video(spoke_of({360, 256, 8}, i, 0.0), {1, 2}, i);
    if (i % 4 == 3) {
      Bytes duration;
      append_big_endian(duration, decode_cat240(sent)->at(0).video->cell_duration, 4);
      const auto at = std::search(sent.begin(), sent.end(), duration.begin(), duration.end());
      ASSERT_NE(at, sent.end());
      std::fill_n(at, 4, std::uint8_t{0});
    }
    capture.add(kStep * i, kCat240, sent);
  }
  const Imported got = imported(capture.bytes());
  EXPECT_EQ(got.spokes.at(0).size(), 15u);
  EXPECT_EQ(got.report.radars.at(0).picture.refused, 5u);
  EXPECT_EQ(got.report.radars.at(0).counts.range_unknown, 0u);
}

TEST(Import, GivesUpWhenAskedTo) {
  TestCapture capture;
  capture.add(kStep, kCat240, encode_cat240_video(spoke_of({360, 256, 8}, 0, 0.0), {1, 2}, 0));
  recording::RecordingWriter writer([](std::span<const std::uint8_t>) { return true; }, {});
  const auto done = import_capture(
      [&](const DatagramSink& sink, const ImportProgress&) {
        return pcap::read_capture(capture.bytes(), sink);
      },
      "test.pcap", writer, [](double share) { return share < 0.5; });
  ASSERT_FALSE(done.ok());
  EXPECT_EQ(done.error().text, "given up");
}

}  // namespace
}  // namespace skerry::captures

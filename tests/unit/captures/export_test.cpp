// Recordings as captures of other protocols, read again by the import and by tshark.
#include "protocol/captures/exporter.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <functional>

#include "tests/unit/captures/imported.hpp"
#include "tests/unit/pcap/radar_captures.hpp"

namespace skerry::captures {
namespace {

// A recording of one radar with own ship and settings: `spokes` spokes.
void write_recording(const std::string& path, const ScanGeometry& geometry, std::uint32_t spokes,
                     double reach_m, const std::function<void(wire::OwnShip&)>& change = {}) {
  std::ofstream file(path, std::ios::binary);
  recording::RecordingWriter writer(
      [&](std::span<const std::uint8_t> bytes) {
        file.write(reinterpret_cast<const char*>(bytes.data()),
                   static_cast<std::streamsize>(bytes.size()));
        return file.good();
      },
      {});
  wire::Settings settings;
  settings.set_radar(1);
  settings.set_gain(60.0);
  settings.set_rain(20.0);
  wire::OwnShip ship;
  ship.set_radar(1);
  ship.set_latitude_deg(60.25);
  ship.set_longitude_deg(5.5);
  ship.set_heading_deg(33.0);
  if (change) change(ship);
  const auto add = [&](recording::Topic topic, const google::protobuf::MessageLite& message) {
    const std::string bytes = message.SerializeAsString();
    writer.add(
        {topic, kBegin, {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}});
  };
  add({recording::Kind::settings, 1, 0}, settings);
  add({recording::Kind::own_ship, 1, 0}, ship);
  for (std::uint32_t i = 0; i < spokes; ++i) {
    Spoke spoke;
    spoke.header.radar = 1;
    spoke.header.sequence = i;
    spoke.header.geometry = geometry;
    spoke.header.index = i % geometry.spokes_per_turn;
    spoke.header.scan = i / geometry.spokes_per_turn;
    spoke.header.heading = TrueBearing::from(degrees(33.0));
    spoke.header.range_scale = *RangeScale::find(6.0);
    spoke.header.instrumented_range = metres(reach_m);
    spoke.header.utc = kBegin + std::chrono::microseconds(1200) * i;
    spoke.cells.resize(geometry.cells);
    for (std::size_t n = 0; n < spoke.cells.size(); ++n) {
      spoke.cells[n] = static_cast<std::uint8_t>((i + n) % (geometry.bits == 4 ? 16 : 251));
    }
    writer.add(spoke);
  }
  ASSERT_TRUE(writer.finish());
}

Bytes exported(const std::string& recording, const ExportOptions& options, ExportReport& report) {
  Bytes bytes;
  pcap::PcapWriter out([&](std::span<const std::uint8_t> more) {
    bytes.insert(bytes.end(), more.begin(), more.end());
  });
  const auto reader = recording::RecordingReader::open(recording);
  EXPECT_TRUE(reader.ok());
  if (!reader) return bytes;
  const auto done = export_capture(*reader, options, out);
  EXPECT_TRUE(done.ok()) << (done.ok() ? "" : done.error().to_string());
  if (done) report = *done;
  return bytes;
}

std::string output_of(const std::string& command) {
  std::string text;
  if (std::FILE* pipe = ::popen(command.c_str(), "r")) {
    char block[4096];
    for (std::size_t got; (got = std::fread(block, 1, sizeof block, pipe)) > 0;) {
      text.append(block, got);
    }
    ::pclose(pipe);
  }
  return text;
}

TEST(Export, Cat240ComesBackWithItsCellsBearingsAndShip) {
  const TestFile file(".mcap");
  write_recording(file.path(), {2048, 700, 8}, 3000, 12'000.0);
  ExportReport report;
  ExportOptions options;
  options.radar = 1;
  const Imported got = imported(exported(file.path(), options, report));
  EXPECT_EQ(report.spokes, 3000u);
  Imported source;
  open_items(file.path(), source);
  const auto &sent = source.spokes.at(1), &back = got.spokes.at(0);
  ASSERT_EQ(back.size(), sent.size());
  for (std::size_t i = 0; i < sent.size(); ++i) {
    ASSERT_EQ(back[i].cells, sent[i].cells) << i;
    ASSERT_NEAR((back[i].header.bearing() - sent[i].header.bearing()).in_degrees(), 0.0, 0.003);
    ASSERT_NEAR(back[i].header.reach().in_metres(), 12'000.0, 0.01);
    ASSERT_EQ(back[i].header.utc, sent[i].header.utc);
    ASSERT_EQ(back[i].header.index, sent[i].header.index);
  }
  EXPECT_NEAR(back.back().header.own_ship.latitude_deg, 60.25, 1e-4);
  EXPECT_NEAR(got.own_ships.back().heading_deg(), 33.0, 0.1);
}

// A network with a log but no GPS.
TEST(Export, SpeedAndCourseGoWithoutAPosition) {
  const TestFile file(".mcap");
  write_recording(file.path(), {360, 256, 8}, 720, 6000.0, [](wire::OwnShip& ship) {
    ship.set_no_position(true);
    ship.set_course_over_ground_deg(45.0);
    ship.set_speed_over_ground_kn(9.5);
  });
  ExportReport report;
  ExportOptions options;
  options.radar = 1;
  const Imported got = imported(exported(file.path(), options, report));
  ASSERT_FALSE(got.own_ships.empty());
  const wire::OwnShip& ship = got.own_ships.back();
  EXPECT_TRUE(ship.no_position());
  EXPECT_FALSE(ship.no_motion());
  EXPECT_NEAR(ship.speed_over_ground_kn(), 9.5, 0.01);
  EXPECT_NEAR(ship.course_over_ground_deg(), 45.0, 0.1);
}

TEST(Export, TsharkReadsTheCat240OfIt) {
  if (output_of("tshark --version 2>/dev/null").empty()) GTEST_SKIP() << "tshark is not installed";
  const TestFile file(".mcap"), pcap(".pcap");
  write_recording(file.path(), {360, 256, 4}, 720, 10'000.0);
  ExportReport report;
  ExportOptions options;
  options.radar = 1;
  pcap.write(exported(file.path(), options, report));
  const std::string records =
      output_of("tshark -r " + pcap.path() +
                " -T fields -e asterix.240_020_VALUE 2>/dev/null | grep -c '[0-9]'");
  EXPECT_EQ(std::atoi(records.c_str()), 720) << records;
  const std::string malformed = output_of(
      "tshark -r " + pcap.path() +
      " -o ip.check_checksum:TRUE -Y '_ws.malformed || ip.checksum.status == Bad' 2>/dev/null");
  EXPECT_EQ(malformed, "");
}

TEST(Export, NavicoOfAnotherShapeKeepsItsPeaks) {
  const TestFile file(".mcap");
  write_recording(file.path(), {720, 512, 8}, 2160, 9000.0);
  for (const auto model : {navico::Model::halo20, navico::Model::halo, navico::Model::g4}) {
    ExportReport report;
    ExportOptions options;
    options.format = ExportFormat::navico;
    options.model = model;
    options.radar = 1;
    const Imported got = imported(exported(file.path(), options, report));
    EXPECT_EQ(got.hello.radars(0).name(), navico::name_of(model));
    const auto& spokes = got.spokes.at(0);
    EXPECT_GT(spokes.size(), 6000u);  // 2048 a turn
    EXPECT_NEAR(spokes[100].header.reach().in_metres(), 9000.0, 40.0);
    EXPECT_NEAR(spokes[100].header.heading.in_degrees(), 33.0, 0.1);
    EXPECT_NEAR(got.settings.back().gain(), 60.0, 0.4);
    EXPECT_EQ(spokes[100].cells.size(), 1024u);
    EXPECT_EQ(*std::max_element(spokes[100].cells.begin(), spokes[100].cells.end()), 15);
  }
}

TEST(Export, APartAloneAndAnUnknownRadarIsToldWhichThereAre) {
  const TestFile file(".mcap");
  write_recording(file.path(), {2048, 256, 8}, 2000, 9000.0);
  ExportReport report;
  ExportOptions options;
  options.radar = 1;
  options.from = kBegin + std::chrono::microseconds(1200) * 500;
  options.to = kBegin + std::chrono::microseconds(1200) * 600;
  const Imported got = imported(exported(file.path(), options, report));
  EXPECT_EQ(got.spokes.at(0).size(), 100u);

  options.radar = 4;
  pcap::PcapWriter out([](std::span<const std::uint8_t>) {});
  const auto reader = recording::RecordingReader::open(file.path());
  ASSERT_TRUE(reader.ok());
  const auto done = export_capture(*reader, options, out);
  ASSERT_FALSE(done.ok());
  EXPECT_EQ(done.error().text, "it has no spokes of radar 4 view 0; there are radar 1 view 0");
}

// A real coast there and back: nothing of it is lost.
TEST(Export, ACaptureOfAHalo20ComesBackAsItWas) {
  if (!have_radar_captures()) GTEST_SKIP() << kNoRadarCaptures;
  const TestFile file(".mcap");
  Imported first;
  import_into(file.path(), unpack_radar_capture("halo20-ranges.pcap.gz"), first);
  ExportReport report;
  ExportOptions options;
  options.format = ExportFormat::navico;
  const Imported again = imported(exported(file.path(), options, report));
  EXPECT_EQ(report.spokes_cut, 0u);
  const auto &sent = first.spokes.at(0), &back = again.spokes.at(0);
  ASSERT_EQ(back.size(), sent.size());
  std::size_t other_reach = 0;
  for (std::size_t i = 0; i < sent.size(); ++i) {
    ASSERT_EQ(back[i].cells, sent[i].cells) << i;
    ASSERT_EQ(back[i].header.index, sent[i].header.index) << i;
    other_reach += back[i].header.reach() != sent[i].header.reach();
  }
  EXPECT_EQ(other_reach, 0u);
  EXPECT_EQ(again.report.radars[0].counts.missing, first.report.radars[0].counts.missing);
}

}  // namespace
}  // namespace skerry::captures

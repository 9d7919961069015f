#include "tests/unit/playback/recorded_file.hpp"

#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "protocol/recording/recording.pb.h"

namespace skerry::server {
namespace {

using recording::Kind;
using recording::RecordingWriter;
using recording::Topic;

std::string new_folder() {
  std::string pattern =
      (std::filesystem::temp_directory_path() / "skerry-playback-XXXXXX").string();
  if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no folder for a test's file");
  return pattern;
}

wire::Hello hello_of(const RecordedScene& scene) {
  wire::Hello hello;
  hello.set_protocol_version(1);
  hello.set_scenario("recorded scene");
  for (const std::uint32_t radar : scene.radars) {
    wire::RadarInfo& info = *hello.add_radars();
    info.set_radar(radar);
    info.set_name("radar of ship " + std::to_string(radar));
    info.set_own_ship("ship " + std::to_string(radar));
    info.set_spokes_per_turn(scene.spokes_per_turn);
    info.set_cells(scene.cells);
    info.set_bits(8);
    info.set_rpm(60.0 / in_seconds(scene.turn));
    info.set_board(true);
  }
  return hello;
}

// Writes the state at a second of the recording: gain, latitude, sea state and a target tell which.
void write_second(const RecordedScene& scene, int second, RecordingWriter& writer) {
  const UtcTime time = kRecordedAt + std::chrono::seconds(second);
  for (const std::uint32_t radar : scene.radars) {
    for (const std::uint32_t view : scene.views) {
      wire::Settings settings;
      settings.set_radar(radar);
      settings.set_view(view);
      settings.set_range_nm(6.0);
      settings.set_gain(second);
      if (scene.settings) add(writer, {Kind::settings, radar, view}, time, settings);
    }
    wire::OwnShip ship;
    ship.set_radar(radar);
    ship.set_name("ship " + std::to_string(radar));
    ship.set_latitude_deg(60.0 + second / 3600.0);
    ship.set_longitude_deg(5.0);
    ship.set_speed_over_ground_kn(60.0);
    if (scene.own_ship) add(writer, {Kind::own_ship, radar, 0}, time, ship);
  }
  wire::World world;
  world.set_sea_state(second % 6);
  add(writer, {Kind::world, 0, 0}, time, world);
  recording::Traffic traffic;
  recording::Traffic::Item& target = *traffic.add_items();
  target.set_number(1);
  target.set_name("target");
  target.set_latitude_deg(60.5);
  target.set_longitude_deg(5.0 + second * 0.01);
  target.add_radars(scene.radars.back());
  if (scene.traffic) add(writer, {Kind::traffic, 0, 0}, time, traffic);
  if (scene.exercise) add(writer, {Kind::exercise}, time, recorded_exercise(scene, second));
}

void write_scene(const RecordedScene& scene, RecordingWriter& writer) {
  if (scene.hello) add(writer, {Kind::hello, 0, 0}, kRecordedAt, hello_of(scene));
  auto mark = scene.marks.begin();
  int second = 0;
  for (std::uint64_t n = 0; n < std::uint64_t{scene.turns} * scene.spokes_per_turn; ++n) {
    const UtcTime time = recorded_spoke(scene, 0, 0, n).header.utc;
    for (; kRecordedAt + std::chrono::seconds(second) <= time; ++second) {
      write_second(scene, second, writer);
    }
    for (; mark != scene.marks.end() && kRecordedAt + mark->first <= time; ++mark) {
      recording::Event event;
      event.set_kind(recording::Event::MARK);
      event.set_text(mark->second);
      event.set_mark_kind(scene.mark_kind);
      add(writer, {Kind::event, 0, 0}, kRecordedAt + mark->first, event);
    }
    for (const std::uint32_t radar : scene.radars) {
      for (const std::uint32_t view : scene.views) {
        Spoke spoke = recorded_spoke(scene, radar, view, n);
        if (!scene.change || scene.change(spoke)) writer.add(spoke);
      }
    }
  }
}

}  // namespace

Spoke recorded_spoke(const RecordedScene& scene, std::uint32_t radar, std::uint32_t view,
                     std::uint64_t n) {
  Spoke spoke;
  SpokeHeader& header = spoke.header;
  header.radar = radar;
  header.view = view;
  header.sequence = scene.first_sequence + n;
  header.scan = scene.first_scan + static_cast<std::uint32_t>(n / scene.spokes_per_turn);
  header.index = static_cast<std::uint32_t>(n % scene.spokes_per_turn);
  header.geometry = {scene.spokes_per_turn, scene.cells, 8};
  header.range_scale = *RangeScale::find(6.0);
  header.own_ship = {60.25, 5.125};
  header.heading = TrueBearing::from(degrees(90.0));
  const Duration since = scene.turn * static_cast<std::int64_t>(n) / scene.spokes_per_turn;
  header.utc = kRecordedAt + since;
  header.scenario_time = ScenarioTime(std::chrono::seconds(100) + since);
  spoke.cells.resize(scene.cells);
  for (std::size_t cell = 0; cell < spoke.cells.size(); ++cell) {
    spoke.cells[cell] = static_cast<std::uint8_t>(n * 31 + cell * 7 + radar * 3 + view);
  }
  return spoke;
}

wire::ExerciseState recorded_exercise(const RecordedScene& scene, int second) {
  wire::ExerciseState state;
  state.set_exercise_s(2.0 * second);
  state.set_rate(2.0);
  state.set_can_undo("put");
  state.add_snapshots("before");
  state.set_last_order("put");
  wire::ExerciseShip& own = *state.add_ships();
  own.set_own(true);
  own.set_name("own");
  own.set_latitude_deg(60.0 + second * 0.001);
  own.set_longitude_deg(5.0);
  own.add_radars(scene.radars.back());
  own.add_radars(77);  // not in the recording
  wire::ExerciseShip& target = *state.add_ships();
  target.set_number(1);
  target.set_name("target");
  target.set_latitude_deg(60.0 + second / 3600.0);
  target.set_longitude_deg(5.0);
  target.set_speed_kn(30.0);  // 30 miles in an hour of the exercise, which is half an hour
  return state;
}

RecordedFile::RecordedFile(const RecordedScene& scene, const recording::WriterOptions& options)
    : RecordedFile([&](RecordingWriter& writer) { write_scene(scene, writer); }, options) {}

RecordedFile::RecordedFile(const std::function<void(RecordingWriter&)>& write,
                           const recording::WriterOptions& options)
    : folder_(new_folder()), path_(folder_ + "/scene.mcap") {
  std::ofstream file(path_, std::ios::binary);
  RecordingWriter writer(
      [&](std::span<const std::uint8_t> bytes) {
        file.write(reinterpret_cast<const char*>(bytes.data()),
                   static_cast<std::streamsize>(bytes.size()));
        return file.good();
      },
      options);
  write(writer);
  if (!writer.finish()) throw std::runtime_error("cannot write " + path_);
}

RecordedFile::~RecordedFile() {
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

recording::RecordingReader RecordedFile::open() const {
  auto reader = recording::RecordingReader::open(path_);
  if (!reader) throw std::runtime_error(reader.error().to_string());
  return std::move(reader).value();
}

void RecordedFile::cut(std::size_t size) const { std::filesystem::resize_file(path_, size); }
std::size_t RecordedFile::size() const { return std::filesystem::file_size(path_); }

}  // namespace skerry::server

#include "tests/unit/debrief/recorded_inputs.hpp"

#include <fstream>

#include "protocol/quantity/time.hpp"
#include "protocol/recording/writer.hpp"

namespace skerry::server {
namespace {

constexpr UtcTime kBegan{std::chrono::seconds(1'790'000'000)};

}  // namespace

void RecordedInputs::order(std::uint64_t tick, const wire::ExerciseOrder& order) {
  recording::Input& input = inputs.emplace_back();
  input.mutable_exercise()->set_tick(tick);
  *input.mutable_exercise()->mutable_order() = order;
  input.mutable_exercise()->set_by("instructor");
}

void RecordedInputs::helm(std::uint64_t tick, std::uint32_t own_ship, double course_deg) {
  recording::Input& input = inputs.emplace_back();
  input.mutable_order()->set_tick(tick);
  input.mutable_order()->set_own_ship(own_ship);
  input.mutable_order()->set_course_deg(course_deg);
}

void RecordedInputs::engine(std::uint64_t tick, std::uint32_t own_ship, double speed_kn) {
  recording::Input& input = inputs.emplace_back();
  input.mutable_order()->set_tick(tick);
  input.mutable_order()->set_own_ship(own_ship);
  input.mutable_order()->set_speed_kn(speed_kn);
}

std::string bytes_of(const RecordedInputs& recorded) {
  std::string file;
  recording::RecordingWriter writer(
      [&](std::span<const std::uint8_t> bytes) {
        file.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
        return true;
      },
      recording::WriterOptions{});
  writer.attach({"scenario.yaml", "application/yaml", kBegan, recorded.yaml});
  const auto add = [&](recording::Topic topic, double at_s, const std::string& bytes) {
    writer.add({topic,
                kBegan + seconds_as_duration(at_s),
                {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}});
  };
  recording::Input input;
  input.mutable_began()->set_utc_ns(static_cast<std::uint64_t>(kBegan.time_since_epoch().count()));
  input.mutable_began()->set_server("skerryd of a test");
  add({recording::Kind::input}, 0.0, input.SerializeAsString());
  input.mutable_taken()->set_warm_up(true);
  add({recording::Kind::input}, 0.0, input.SerializeAsString());
  for (const recording::Input& each : recorded.inputs) {
    add({recording::Kind::input}, 0.0, each.SerializeAsString());
  }
  for (const RecordedInputs::Setting& each : recorded.settings) {
    add({recording::Kind::settings, each.radar, each.view}, each.at_s,
        each.settings.SerializeAsString());
  }
  for (const RecordedInputs::Known& each : recorded.known) {
    add({recording::Kind::targets, each.radar, each.view}, each.at_s,
        each.list.SerializeAsString());
  }
  for (const RecordedInputs::Written& each : recorded.audit) {
    add({recording::Kind::audit}, each.at_s, each.entry.SerializeAsString());
  }
  input.mutable_reached()->set_first(1600);
  add({recording::Kind::input}, recorded.length_s, input.SerializeAsString());
  writer.finish();
  return file;
}

std::string write_bytes(const std::filesystem::path& folder, const std::string& bytes) {
  std::filesystem::create_directories(folder);
  const std::string path = (folder / "exercise.mcap").string();
  std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
  return path;
}

}  // namespace skerry::server

#include "tests/unit/replay/live_exercise.hpp"

#include <openssl/sha.h>

#include <array>
#include <fstream>
#include <map>
#include <random>
#include <stdexcept>

#include "protocol/recording/writer.hpp"
#include "protocol/wire/spoke_message.hpp"
#include "server/app/exercise_files.hpp"
#include "server/app/options/charts.hpp"
#include "server/world/scenario.hpp"

namespace skerry::server {
namespace {

constexpr UtcTime kSomeTime{std::chrono::seconds(1'790'000'000)};

// A sector of which nothing but its spokes matters.
EncodedSectorPtr no_bytes(const Sector& sector) {
  auto encoded = std::make_shared<EncodedSector>();
  encoded->spoke_ends.resize(sector.spokes.size());
  return encoded;
}

// One change of what an operator, an instructor or a simulator outside may change.
class Changer {
 public:
  Changer(RadarServer& server, SpokeCollector& collector)
      : server_(server), collector_(collector) {}

  void change(unsigned number) {
    order(number);
    wire::Set set;
    set.set_radar(random(3));
    switch (number % 10) {
      case 0:
        set.set_gain(random(100));
        set.set_sea_auto(random(2) == 1);
        break;
      case 1:
        set.set_range_nm(std::array{0.75, 1.5, 3.0, 6.0}[random(4)]);
        break;
      case 2:
        set.set_course_deg(random(360));
        set.set_speed_kn(20.0 + random(30));
        break;
      case 3:
        set.mutable_world()->set_sea_state(random(6));
        set.mutable_world()->set_wind_from_deg(random(360));
        set.mutable_world()->set_visibility_nm(number % 20 == 3 ? 0.3 : 30.0);
        break;
      case 4:
        set.set_transmit(number % 20 != 4);
        break;
      case 5:
        set.set_rotation_rpm(40.0 + random(20));
        break;
      case 6:
        open_view();
        return;
      case 7:
        set.set_pulse(static_cast<wire::PulseChoice>(random(4)));
        set.set_integration(random(100));
        break;
      case 8: {
        OwnShipFix fix;
        fix.heading_deg = random(360);
        fix.speed_mps = 10.0;
        server_.drive(2, fix);
        return;
      }
      default: {
        wire::RainChange& rain = *set.mutable_world()->add_rain();
        rain.set_latitude_deg(60.43);
        rain.set_longitude_deg(5.03);
        rain.set_rate_mm_h(1.0 + random(20));
        rain.set_kind(static_cast<wire::RainKind>(random(4)));
        rain.set_drift_kn(random(40));
      }
    }
    // An order to a driven ship is refused, which is no change.
    server_.apply(set, "test");
  }

 private:
  unsigned random(unsigned below) {
    return std::uniform_int_distribution<unsigned>(0, below - 1)(random_);
  }
  // As an instructor; what there is nothing of to restore or undo is refused, which is no change.
  void order(unsigned number) {
    wire::Set set;
    set.set_instructor(true);
    wire::ExerciseOrder& order = *set.mutable_exercise();
    switch (number % 9) {
      case 0:
        order.mutable_clock()->set_rate(0.5 * (1 + random(6)));
        break;
      case 1:
        order.mutable_new_target()->set_latitude_deg(60.42 + 0.0001 * random(300));
        order.mutable_new_target()->set_longitude_deg(5.02 + 0.0001 * random(300));
        order.mutable_new_target()->set_course_deg(random(360));
        order.mutable_new_target()->set_speed_kn(random(15));
        break;
      case 2:
        order.mutable_target()->set_target(random(2));
        order.mutable_target()->set_course_deg(random(360));
        break;
      case 3:
        order.set_snapshot("kept");
        break;
      case 4:
        order.mutable_clock()->set_frozen(number % 2 == 0);
        break;
      case 5:
        order.mutable_fault()->set_own_ship(random(2));
        order.mutable_fault()->mutable_faults()->set_gyro_bias_deg(random(20));
        order.mutable_fault()->mutable_faults()->set_gnss_north_m(random(900));
        order.mutable_fault()->mutable_faults()->set_radar_power_loss_db(random(20));
        order.mutable_fault()->mutable_faults()->set_radar_spoke_loss_percent(random(50));
        break;
      case 6:
        order.set_undo(true);
        break;
      case 7:
        order.mutable_own_ship()->set_own_ship(1);
        order.mutable_own_ship()->set_heading_deg(random(360));
        break;
      default:
        order.set_restore("kept");
    }
    server_.apply(set, "instructor");
  }
  void open_view() {
    const auto opened = server_.open_view(
        0, 0, false, [this](VideoChannel& channel) { collector_.listen(channel); });
    if (!opened) return;
    wire::Set set;
    set.set_view(*opened);
    set.set_gain(random(100));
    set.set_doppler(wire::DOPPLER_BOTH);
    server_.apply(set, "test");
  }

  RadarServer& server_;
  SpokeCollector& collector_;
  std::mt19937 random_{5};
};

// Hashes of at most a hundred consecutive spokes of each radar and view.
std::vector<recording::Input> checkpoints_of(const std::vector<SpokePtr>& spokes) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<SpokePtr>> views;
  for (const SpokePtr& spoke : spokes) {
    views[{spoke->header.radar, spoke->header.view}].push_back(spoke);
  }
  std::vector<recording::Input> inputs;
  wire::Spoke message;
  for (const auto& [key, of_view] : views) {
    for (std::size_t begin = 0; begin < of_view.size(); begin += 100) {
      const std::size_t end = std::min(begin + 100, of_view.size());
      std::string bytes;
      for (std::size_t i = begin; i < end; ++i) {
        to_message(*of_view[i], message);
        bytes += message.SerializeAsString();
      }
      std::array<unsigned char, SHA256_DIGEST_LENGTH> digest{};
      SHA256(reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size(), digest.data());
      recording::Input input;
      recording::Input::Checkpoint& checkpoint = *input.mutable_checkpoint();
      checkpoint.set_radar(key.first);
      checkpoint.set_view(key.second);
      checkpoint.set_first_sequence(of_view[begin]->header.sequence);
      checkpoint.set_spokes(end - begin);
      checkpoint.set_sha256(std::string(digest.begin(), digest.end()));
      inputs.push_back(input);
    }
  }
  return inputs;
}

}  // namespace

std::string exercise_yaml(unsigned seed) {
  return "name: Exercise\nseed: " + std::to_string(seed) + R"(
sea: {state: 3}
own_ships:
  - name: Tern
    position: {lat: 60.425, lon: 5.040}
    course_deg: 335
    speed_kn: 45
    turn_time_constant_s: 1
    max_rate_of_turn_deg_min: 720
    radars:
      - {name: Eight bits, spokes: 256, cells: 256, bits: 8, rpm: 60, range_nm: 1.5}
      - {name: Four bits, spokes: 512, cells: 256, bits: 4, rpm: 48, range_nm: 3, set: 30 kW S}
  - name: Gannet
    position: {lat: 60.44, lon: 5.03}
    course_deg: 5
    speed_kn: 40
    radars:
      - {name: Far, spokes: 256, cells: 512, bits: 8, rpm: 50, range_nm: 6}
targets:
  - {name: Tanker, position: {lat: 60.445, lon: 5.020}, course_deg: 160, speed_kn: 10,
     length_m: 182, beam_m: 32, height_m: 22}
  - {name: Ferry, position: {lat: 60.42, lon: 5.03}, course_deg: 80, speed_kn: 11, gives_way: early}
)";
}

void SpokeCollector::listen(VideoChannel& channel) {
  FormatRing& ring = channel.add_format("collector", [this](const Sector& sector) {
    {
      const std::lock_guard lock(mutex_);
      spokes_.insert(spokes_.end(), sector.spokes.begin(), sector.spokes.end());
    }
    came_.notify_all();
    return no_bytes(sector);
  });
  readers_.push_back(ring.on_publish([] {}));
}

void SpokeCollector::await_more(std::size_t more) {
  std::unique_lock lock(mutex_);
  const std::size_t wanted = spokes_.size() + more;
  came_.wait(lock, [&] { return spokes_.size() >= wanted; });
}

std::vector<SpokePtr> SpokeCollector::end() {
  readers_.clear();
  return std::move(spokes_);
}

RecordedParts run_exercise(unsigned changes, unsigned seed, Duration ago) {
  RecordedParts parts;
  parts.documents = exercise_documents(exercise_yaml(seed), {});
  SpokeCollector collector;
  RadarServer server(parse_scenario(exercise_yaml(seed), "exercise.yaml"), open_charts({}, {}), 0,
                     parts.documents);
  for (std::uint32_t radar = 0; radar < 3; ++radar)
    collector.listen(*server.find_channel(radar, 0));
  Changer changer(server, collector);
  server.start(ago);
  for (unsigned i = 0; i < changes; ++i) {
    collector.await_more(64);
    changer.change(i);
  }
  collector.await_more(64);
  server.stop();
  for (auto some = server.exercise()->since(0); !some.empty();
       some = server.exercise()->since(parts.inputs.size())) {
    parts.inputs.insert(parts.inputs.end(), some.begin(), some.end());
  }
  for (std::string& reached : server.exercise()->reached()) {
    parts.inputs.push_back(std::move(reached));
  }
  parts.spokes = collector.end();
  return parts;
}

std::string write_recording(const std::filesystem::path& folder, const RecordedParts& parts,
                            bool checkpoints) {
  std::filesystem::create_directories(folder);
  const std::string path = (folder / (checkpoints ? "inputs.mcap" : "video.mcap")).string();
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  recording::RecordingWriter writer(
      [&](std::span<const std::uint8_t> bytes) {
        file.write(reinterpret_cast<const char*>(bytes.data()),
                   static_cast<std::streamsize>(bytes.size()));
        return file.good();
      },
      recording::WriterOptions{});
  for (const ExerciseDocument& document : parts.documents) {
    writer.attach({document.name, document.media_type, kSomeTime, document.bytes});
  }
  const auto add = [&](const std::string& bytes) {
    writer.add(
        recording::Item{{recording::Kind::input},
                        kSomeTime,
                        {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}});
  };
  for (const std::string& input : parts.inputs) add(input);
  if (checkpoints) {
    for (const recording::Input& input : checkpoints_of(parts.spokes)) {
      add(input.SerializeAsString());
    }
  } else {
    for (const SpokePtr& spoke : parts.spokes) writer.add(*spoke);
  }
  if (!writer.finish()) throw std::runtime_error("cannot write " + path);
  return path;
}

}  // namespace skerry::server

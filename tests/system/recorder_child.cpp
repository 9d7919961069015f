// recorder_child FOLDER TALE NAME [WORD...]: records a radar that never ends, to be killed.  Prints
// "recording" once it does, and a line for every change of its recorder's phase.  Words:
//   quiet      the radar sends nothing        calm       it sends a tenth as much
//   exercise   there is one, without inputs   inputs     they alone are recorded
//   one        the first of two radars        all-views  every view
//   none, zstd compression, instead of lz4    compact    spokes by their differences
//   roll-size, roll-time                      a series of files
#include <fcntl.h>
#include <spdlog/spdlog.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <string>
#include <thread>
#include <vector>

#include "protocol/recording/inputs.pb.h"
#include "tests/system/recorder_child.hpp"
#include "tests/unit/recorder/recorder_kit.hpp"

namespace {

using namespace skerry;
using namespace skerry::server;
using system_test::ChildsTale;

constexpr std::chrono::milliseconds kSectorTime{2};  // 8000 spokes, 8 MB a second
constexpr std::chrono::milliseconds kCalmTime{20};
constexpr std::size_t kRingSectors = 1024;

std::uint64_t steady_ns() {
  return static_cast<std::uint64_t>(std::chrono::steady_clock::now().time_since_epoch().count());
}

// Of an exercise that is given nothing.
class QuietExercise final : public ExerciseInputs {
 public:
  std::vector<std::string> since(std::size_t) const override { return {}; }
  // ChildsTale says what it means.
  std::vector<std::string> reached() const override {
    recording::Input input;
    input.mutable_reached()->set_first(steady_ns());
    return {input.SerializeAsString()};
  }
  std::vector<ExerciseDocument> documents() const override { return {}; }
};

class ChildsHost final : public RecordedHost {
 public:
  ChildsHost(std::uint32_t radars, bool has_one) : RecordedHost(radars, kRingSectors) {
    has_exercise = has_one;
  }
  const ExerciseInputs* exercise() const override { return has_exercise ? &quiet_ : nullptr; }
  wire::OwnShip own_ship(std::uint32_t radar) const override {
    wire::OwnShip ship = RecordedHost::own_ship(radar);
    ship.set_utc_ns(steady_ns());
    return ship;
  }

 private:
  QuietExercise quiet_;
};

ChildsTale* map_tale(const char* path) {
  const int file = ::open(path, O_RDWR);
  void* memory = ::mmap(nullptr, sizeof(ChildsTale), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  ::close(file);
  return memory == MAP_FAILED ? nullptr : static_cast<ChildsTale*>(memory);
}

void tell(ChildsTale& tale, std::uint64_t spokes) {
  const std::uint64_t number = tale.entries.load();
  ChildsTale::Entry& entry = tale.told[number % ChildsTale::kEntries];
  entry.steady_ns = std::chrono::steady_clock::now().time_since_epoch().count();
  entry.spokes = spokes;
  tale.entries = number + 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) return 2;
  const std::vector<std::string> words(argv + 4, argv + argc);
  const auto is = [&](const char* word) {
    return std::find(words.begin(), words.end(), word) != words.end();
  };
  spdlog::set_level(spdlog::level::off);  // it would write to standard output
  ChildsTale* tale = map_tale(argv[2]);
  if (tale == nullptr) return 2;
  ChildsHost host(is("one") ? 2 : 1, is("exercise") || is("inputs"));
  tale->begin_utc_ns = host.begin_utc.time_since_epoch().count();
  RecorderConfig config;
  config.folder = argv[1];
  config.reserve_bytes = 0;
  config.sync = Sync::none;  // what is written outlives the process; a slow disk is not the matter
  if (is("none")) config.compression = recording::Compression::none;
  if (is("zstd")) config.compression = recording::Compression::zstd;
  config.compact = is("compact");
  if (is("roll-size")) config.roll_bytes = 20'000;
  if (is("roll-time")) config.roll_time = std::chrono::seconds(1);
  Recorder recorder(host, config);
  recorder.start();
  wire::Record start = record_of(wire::Record::START, argv[3]);
  start.set_inputs_only(is("inputs"));
  start.set_all_views(is("all-views"));
  if (is("one")) start.add_radars(0);
  recorder.record(start, "test");
  wire::RecorderState::Phase phase = wire::RecorderState::OFF;
  auto next = std::chrono::steady_clock::now();
  for (;;) {
    if (!is("quiet")) host.publish();
    tell(*tale, host.published());
    const wire::RecorderState state = recorder.state();
    if (state.phase() != phase && !state.file().empty()) {
      phase = state.phase();
      std::printf("%s\n", phase == wire::RecorderState::RECORDING   ? "recording"
                          : phase == wire::RecorderState::DISK_FULL ? "full"
                                                                    : "failed");
      std::fflush(stdout);
    }
    std::this_thread::sleep_until(next += is("calm") || is("quiet") ? kCalmTime : kSectorTime);
  }
}

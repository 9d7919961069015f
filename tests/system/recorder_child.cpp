// recorder_child FOLDER TALE NAME: records a radar that never ends, to be killed.  Prints
// "recording" once it does, and a line for every change of its recorder's phase.
#include <fcntl.h>
#include <spdlog/spdlog.h>
#include <sys/mman.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <thread>

#include "tests/system/recorder_child.hpp"
#include "tests/unit/recorder/recorder_kit.hpp"

namespace {

using namespace skerry;
using namespace skerry::server;
using system_test::ChildsTale;

constexpr std::chrono::milliseconds kSectorTime{2};  // 8000 spokes, 8 MB a second
constexpr std::size_t kRingSectors = 1024;

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
  if (argc != 4) return 2;
  spdlog::set_level(spdlog::level::off);  // it would write to standard output
  ChildsTale* tale = map_tale(argv[2]);
  if (tale == nullptr) return 2;
  RecordedHost host(1, kRingSectors);
  tale->begin_utc_ns = host.begin_utc.time_since_epoch().count();
  RecorderConfig config;
  config.folder = argv[1];
  config.reserve_bytes = 0;
  config.sync = Sync::none;  // what is written outlives the process; a slow disk is not the matter
  Recorder recorder(host, config);
  recorder.start();
  recorder.record(record_of(wire::Record::START, argv[3]), "test");
  wire::RecorderState::Phase phase = wire::RecorderState::OFF;
  auto next = std::chrono::steady_clock::now();
  for (;;) {
    host.publish();
    tell(*tale, host.published());
    const wire::RecorderState state = recorder.state();
    if (state.phase() != phase && !state.file().empty()) {
      phase = state.phase();
      std::printf("%s\n", phase == wire::RecorderState::RECORDING   ? "recording"
                          : phase == wire::RecorderState::DISK_FULL ? "full"
                                                                    : "failed");
      std::fflush(stdout);
    }
    std::this_thread::sleep_until(next += kSectorTime);
  }
}

// recorder_bench: what a recorder costs the radar's thread, and what it takes.
//
// "publish" is the time the radar's thread spends on handing over a sector of 16 spokes of 1024
// cells, 100 a second as a radar of 24 rpm and 4096 spokes, with nobody reading, with a console, a
// recorder, and both.  "taken" is how fast a recorder takes spokes from the ring into a file in the
// page cache when they come without a pause, in bytes of spokes a second.
#include <benchmark/benchmark.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>
#include <vector>

#include "server/net/common/encoders.hpp"
#include "tests/unit/recorder/recorder_kit.hpp"

namespace skerry::server {
namespace {

using std::chrono::steady_clock;

RecorderConfig config_in(const ScratchFolder& folder) {
  RecorderConfig config;
  config.folder = folder.path();
  config.reserve_bytes = 0;
  return config;
}

// A turn as a coast has it: runs of strong cells, noise, and much empty sea.
std::vector<Sector> turn_of(const RecordedHost& host, std::uint32_t sectors) {
  std::vector<Sector> turn(sectors);
  std::uint32_t random = 1;
  for (std::uint32_t i = 0; i < sectors * FakeHost::kSectorSpokes; ++i) {
    Spoke spoke = host.spoke(0, i);
    for (std::uint32_t c = 0; c < spoke.cells.size(); ++c) {
      random = random * 1664525u + 1013904223u;
      const bool coast = c > 400 + (i / 7) % 90 && c < 560 + (i / 3) % 50;
      const std::uint32_t noise = random >> 24;
      spoke.cells[c] = static_cast<std::uint8_t>(coast ? 128 + noise / 2 : noise > 245 ? 20 : 0);
    }
    turn[i / FakeHost::kSectorSpokes].spokes.push_back(std::make_shared<Spoke>(std::move(spoke)));
  }
  return turn;
}

void publish(benchmark::State& state, bool console, bool record) {
  const ScratchFolder folder;
  RecordedHost host;
  const VideoChannelPtr channel = host.find_channel(0, 0);
  const std::vector<Sector> turn = turn_of(host, 64);
  std::atomic<std::uint64_t> woken{0};
  FormatRing::Registration registration;
  if (console) {
    registration = channel->format(kNativeFormat).on_publish([&] { ++woken; });
  }
  Recorder recorder(host, config_in(folder));
  if (record) {
    recorder.start();
    recorder.record(record_of(wire::Record::START), "bench");
    if (!reaches(recorder, wire::RecorderState::RECORDING)) state.SkipWithError("not recording");
  }
  std::vector<double> times_us;
  std::size_t next = 0;
  auto due = steady_clock::now();
  for (auto _ : state) {
    std::this_thread::sleep_until(due += std::chrono::milliseconds(10));
    const auto from = steady_clock::now();
    channel->publish(turn[next++ % turn.size()]);
    const std::chrono::duration<double> took = steady_clock::now() - from;
    state.SetIterationTime(took.count());
    times_us.push_back(took.count() * 1e6);
  }
  std::sort(times_us.begin(), times_us.end());
  state.counters["median_us"] = times_us[times_us.size() / 2];
  state.counters["p99_us"] = times_us[times_us.size() * 99 / 100];
  if (record) state.counters["lost"] = static_cast<double>(recorder.state().spokes_lost());
}

void taken(benchmark::State& state, recording::Compression compression) {
  const ScratchFolder folder;
  RecordedHost host(1, 4096);
  RecorderConfig config = config_in(folder);
  config.compression = compression;
  config.sync = Sync::none;
  Recorder recorder(host, config);
  recorder.start();
  recorder.record(record_of(wire::Record::START), "bench");
  if (!reaches(recorder, wire::RecorderState::RECORDING)) state.SkipWithError("not recording");
  const std::vector<Sector> turn = turn_of(host, 256);
  const VideoChannelPtr channel = host.find_channel(0, 0);
  std::uint64_t published = 0, bytes = 0;
  for (auto _ : state) {
    for (const Sector& sector : turn) {
      channel->publish(sector);
      published += sector.spokes.size();
      for (const SpokePtr& spoke : sector.spokes) bytes += spoke->cells.size();
    }
    const auto all = [&] {
      const wire::RecorderState now = recorder.state();
      return now.spokes() + now.spokes_lost();
    };
    while (all() + turn.size() * FakeHost::kSectorSpokes < published) std::this_thread::yield();
  }
  state.SetBytesProcessed(static_cast<std::int64_t>(bytes));
  state.counters["lost"] = static_cast<double>(recorder.state().spokes_lost());
}

void register_all() {
  const auto add = [](const char* name, bool console, bool record) {
    benchmark::RegisterBenchmark(name,
                                 [=](benchmark::State& state) { publish(state, console, record); })
        ->UseManualTime()
        ->Iterations(200);
  };
  add("publish/nobody", false, false);
  add("publish/console", true, false);
  add("publish/recorder", false, true);
  add("publish/both", true, true);
  const auto take = [](const char* name, recording::Compression compression) {
    benchmark::RegisterBenchmark(name, [=](benchmark::State& state) { taken(state, compression); })
        ->UseRealTime()
        ->Iterations(50);
  };
  take("taken/none", recording::Compression::none);
  take("taken/lz4", recording::Compression::lz4);
  take("taken/zstd", recording::Compression::zstd);
}

}  // namespace
}  // namespace skerry::server

int main(int argc, char** argv) {
  spdlog::set_level(spdlog::level::warn);
  skerry::server::register_all();
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}

// playback_bench: how fast a recording is played, what that costs, and how soon a jump shows its
// picture.
//
// The recordings: 40 turns (100 s) of the full scene, 4096 spokes of 1024 cells at 24 rpm, in the
// page cache; of one radar or two, in the forms that the recorder writes.  Google Benchmark.
#include <benchmark/benchmark.h>
#include <spdlog/spdlog.h>
#include <sys/resource.h>

#include <atomic>
#include <chrono>
#include <map>
#include <memory>
#include <stdexcept>
#include <thread>
#include <utility>
#include <variant>
#include <vector>

#include "clients/common/spoke_client.hpp"
#include "protocol/wire/radar.pb.h"
#include "protocol/wire/spoke_message.hpp"
#include "server/net/common/encoders.hpp"
#include "server/playback/playback_host.hpp"
#include "tests/bench/child_server.hpp"
#include "tests/bench/recorded_turn.hpp"
#include "tests/unit/playback/recorded_file.hpp"

namespace skerry::bench {
namespace {

using namespace std::chrono_literals;
using namespace skerry::server;
using client::SpokeClient;
using recording::Compression;
using recording::WriterOptions;

constexpr std::chrono::seconds kLongest{60};  // of a playback: then it is given up
constexpr std::uint32_t kSpokes = 4096, kTurns = 40;

enum Form : std::int64_t { kLz4, kZstd, kCompact };

std::vector<std::vector<std::uint8_t>> cells_of_turn() {
  std::vector<std::vector<std::uint8_t>> cells;
  wire::Spoke message;
  for (const RecordedTurn::Spoke& spoke : simulated_turn().spokes) {
    message.ParseFromArray(spoke.bytes.data(), static_cast<int>(spoke.bytes.size()));
    cells.push_back(from_message(message).value().cells);
  }
  return cells;
}

const RecordedFile& file(Form form, std::int64_t radars) {
  static const auto cells = cells_of_turn();
  static std::map<std::pair<Form, std::int64_t>, std::unique_ptr<RecordedFile>> files;
  auto& recorded = files[{form, radars}];
  if (!recorded) {
    RecordedScene scene{.spokes_per_turn = kSpokes, .cells = 1024, .turns = kTurns, .turn = 2500ms};
    scene.radars = radars == 2 ? std::vector<std::uint32_t>{0, 1} : std::vector<std::uint32_t>{0};
    scene.change = [](Spoke& spoke) {
      spoke.cells = cells[spoke.header.index];
      return true;
    };
    WriterOptions options;
    if (form != kLz4) options.compression = Compression::zstd;
    options.compact = form == kCompact;
    recorded = std::make_unique<RecordedFile>(scene, options);
  }
  return *recorded;
}

// Takes every sector of the native format on a thread of its own, as a recorder does.
class Reader {
 public:
  explicit Reader(FormatRing& ring)
      : ring_(ring),
        registration_(ring.on_publish([] {})),
        cursor_(ring.cursor_at_end()),
        thread_([this](const std::stop_token& stop) {
          while (!stop.stop_requested()) {
            while (const EncodedSectorPtr sector = ring_.take(cursor_)) {
              spokes_ += sector->spoke_count();
              bytes_ += sector->bytes.size();
            }
            lost_ = cursor_.spokes_lost;
            std::this_thread::sleep_for(1ms);
          }
        }) {}
  std::uint64_t spokes() const { return spokes_; }
  std::uint64_t bytes() const { return bytes_; }
  std::uint64_t lost() const { return lost_; }

 private:
  FormatRing& ring_;
  FormatRing::Registration registration_;
  Cursor cursor_;
  std::atomic<std::uint64_t> spokes_{0}, bytes_{0}, lost_{0};
  std::jthread thread_;
};

struct Served {
  Served(const RecordedFile& recorded, const PlayerOptions& options)
      : host(recorded.open(), options, "bench") {
    for (std::uint32_t radar = 0; radar < host.radar_count(); ++radar) {
      channels.push_back(host.find_channel(radar, 0));
      readers.push_back(
          std::make_unique<Reader>(channels.back()->add_format(kNativeFormat, native_encoder())));
    }
  }
  ~Served() { host.stop(); }
  std::uint64_t sum(std::uint64_t (Reader::*of)() const) const {
    std::uint64_t sum = 0;
    for (const auto& reader : readers) sum += (*reader.*of)();
    return sum;
  }
  PlaybackHost host;
  std::vector<VideoChannelPtr> channels;
  std::vector<std::unique_ptr<Reader>> readers;
};

double cpu_seconds() {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds(used.ru_utime) + seconds(used.ru_stime);
}

// From the first spoke to the last one taken: `pace` times the recorded one, spokes lost to the
// readers, CPU time of the playback and the readers together by spoke.
void play(benchmark::State& state, double rate) {
  const RecordedFile& recorded = file(static_cast<Form>(state.range(0)), state.range(1));
  const std::uint64_t spokes = std::uint64_t{kSpokes} * kTurns * state.range(1);
  std::uint64_t lost = 0, bytes = 0;
  double cpu = 0.0;
  for (auto _ : state) {
    Served served(recorded, {.rate = rate});
    const double cpu_before = cpu_seconds();
    const auto before = std::chrono::steady_clock::now();
    served.host.start();
    while (served.sum(&Reader::spokes) + served.sum(&Reader::lost) < spokes) {
      std::this_thread::sleep_for(1ms);
    }
    state.SetIterationTime(
        std::chrono::duration<double>(std::chrono::steady_clock::now() - before).count());
    cpu += cpu_seconds() - cpu_before;
    lost += served.sum(&Reader::lost);
    bytes += served.sum(&Reader::bytes);
  }
  const auto runs = static_cast<double>(state.iterations());
  state.SetBytesProcessed(static_cast<std::int64_t>(bytes));
  state.counters["pace"] = benchmark::Counter(2.5 * kTurns * runs, benchmark::Counter::kIsRate);
  state.counters["lost"] = static_cast<double>(lost);
  state.counters["cpu_us/spoke"] = 1e6 * cpu / (runs * static_cast<double>(spokes));
}

void PlaysAt100(benchmark::State& state) { play(state, 100.0); }
// Whatever it reaches: it never waits.
void PlaysAtOnce(benchmark::State& state) { play(state, 1e6); }

void recordings(benchmark::internal::Benchmark* bench) {
  bench->ArgNames({"lz4_zstd_compact", "radars"})->Unit(benchmark::kMillisecond)->UseManualTime();
  bench->Iterations(1);
  for (const Form form : {kLz4, kZstd, kCompact}) {
    for (const std::int64_t radars : {1, 2}) bench->Args({form, radars});
  }
}
BENCHMARK(PlaysAt100)->Apply(recordings);
BENCHMARK(PlaysAtOnce)->Apply(recordings);

// At a rate of 100 from the built skerryd over TCP to a console for each radar; CPU time of the
// server and of the consoles.
void ConsolesAt100(benchmark::State& state) {
  const RecordedFile& recorded = file(static_cast<Form>(state.range(0)), state.range(1));
  const auto radars = static_cast<std::uint32_t>(state.range(1));
  std::uint64_t lost = 0;
  double served_cpu = 0.0, consoles_cpu = 0.0;
  for (auto _ : state) {
    const ChildServer server({"--play", recorded.path(), "--play-paused", "--play-rate", "100"});
    std::vector<SpokeClient> consoles;
    for (std::uint32_t radar = 0; radar < radars; ++radar) {
      consoles.push_back(SpokeClient::connect("127.0.0.1", server.tcp_port(), 5s).value());
      if (!consoles.back().subscribe(radar, 0, 5s)) throw std::runtime_error("not subscribed");
    }
    wire::Playback request;
    request.set_playing(true);
    const double cpu_before = cpu_seconds(), served_before = server.cpu_seconds();
    const auto before = std::chrono::steady_clock::now();
    if (!consoles.front().playback(request, 5s)) throw std::runtime_error("it does not play");
    std::vector<std::jthread> threads;
    for (SpokeClient& console : consoles) {
      threads.emplace_back([&console] {
        std::uint64_t spokes = 0;
        const auto until = std::chrono::steady_clock::now() + kLongest;
        while (spokes + console.losses().lost() < std::uint64_t{kSpokes} * kTurns &&
               std::chrono::steady_clock::now() < until) {
          const auto event = console.receive(5s);
          if (!event || !*event) break;  // what is missing shows as a low pace
          if (std::holds_alternative<Spoke>(**event)) ++spokes;
        }
      });
    }
    threads.clear();
    state.SetIterationTime(
        std::chrono::duration<double>(std::chrono::steady_clock::now() - before).count());
    served_cpu += server.cpu_seconds() - served_before;
    consoles_cpu += cpu_seconds() - cpu_before;
    for (const SpokeClient& console : consoles) lost += console.losses().lost();
  }
  const auto runs = static_cast<double>(state.iterations());
  const double spokes = runs * kSpokes * kTurns * radars;
  state.counters["pace"] = benchmark::Counter(2.5 * kTurns * runs, benchmark::Counter::kIsRate);
  state.counters["lost"] = static_cast<double>(lost);
  state.counters["cpu_us/spoke"] = 1e6 * served_cpu / spokes;
  state.counters["console_us/spoke"] = 1e6 * consoles_cpu / spokes;
}
BENCHMARK(ConsolesAt100)->Apply(recordings);

// From the order to the first spoke of the turn that is shown.
void SeeksToFirstSpoke(benchmark::State& state) {
  spdlog::set_level(spdlog::level::warn);
  Served served(file(kLz4, 1), {.playing = false});
  served.host.start();
  double place = 3.0;
  const auto spokes = [&] { return served.sum(&Reader::spokes); };
  for (auto _ : state) {
    const std::uint64_t before = spokes();
    place = place > 80.0 ? place - 77.3 : place + 7.7;
    wire::Playback request;
    request.set_position_s(place);
    served.host.playback()->control(request, "bench");
    while (spokes() == before) std::this_thread::sleep_for(100us);
    state.PauseTiming();  // the turn is shown
    while (spokes() < before + kSpokes) std::this_thread::sleep_for(1ms);
    state.ResumeTiming();
  }
}
BENCHMARK(SeeksToFirstSpoke)->Unit(benchmark::kMillisecond)->UseRealTime()->Iterations(20);

}  // namespace
}  // namespace skerry::bench

BENCHMARK_MAIN();

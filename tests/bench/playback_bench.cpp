// playback_bench: how fast a recording is played, and how soon a jump shows its picture.
//
// The recording: 20 turns of 4096 spokes of 1024 cells at 24 rpm (50 s, 82,000 spokes), of which
// nine cells in ten are 0, with lz4, in the page cache.  Google Benchmark.
#include <benchmark/benchmark.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "server/net/encoders.hpp"
#include "server/playback/playback_host.hpp"
#include "tests/unit/playback/recorded_file.hpp"

namespace skerry::bench {
namespace {

using namespace std::chrono_literals;
using namespace skerry::server;

const RecordedFile& file() {
  static const RecordedFile recorded([] {
    RecordedScene scene{.spokes_per_turn = 4096, .cells = 1024, .turns = 20, .turn = 2500ms};
    scene.change = [](Spoke& spoke) {
      for (std::size_t cell = 0; cell < spoke.cells.size(); ++cell) {
        if (cell % 160 >= 16) spoke.cells[cell] = 0;
      }
      return true;
    };
    return scene;
  }());
  return recorded;
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
  explicit Served(const PlayerOptions& options)
      : host(file().open(), options, "bench"), channel(host.find_channel(0, 0)) {
    reader.emplace(channel->add_format(kNativeFormat, native_encoder()));
  }
  ~Served() { host.stop(); }
  PlaybackHost host;
  VideoChannelPtr channel;
  std::optional<Reader> reader;
};

// At a rate of 100: real time, `pace` times the recorded one, spokes lost to the reader; CPU time
// of the playback and the reader together.
void Plays(benchmark::State& state) {
  std::uint64_t lost = 0, bytes = 0;
  for (auto _ : state) {
    Served served({.rate = 100.0});
    served.host.start();
    while (served.host.playback()->state().playing()) std::this_thread::sleep_for(1ms);
    while (served.reader->spokes() + served.reader->lost() < 20u * 4096) {
      std::this_thread::sleep_for(1ms);
    }
    lost += served.reader->lost();
    bytes += served.reader->bytes();
  }
  state.SetBytesProcessed(static_cast<std::int64_t>(bytes));
  state.counters["pace"] = benchmark::Counter(50.0 * static_cast<double>(state.iterations()),
                                              benchmark::Counter::kIsRate);
  state.counters["lost"] = static_cast<double>(lost);
}
BENCHMARK(Plays)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime()
    ->Iterations(3);

// From the order to the first spoke of the turn that is shown.
void SeeksToFirstSpoke(benchmark::State& state) {
  Served served({.playing = false});
  served.host.start();
  double place = 3.0;
  for (auto _ : state) {
    const std::uint64_t before = served.reader->spokes();
    place = place > 40.0 ? place - 37.3 : place + 7.7;
    wire::Playback request;
    request.set_position_s(place);
    served.host.playback()->control(request, "bench");
    while (served.reader->spokes() == before) std::this_thread::sleep_for(100us);
    state.PauseTiming();  // the turn is shown
    while (served.reader->spokes() < before + 4096) std::this_thread::sleep_for(1ms);
    state.ResumeTiming();
  }
}
BENCHMARK(SeeksToFirstSpoke)->Unit(benchmark::kMillisecond)->UseRealTime()->Iterations(20);

}  // namespace
}  // namespace skerry::bench

BENCHMARK_MAIN();

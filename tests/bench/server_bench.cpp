// server_bench: the built skerryd on its default scenario, over loopback: time from the start of
// the process to the first spoke on TCP, CPU and memory over ten seconds without and with clients.
// Takes half a minute, and --benchmark_repetitions=5 two and a half.
#include <benchmark/benchmark.h>

#include <atomic>
#include <chrono>
#include <exception>
#include <optional>
#include <string>
#include <thread>
#include <variant>
#include <vector>

#include "clients/common/spoke_client.hpp"
#include "tests/bench/child_server.hpp"

namespace skerry::bench {
namespace {

using client::SpokeClient;
using SteadyClock = std::chrono::steady_clock;

constexpr Duration kTimeout = std::chrono::seconds(5);
constexpr auto kMeasured = std::chrono::seconds(10);

double seconds_since(SteadyClock::time_point begun) {
  return std::chrono::duration<double>(SteadyClock::now() - begun).count();
}

// Radars are numbered from 0 as Hello lists them.
SpokeClient subscribed(const ChildServer& server, std::uint32_t nth) {
  auto client = SpokeClient::connect("127.0.0.1", server.tcp_port(), kTimeout);
  if (!client.ok()) throw std::runtime_error(client.error().text);
  const auto& radars = client.value().hello().radars();
  const auto radar = radars[static_cast<int>(nth) % radars.size()].radar();
  const auto done = client.value().subscribe(radar, 0, kTimeout);
  if (!done.ok()) throw std::runtime_error(done.error().text);
  return std::move(client).value();
}

void wait_for_spoke(SpokeClient& client) {
  for (;;) {
    const auto event = client.receive(kTimeout);
    if (!event.ok()) throw std::runtime_error(event.error().text);
    if (!event.value()) throw std::runtime_error("no spoke came in time");
    if (std::holds_alternative<Spoke>(**event)) return;
  }
}

// Clients that take all they are sent, each on a thread of its own.
class Clients {
 public:
  Clients(const ChildServer& server, std::uint32_t count) {
    for (std::uint32_t i = 0; i < count; ++i) {
      threads_.emplace_back([this, client = subscribed(server, i)](std::stop_token stop) mutable {
        while (!stop.stop_requested()) {
          const auto event = client.receive(std::chrono::milliseconds(100));
          if (!event.ok()) break;
          if (event.value() && std::holds_alternative<Spoke>(**event)) ++spokes_;
        }
        lost_ += client.losses().lost();
      });
    }
  }
  std::uint64_t spokes() const { return spokes_; }
  // Ends the clients; what all of them lost.
  std::uint64_t lost() {
    threads_.clear();
    return lost_;
  }

 private:
  std::atomic<std::uint64_t> spokes_ = 0, lost_ = 0;
  std::vector<std::jthread> threads_;
};

// One run: ten seconds from the moment that everything is connected and the first spoke was seen.
void bench_streaming(benchmark::State& state, std::uint32_t count) {
  for (auto _ : state) {
    try {
      const ChildServer server;
      {
        auto first = subscribed(server, 0);
        wait_for_spoke(first);
      }
      Clients clients(server, count);
      const auto begun = SteadyClock::now();
      const double cpu_before = server.cpu_seconds();
      const std::uint64_t spokes_before = clients.spokes();
      std::this_thread::sleep_for(kMeasured);
      const double seconds = seconds_since(begun);
      state.counters["core %"] = 100.0 * (server.cpu_seconds() - cpu_before) / seconds;
      state.counters["spokes/s"] = static_cast<double>(clients.spokes() - spokes_before) / seconds;
      state.counters["MiB"] = server.resident_mib();
      state.counters["lost"] = static_cast<double>(clients.lost());
      state.SetIterationTime(seconds);
    } catch (const std::exception& error) {
      state.SkipWithError(error.what());
      return;
    }
  }
}

void bench_start(benchmark::State& state) {
  for (auto _ : state) {
    try {
      const auto begun = SteadyClock::now();
      const ChildServer server;
      auto client = subscribed(server, 0);
      wait_for_spoke(client);
      state.SetIterationTime(seconds_since(begun));
    } catch (const std::exception& error) {
      state.SkipWithError(error.what());
      return;
    }
  }
}

void register_all() {
  for (const std::uint32_t count : {0u, 16u}) {
    const std::string name = "ten seconds/" + std::to_string(count) + " clients";
    benchmark::RegisterBenchmark(
        name.c_str(), [count](benchmark::State& state) { bench_streaming(state, count); })
        ->Iterations(1)
        ->UseManualTime()
        ->Unit(benchmark::kSecond);
  }
  benchmark::RegisterBenchmark("process start to first spoke", bench_start)
      ->Iterations(1)
      ->Repetitions(5)
      ->UseManualTime()
      ->Unit(benchmark::kMillisecond);
}

}  // namespace
}  // namespace skerry::bench

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  skerry::bench::register_all();
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}

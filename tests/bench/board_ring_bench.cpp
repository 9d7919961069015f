// board_ring_bench: the shared-memory ring of an interface board, its reader in another process.
// Throughput, beside memcpy of as many bytes in the same run, and the time from a write to the
// record in a reader that slept.  Takes about 5 s.
#include <benchmark/benchmark.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <functional>
#include <new>
#include <stdexcept>
#include <thread>
#include <vector>

#include "protocol/board/sweep_record.hpp"
#include "protocol/board/sweep_ring.hpp"

namespace skerry::bench {
namespace {

using namespace skerry::board;
using SteadyClock = std::chrono::steady_clock;
using State = SweepRingReader::State;

constexpr std::uint32_t kSamples = 2048;  // of one channel: records of 4288 bytes
constexpr std::size_t kUtcOffset = 40;    // of a sweep record

class SharedMemory {
 public:
  explicit SharedMemory(std::size_t bytes)
      : bytes_(bytes),
        memory_(mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0)) {
    if (memory_ == MAP_FAILED) throw std::bad_alloc();
  }
  SharedMemory(const SharedMemory&) = delete;
  SharedMemory& operator=(const SharedMemory&) = delete;
  ~SharedMemory() { munmap(memory_, bytes_); }
  std::span<std::uint8_t> bytes() { return {static_cast<std::uint8_t*>(memory_), bytes_}; }
  template <typename T>
  T& as() {
    return *new (memory_) T();
  }

 private:
  std::size_t bytes_;
  void* memory_;
};

// A process that reads the ring until it is closed, its memory read-only.  `taken` gets each record
// and, where there is none for now, nothing.
class ReaderProcess {
 public:
  ReaderProcess(SharedMemory& ring, std::atomic<std::uint32_t>& ready, bool sleeps,
                const std::function<void(std::span<const std::uint8_t>)>& taken) {
    pid_ = fork();
    if (pid_ < 0) throw std::runtime_error("cannot fork");
    if (pid_ == 0) {
      prctl(PR_SET_PDEATHSIG, SIGKILL);
      mprotect(ring.bytes().data(), ring.bytes().size(), PROT_READ);
      auto reader = SweepRingReader::open(ring.bytes());
      if (!reader) _exit(1);
      ready = 1;
      Bytes record;
      for (;;) {
        const State state = reader->take(record);
        if (state == State::closed) _exit(reader->records_lost() == 0 ? 0 : 2);
        taken(record);
        if (state == State::empty && sleeps) (void)reader->wait(std::chrono::seconds(1));
      }
    }
    while (ready == 0) std::this_thread::yield();
  }
  ReaderProcess(const ReaderProcess&) = delete;
  ReaderProcess& operator=(const ReaderProcess&) = delete;
  // Whether it got everything.
  bool end() {
    int status = -1;
    waitpid(pid_, &status, 0);
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
  }

 private:
  pid_t pid_ = -1;
};

Bytes sweeps_of(std::uint32_t samples, std::uint64_t first_sequence, std::uint32_t count) {
  Bytes bytes;
  Sweep sweep;
  sweep.meta.sample_clock_hz = 20'000'000;
  sweep.meta.acp_per_turn = 4096;
  sweep.meta.channels[0].samples = samples;
  sweep.meta.channels[0].bits = 12;
  sweep.samples[0].assign(samples, 1000);
  for (std::uint32_t n = 0; n < count; ++n) append_record(bytes, first_sequence + n, sweep);
  return bytes;
}

double gigabytes_a_second(std::uint64_t bytes, SteadyClock::duration time) {
  return static_cast<double>(bytes) / std::chrono::duration<double>(time).count() / 1e9;
}

// Copies as many bytes in pieces as long, from one buffer into one as large as the ring.
double memcpy_gigabytes(const Bytes& piece, std::size_t capacity, std::uint64_t pieces) {
  Bytes into(capacity, 1);
  std::size_t at = 0;
  const auto begun = SteadyClock::now();
  for (std::uint64_t n = 0; n < pieces; ++n) {
    if (at + piece.size() > capacity) at = 0;
    std::memcpy(into.data() + at, piece.data(), piece.size());
    benchmark::DoNotOptimize(into.data() + at);
    benchmark::ClobberMemory();
    at += piece.size();
  }
  return gigabytes_a_second(pieces * piece.size(), SteadyClock::now() - begun);
}

// Flat out without a loss: the bench holds the writer back where its reader is half a ring behind.
void bench_throughput(benchmark::State& state) {
  const auto per_write = static_cast<std::uint32_t>(state.range(0));
  const auto samples = static_cast<std::uint32_t>(state.range(1));
  const auto capacity = static_cast<std::size_t>(state.range(2)) << 20;
  struct Progress {
    std::atomic<std::uint32_t> ready = 0;
    alignas(64) std::atomic<std::uint64_t> taken = 0;  // bytes
  };
  SharedMemory memory(ring_bytes(capacity)), page(4096);
  auto& progress = page.as<Progress>();
  SweepRingWriter writer(memory.bytes());
  // Told by the reader now and then, so that the two do not fight over the counter.
  std::uint64_t taken = 0, told = 0;
  ReaderProcess reader(memory, progress.ready, true, [&](std::span<const std::uint8_t> record) {
    taken += record.size();
    if (taken == told || (!record.empty() && taken - told < 262'144)) return;
    told = taken;
    progress.taken.store(taken, std::memory_order_release);
  });
  const std::size_t record = sweeps_of(samples, 0, 1).size();
  const std::uint64_t writes = (64u << 20) / (record * per_write);
  std::uint64_t sequence = 0, written = 0, read = 0;
  double ring = 0.0, copy = 0.0;
  Bytes block = sweeps_of(samples, 0, per_write);
  for (auto _ : state) {
    const auto begun = SteadyClock::now();
    const std::uint64_t before = written;
    for (std::uint64_t n = 0; n < writes; ++n) {
      for (std::uint32_t k = 0; k < per_write; ++k, ++sequence) {
        std::memcpy(block.data() + k * record + 8, &sequence, sizeof sequence);
      }
      while (written - read > capacity / 2) {
        read = progress.taken.load(std::memory_order_acquire);
      }
      writer.write(block, sequence - per_write, per_write);
      written += block.size();
    }
    while (progress.taken.load(std::memory_order_acquire) != written) {
    }
    const auto took = SteadyClock::now() - begun;
    state.SetIterationTime(std::chrono::duration<double>(took).count());
    ring = std::max(ring, gigabytes_a_second(written - before, took));
    copy = std::max(copy, memcpy_gigabytes(block, capacity, writes));
  }
  writer.close();
  if (!reader.end()) state.SkipWithError("the reader lost records");
  state.SetBytesProcessed(static_cast<std::int64_t>(written));
  state.counters["best_GB/s"] = ring;
  state.counters["memcpy_GB/s"] = copy;
  state.counters["of_memcpy"] = ring / copy;
}

double percentile_us(std::vector<std::uint64_t>& times, double share) {
  const auto nth = static_cast<std::size_t>(share * static_cast<double>(times.size() - 1));
  std::nth_element(times.begin(), times.begin() + static_cast<std::ptrdiff_t>(nth), times.end());
  return static_cast<double>(times[nth]) / 1000.0;
}

std::uint64_t now_ns() {
  return static_cast<std::uint64_t>(SteadyClock::now().time_since_epoch().count());
}

// From before the write to the last record of it in the reader, by its UTC field; the reader sleeps
// between writes, or looks all the time.
void bench_latency(benchmark::State& state) {
  const auto period = std::chrono::microseconds(state.range(0));
  const auto per_write = static_cast<std::uint32_t>(state.range(1));
  const std::uint64_t writes = static_cast<std::uint64_t>(1'000'000 / state.range(0));
  struct Times {
    std::atomic<std::uint32_t> ready = 0;
    std::atomic<std::uint32_t> count = 0;
    std::uint64_t ns[16'384];
  };
  SharedMemory memory(ring_bytes(16u << 20)), page(sizeof(Times));
  auto& times = page.as<Times>();
  SweepRingWriter writer(memory.bytes());
  const bool sleeps = state.range(2) != 0;
  ReaderProcess reader(memory, times.ready, sleeps, [&](std::span<const std::uint8_t> record) {
    if (record.empty()) return;
    std::uint64_t written = 0;
    std::memcpy(&written, record.data() + kUtcOffset, sizeof written);
    if (written == 0) return;
    const std::uint32_t n = times.count;
    times.ns[n % std::size(times.ns)] = now_ns() - written;
    times.count = n + 1;
  });
  std::uint64_t sequence = 0;
  for (auto _ : state) {
    auto next = SteadyClock::now();
    for (std::uint64_t n = 0; n < writes; ++n) {
      Bytes block = sweeps_of(kSamples, sequence, per_write);
      sequence += per_write;
      const std::size_t last = block.size() - block.size() / per_write;
      next += period;
      std::this_thread::sleep_until(next);
      const std::uint64_t now = now_ns();
      std::memcpy(block.data() + last + kUtcOffset, &now, sizeof now);
      writer.write(block, sequence - per_write, per_write);
    }
    while (times.count < writes) std::this_thread::yield();
  }
  writer.close();
  if (!reader.end()) state.SkipWithError("the reader lost records");
  std::vector<std::uint64_t> taken(times.ns, times.ns + writes);
  state.counters["p50_us"] = percentile_us(taken, 0.50);
  state.counters["p90_us"] = percentile_us(taken, 0.90);
  state.counters["p99_us"] = percentile_us(taken, 0.99);
  state.counters["max_us"] = percentile_us(taken, 1.0);
  state.counters["writes"] = static_cast<double>(writes);
}

BENCHMARK(bench_throughput)
    ->Name("throughput")
    ->ArgNames({"records_per_write", "samples", "MiB"})
    ->Args({1, kSamples, 4})
    ->Args({15, kSamples, 4})
    ->Args({15, kSamples, 64})
    ->Iterations(12)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);

BENCHMARK(bench_latency)
    ->Name("latency")
    ->ArgNames({"period_us", "records_per_write", "sleeps"})
    ->Args({333, 1, 1})
    ->Args({5000, 15, 1})
    ->Args({5000, 15, 0})
    ->Iterations(1)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace skerry::bench

BENCHMARK_MAIN();

// recording_bench: what recordings cost, and how small they become.
//
//   recording_bench                    writer, ratios, seeking in 512 MiB
//   recording_bench --large [FOLDER]   seeking in 10 GB, written to FOLDER (default: of temporary
//   files) recording_bench --benchmark_...    the writer alone, quickly (Google Benchmark)
//
// "MB/s" are octets of spoke messages by second; the disk is the page cache of a temporary file.
#include <benchmark/benchmark.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "protocol/recording/checksum.hpp"
#include "protocol/recording/reader.hpp"
#include "protocol/recording/writer.hpp"
#include "protocol/wire/spoke_message.hpp"
#include "tests/bench/recorded_turn.hpp"

namespace skerry::bench {
namespace {

using recording::Compression;
using recording::Item;
using recording::Kind;
using recording::RecordingReader;
using recording::RecordingWriter;
using recording::WriterOptions;

double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// A file that goes when it is closed.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::filesystem::path& folder)
      : path_((folder / fmt::format("skerry-bench-{}.mcap", getpid())).string()),
        file_(::open(path_.c_str(), O_CREAT | O_TRUNC | O_RDWR, 0600)) {
    if (file_ < 0) throw std::runtime_error(fmt::format("{}: {}", path_, strerror(errno)));
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile() {
    ::close(file_);
    ::unlink(path_.c_str());
  }
  const std::string& path() const { return path_; }
  bool write(std::span<const std::uint8_t> bytes) const {
    while (!bytes.empty()) {
      const ssize_t done = ::write(file_, bytes.data(), bytes.size());
      if (done <= 0) return false;
      bytes = bytes.subspan(static_cast<std::size_t>(done));
    }
    return true;
  }
  void rewind() const {
    if (::ftruncate(file_, 0) != 0 || ::lseek(file_, 0, SEEK_SET) != 0) std::abort();
  }

 private:
  std::string path_;
  int file_;
};

std::string name_of(const WriterOptions& options) {
  const char* names[] = {"none", "lz4", "zstd"};
  std::string name = names[static_cast<int>(options.compression)];
  if (options.compression == Compression::zstd) name += fmt::format(" {}", options.zstd_level);
  return name + (options.compact ? " compact" : "");
}

std::vector<WriterOptions> all_options() {
  std::vector<WriterOptions> all;
  for (const bool compact : {false, true}) {
    for (const Compression compression : {Compression::none, Compression::lz4, Compression::zstd}) {
      WriterOptions options;
      options.compression = compression;
      options.compact = compact;
      all.push_back(options);
    }
  }
  all.push_back(all.back());
  all.back().zstd_level = 9;
  return all;
}

// Turn after turn, later each time.
class Turns {
 public:
  explicit Turns(RecordedTurn turn) : turn_(std::move(turn)) {}
  // Writes one turn.  Returns the octets written.
  std::uint64_t write(RecordingWriter& writer) {
    std::uint64_t bytes = 0;
    for (RecordedTurn::Spoke& spoke : turn_.spokes) {
      writer.add(Item{{Kind::spoke, 0, 0}, spoke.time, spoke.bytes});
      bytes += spoke.bytes.size();
      delay(spoke, turn_.duration);
    }
    return bytes;
  }

 private:
  RecordedTurn turn_;
};

struct Speed {
  double mb_s = 0.0, ratio = 0.0;
  std::uint64_t items = 0;
};

Speed write(const RecordedTurn& turn, const WriterOptions& options, const TemporaryFile& file,
            std::uint64_t least_bytes) {
  file.rewind();
  RecordingWriter writer([&](std::span<const std::uint8_t> bytes) { return file.write(bytes); },
                         options);
  Turns turns(turn);
  const double begun = seconds();
  std::uint64_t bytes = 0;
  while (bytes < least_bytes) bytes += turns.write(writer);
  writer.finish();
  const double took = seconds() - begun;
  return {static_cast<double>(bytes) / took * 1e-6,
          static_cast<double>(bytes) / static_cast<double>(writer.counts().bytes),
          writer.counts().items};
}

double best(int times, const std::function<double()>& mb_s) {
  double highest = 0.0;
  for (int i = 0; i < times; ++i) highest = std::max(highest, mb_s());
  return highest;
}

// The machine's own speed with as many octets.
void floors(const TemporaryFile& file) {
  constexpr std::size_t kBytes = 256 << 20, kBlock = 2 << 20;
  std::vector<std::uint8_t> block(kBlock, 1);
  const auto rate = [&](const std::function<void()>& once) {
    return best(3, [&] {
      const double begun = seconds();
      for (std::size_t done = 0; done < kBytes; done += kBlock) once();
      return kBytes / (seconds() - begun) * 1e-6;
    });
  };
  std::uint32_t sum = 0;
  const double set = rate([&] {
    std::memset(block.data(), static_cast<int>(++sum), block.size());
    benchmark::DoNotOptimize(block.data());
  });
  const double crc = rate([&] { sum ^= recording::crc32(block); });
  file.rewind();
  const double written = best(3, [&] {
    file.rewind();
    const double begun = seconds();
    for (std::size_t done = 0; done < kBytes; done += kBlock) file.write(block);
    return kBytes / (seconds() - begun) * 1e-6;
  });
  benchmark::DoNotOptimize(sum);
  fmt::print("floors: memset {:.0f} MB/s, CRC-32 {:.0f} MB/s, write(2) {:.0f} MB/s\n\n", set, crc,
             written);
}

void ratios(const std::vector<RecordedTurn>& turns, const TemporaryFile& file) {
  fmt::print("{:<16}", "writer");
  for (const RecordedTurn& turn : turns) fmt::print("{:>26}", turn.name);
  fmt::print("\n");
  for (const WriterOptions& options : all_options()) {
    fmt::print("{:<16}", name_of(options));
    for (const RecordedTurn& turn : turns) {
      double ratio = 0.0;
      const double mb_s = best(3, [&] {
        const Speed speed = write(turn, options, file, 64 << 20);
        ratio = speed.ratio;
        return speed.mb_s;
      });
      fmt::print("{:>15.0f} MB/s {:>5.1f}", mb_s, ratio);
    }
    fmt::print("\n");
  }
  fmt::print("\n");
}

// The time to find the chunks of a file that was not finished.
void search(const TemporaryFile& file, std::uint64_t file_bytes) {
  if (::truncate(file.path().c_str(), static_cast<off_t>(file_bytes - 100)) != 0) std::abort();
  const double begun = seconds();
  const auto reader = RecordingReader::open(file.path());
  if (!reader) throw std::runtime_error(reader.error().to_string());
  fmt::print("cut short: {} chunks found in {:.1f} ms\n\n", reader->summary().chunks,
             1e3 * (seconds() - begun));
}

// Reads it all and compares it with what was written.
void compare(const RecordedTurn& turn, RecordingReader& reader, std::uint64_t items) {
  RecordedTurn expected = turn;
  const double begun = seconds();
  auto cursor = reader.items();
  std::uint64_t read = 0, bytes = 0;
  while (const auto item = cursor.next()) {
    RecordedTurn::Spoke& spoke = expected.spokes[read++ % expected.spokes.size()];
    if (item->time != spoke.time || !std::equal(item->bytes.begin(), item->bytes.end(),
                                                spoke.bytes.begin(), spoke.bytes.end())) {
      throw std::runtime_error(fmt::format("item {} is not what was written", read));
    }
    bytes += item->bytes.size();
    delay(spoke, expected.duration);
  }
  if (read != items) throw std::runtime_error(fmt::format("{} items of {}", read, items));
  fmt::print("all {} items are what was written, octet by octet: {:.0f} MB/s\n", read,
             static_cast<double>(bytes) / (seconds() - begun) * 1e-6);
}

void seeks(const RecordedTurn& turn, const WriterOptions& options, const TemporaryFile& file,
           std::uint64_t bytes) {
  const Speed written = write(turn, options, file, bytes);
  double begun = seconds();
  auto reader = RecordingReader::open(file.path());
  if (!reader) throw std::runtime_error(reader.error().to_string());
  const auto& summary = reader->summary();
  fmt::print("{}: {:.1f} GB, {:.0f} s, {} chunks: opened in {:.1f} ms\n", name_of(options),
             static_cast<double>(summary.file_bytes) * 1e-9,
             in_seconds(summary.end - summary.begin), summary.chunks, 1e3 * (seconds() - begun));
  std::mt19937_64 random(1);
  std::vector<double> took;
  auto cursor = reader->items();
  for (int i = 0; i < 300; ++i) {
    const Duration into((summary.end - summary.begin).count() / 1000 *
                        static_cast<std::int64_t>(random() % 1000));
    begun = seconds();
    cursor.seek(summary.begin + into);
    const auto item = cursor.next();
    took.push_back(1e3 * (seconds() - begun));
    if (!item || item->time < summary.begin + into) throw std::runtime_error("sought in vain");
  }
  std::sort(took.begin(), took.end());
  fmt::print("seek to any time: median {:.2f} ms, 99 % {:.2f} ms, longest {:.2f} ms\n",
             took[took.size() / 2], took[took.size() * 99 / 100], took.back());
  compare(turn, reader.value(), written.items);
  search(file, summary.file_bytes);
}

void quick_writer(benchmark::State& state) {
  WriterOptions options;
  options.compression = static_cast<Compression>(state.range(0));
  options.compact = state.range(1) != 0;
  const RecordedTurn turn = simulated_turn();
  const TemporaryFile file(std::filesystem::temp_directory_path());
  for (auto _ : state) {
    const Speed speed = write(turn, options, file, 16 << 20);
    state.counters["ratio"] = speed.ratio;
    state.counters["MB/s"] = speed.mb_s;
  }
}
BENCHMARK(quick_writer)->ArgsProduct({{0, 1, 2}, {0, 1}})->Unit(benchmark::kMillisecond);

int run(int argc, char** argv) {
  const bool large = argc > 1 && std::string_view(argv[1]) == "--large";
  const TemporaryFile file(argc > 2 ? argv[2] : std::filesystem::temp_directory_path().string());
  const RecordedTurn turn = simulated_turn();
  WriterOptions plain;
  plain.compression = Compression::none;
  WriterOptions compact;
  compact.compression = Compression::zstd;
  compact.compact = true;
  if (large) {
    seeks(turn, plain, file, 10'000'000'000);
    return 0;
  }
  floors(file);
  ratios(recorded_turns(), file);
  seeks(turn, plain, file, 512 << 20);
  seeks(turn, compact, file, 512 << 20);
  return 0;
}

}  // namespace
}  // namespace skerry::bench

int main(int argc, char** argv) {
  if (argc > 1 && std::string_view(argv[1]).starts_with("--benchmark")) {
    benchmark::Initialize(&argc, argv);
    benchmark::RunSpecifiedBenchmarks();
    return 0;
  }
  return skerry::bench::run(argc, argv);
}

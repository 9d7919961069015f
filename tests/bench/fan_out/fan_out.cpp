// fan_out: what one thread can send to many consoles over TCP: the built skerryd beside a bare
// epoll loop that sends the same bytes in the same pieces at the same pace, in turns.
//
//   fan_out                              100, 200, 400 and 600 consoles, three rounds (4 minutes)
//   fan_out --consoles 400 --rounds 5 --seconds 10
//
// The consoles are one process, which throws away what comes (MSG_TRUNC), so that they take little
// from the sender.  For each: MB a second that came, CPU of the sending thread for a MB, and what
// was lost: spokes for the server, and for the bare loop what a console was more than half a second
// behind, as in the server's ring.
#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "clients/common/spoke_client.hpp"
#include "protocol/wire/frame.hpp"
#include "tests/bench/child_server.hpp"
#include "tests/bench/fan_out/bare_sender.hpp"
#include "tests/bench/fan_out/many_consoles.hpp"

namespace skerry::bench {
namespace {

constexpr Duration kTimeout = std::chrono::seconds(10);
constexpr std::chrono::seconds kSettling{2};

// A radar of 4096 spokes of 1024 cells: 1.8 MB a second for each console.
constexpr const char* kScenario = R"(name: Fan-out
seed: 7
own_ships:
  - name: Tern
    position: {lat: 60.425, lon: 5.040}
    course_deg: 335
    speed_kn: 12
    radars:
      - {name: One, spokes: 4096, cells: 1024, bits: 8, rpm: 24, range_nm: 6}
)";

// What the server sends of it: a sector of 16 spokes at a time; half a second in the ring, a tenth
// in the kernel.
constexpr double kSpokesPerSecond = 4096 * 24 / 60.0;
constexpr std::size_t kSectorSpokes = 16, kSpokeBytes = 1024 + 77;
constexpr BareStream kStream{
    .piece_bytes = kSectorSpokes * kSpokeBytes,
    .pieces_per_second = kSpokesPerSecond / kSectorSpokes,
    .ring = static_cast<std::size_t>(kSpokesPerSecond / kSectorSpokes / 2.0),
    .send_buffer = static_cast<std::size_t>(kSpokesPerSecond * (1024 + 100) / 10.0)};

class Folder {
 public:
  Folder() : path_(std::filesystem::temp_directory_path() / fmt::format("fan-out-{}", getpid())) {
    std::filesystem::create_directory(path_);
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  std::string write(const char* name, const std::string& text) const {
    std::ofstream(path_ / name) << text;
    return (path_ / name).string();
  }

 private:
  std::filesystem::path path_;
};

struct Run {
  double mb_per_second = 0.0;
  double cpu_ms_per_mb = 0.0;
  double lost_percent = 0.0;
};

template <typename Cpu>
Run measured(const ManyConsoles& consoles, std::chrono::seconds time, const Cpu& cpu) {
  std::this_thread::sleep_for(kSettling);
  const auto begun = std::chrono::steady_clock::now();
  const double cpu_before = cpu();
  const std::uint64_t bytes_before = consoles.bytes();
  std::this_thread::sleep_for(time);
  const double megabytes = static_cast<double>(consoles.bytes() - bytes_before) / 1e6;
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
  return {.mb_per_second = megabytes / seconds,
          .cpu_ms_per_mb = 1000.0 * (cpu() - cpu_before) / megabytes};
}

client::SpokeClient connected(const ChildServer& server) {
  auto client = client::SpokeClient::connect("127.0.0.1", server.tcp_port(), kTimeout);
  if (!client.ok()) throw std::runtime_error(client.error().text);
  return std::move(client).value();
}

struct Counted {
  std::uint64_t sent = 0, lost = 0;
};

double percent(const Counted& before, const Counted& after) {
  const double lost = static_cast<double>(after.lost - before.lost);
  const double all = lost + static_cast<double>(after.sent - before.sent);
  return all > 0.0 ? 100.0 * lost / all : 0.0;
}

Counted counted(client::SpokeClient& client) {
  const auto status = client.get_status(kTimeout);
  if (!status.ok()) throw std::runtime_error(status.error().text);
  Counted all;
  for (const wire::ClientStatus& one : status.value().clients()) {
    all.sent += one.spokes_sent();
    all.lost += one.spokes_lost();
  }
  return all;
}

std::string subscription() {
  wire::ClientMessage message;
  message.set_request(1);
  message.mutable_subscribe()->set_radar(0);
  Bytes bytes;
  append_frame(bytes, message);
  return {bytes.begin(), bytes.end()};
}

Run run_server(const Folder& folder, std::size_t count, std::chrono::seconds time) {
  const ChildServer server({"--config", folder.write("server.yaml", "max_connections: 4096\n"),
                            "--scenario", folder.write("scenario.yaml", kScenario),
                            "--no-signalk"});
  auto watcher = connected(server);
  const ManyConsoles consoles(count, server.tcp_port(), subscription());
  std::this_thread::sleep_for(kSettling);
  const Counted before = counted(watcher);
  Run run = measured(consoles, time, [&] { return server.thread_cpu_seconds("net-0"); });
  run.lost_percent = percent(before, counted(watcher));
  return run;
}

Run run_bare(const BareStream& stream, std::size_t count, std::chrono::seconds time) {
  const BareSender sender(stream);
  const ManyConsoles consoles(count, sender.port(), "");
  std::this_thread::sleep_for(kSettling);
  const Counted before{sender.sent(), sender.lost()};
  Run run = measured(consoles, time, [&] { return sender.cpu_seconds(); });
  run.lost_percent = percent(before, {sender.sent(), sender.lost()});
  return run;
}

double median_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

struct Rounds {
  std::vector<double> rate, cost, lost;
  void add(const Run& run) {
    rate.push_back(run.mb_per_second);
    cost.push_back(run.cpu_ms_per_mb);
    lost.push_back(run.lost_percent);
  }
};

void compare(const Folder& folder, std::size_t count, int rounds, std::chrono::seconds time) {
  Rounds server, bare;
  std::vector<double> ratios;
  for (int round = 0; round < rounds; ++round) {
    server.add(run_server(folder, count, time));
    bare.add(run_bare(kStream, count, time));
    ratios.push_back(server.cost.back() / bare.cost.back());
  }
  fmt::print("{:8} {:9.1f} {:9.3f} {:9.4f} {:9.1f} {:9.3f} {:9.4f} {:8.2f}\n", count,
             median_of(server.rate), median_of(server.cost),
             *std::max_element(server.lost.begin(), server.lost.end()), median_of(bare.rate),
             median_of(bare.cost), *std::max_element(bare.lost.begin(), bare.lost.end()),
             median_of(ratios));
  std::fflush(stdout);
}

int run_all(int argc, char** argv) {
  std::vector<std::size_t> counts = {100, 200, 400, 600};
  int rounds = 3, seconds = 6;
  CLI::App app{"What one thread can send to many consoles over TCP, beside a bare epoll loop"};
  app.add_option("--consoles", counts, "how many (100 200 400 600)");
  app.add_option("--rounds", rounds, "of which medians are told, and the worst loss (3)");
  app.add_option("--seconds", seconds, "measured of each (6)");
  CLI11_PARSE(app, argc, argv);
  rlimit files{};
  ::getrlimit(RLIMIT_NOFILE, &files);
  files.rlim_cur = files.rlim_max;
  ::setrlimit(RLIMIT_NOFILE, &files);
  const Folder folder;
  fmt::print("{:8} {:^29} {:^29}\n{:>8} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>8}\n", "", "skerryd",
             "bare loop", "consoles", "MB/s", "ms/MB", "lost %", "MB/s", "ms/MB", "lost %",
             "ms ratio");
  for (const std::size_t count : counts)
    compare(folder, count, rounds, std::chrono::seconds(seconds));
  return 0;
}

}  // namespace
}  // namespace skerry::bench

int main(int argc, char** argv) {
  try {
    return skerry::bench::run_all(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "fan_out: {}\n", error.what());
    return 1;
  }
}

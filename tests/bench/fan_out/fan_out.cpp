// fan_out: what one thread can send to many consoles over TCP: the built skerryd beside a bare
// epoll loop that sends the same bytes in the same pieces at the same pace, in turns.
//
//   fan_out                              100, 200, 400 and 600 consoles, three rounds (4 minutes)
//   fan_out --consoles 400 --rounds 5 --seconds 10
//   fan_out --tls --consoles 50 100 200  WebSockets, in the clear and by TLS, in turns
//   fan_out --relay --core 0 --consoles 1000
//                                        the consoles hang on a relay of the server, all of whose
//                                        threads are on one core, as the bare loop is
//   fan_out --relay --core 0 --ws --consoles 300
//
// The consoles are one process, which throws away what comes (MSG_TRUNC), so that they take little
// from the sender, decrypting nothing.  For each: MB a second that came, CPU of the sending thread
// for a MB, and what was lost: spokes for the server, and for the bare loop what a console was more
// than half a second behind, as in the server's ring.  Of a relay the CPU is that of all its
// threads.
#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "clients/common/spoke_client.hpp"
#include "server/tls/certificate.hpp"
#include "tests/bench/child_server.hpp"
#include "tests/bench/fan_out/arrivals.hpp"
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
  std::string path(const char* name) const { return (path_ / name).string(); }
  std::string write(const char* name, const std::string& text) const {
    std::ofstream(path_ / name) << text;
    return path(name);
  }

 private:
  std::filesystem::path path_;
};

struct Run {
  double mb_per_second = 0.0;
  double cpu_ms_per_mb = 0.0;
  double lost_percent = 0.0;
  double p99_ms = 0.0;  // how late sectors came to one more console, which reads; WebSockets alone
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

// A server as it is for many consoles, with a certificate.
class Served {
 public:
  explicit Served(const Folder& folder) : certified_(folder), server_(options(folder)) {}
  const ChildServer& server() const { return server_; }
  std::uint16_t port(Way way) const {
    return way == Way::native ? server_.tcp_port() : server_.http_port();
  }

 private:
  struct Certified {
    explicit Certified(const Folder& folder) {
      if (std::filesystem::exists(folder.path("tls"))) return;
      server::make_authority(folder.path("tls"), "Bench");
      server::make_server_certificate(folder.path("tls"), {"127.0.0.1"});
    }
  };
  static std::vector<std::string> options(const Folder& folder) {
    return {"--config",    folder.write("server.yaml", "max_connections: 4096\n"),
            "--scenario",  folder.write("scenario.yaml", kScenario),
            "--tls",       folder.path("tls"),
            "--no-signalk"};
  }
  Certified certified_;
  ChildServer server_;
};

Run run_server(const Folder& folder, Way way, std::size_t count, std::chrono::seconds time) {
  const Served served(folder);
  auto watcher = connected(served.server());
  const ManyConsoles consoles(count, way, served.port(way));
  std::this_thread::sleep_for(kSettling);
  const Counted before = counted(watcher);
  std::optional<Arrivals> arrivals;
  if (way != Way::native) {
    arrivals.emplace(WireConsole(way, served.port(way)), kStream.piece_bytes,
                     kStream.pieces_per_second);
  }
  Run run = measured(consoles, time, [&] { return served.server().thread_cpu_seconds("net-0"); });
  if (arrivals) run.p99_ms = arrivals->p99_ms();
  run.lost_percent = percent(before, counted(watcher));
  return run;
}

// The same of a relay of such a server.  `core`: for all its threads; nothing: any.
Run run_relay(const Folder& folder, Way way, std::size_t count, std::chrono::seconds time,
              std::optional<int> core) {
  const Served served(folder);
  const ChildServer relay({"--config", folder.path("server.yaml"), "--no-signalk", "--relay",
                           fmt::format("127.0.0.1:{}", served.server().tcp_port())});
  if (core) relay.pin_to(*core);
  auto watcher = connected(relay);
  const ManyConsoles consoles(count, way,
                              way == Way::native ? relay.tcp_port() : relay.http_port());
  std::this_thread::sleep_for(kSettling);
  const Counted before = counted(watcher);
  Run run = measured(consoles, time, [&] { return relay.cpu_seconds(); });
  run.lost_percent = percent(before, counted(watcher));
  return run;
}

Run run_bare(const BareStream& stream, std::size_t count, std::chrono::seconds time,
             std::optional<int> core = {}) {
  BareSender sender(stream);
  if (core) sender.pin_to(*core);
  const ManyConsoles consoles(count, Way::bare, sender.port());
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
  std::vector<double> rate, cost, lost, late;
  void add(const Run& run) {
    rate.push_back(run.mb_per_second);
    cost.push_back(run.cpu_ms_per_mb);
    lost.push_back(run.lost_percent);
    late.push_back(run.p99_ms);
  }
};

double worst_of(const std::vector<double>& values) {
  return *std::max_element(values.begin(), values.end());
}

// The rounds of two, in turns, and how much more the first costs, in each pair.
template <typename First, typename Second>
void compare(std::size_t count, int rounds, const First& run_first, const Second& run_second) {
  Rounds first, second;
  std::vector<double> ratios;
  for (int round = 0; round < rounds; ++round) {
    first.add(run_first());
    second.add(run_second());
    ratios.push_back(first.cost.back() / second.cost.back());
  }
  fmt::print("{:8}", count);
  for (const Rounds& each : {first, second}) {
    fmt::print(" {:9.1f} {:9.3f} {:9.4f} {:9.1f}", median_of(each.rate), median_of(each.cost),
               worst_of(each.lost), median_of(each.late));
  }
  fmt::print(" {:8.2f}\n", median_of(ratios));
  std::fflush(stdout);
}

int run_all(int argc, char** argv) {
  std::vector<std::size_t> counts = {100, 200, 400, 600};
  int rounds = 3, seconds = 6;
  bool tls = false, relay = false, ws = false;
  std::optional<int> core;
  CLI::App app{"What one thread can send to many consoles over TCP, beside a bare epoll loop"};
  app.add_option("--consoles", counts, "how many (100 200 400 600)");
  app.add_option("--rounds", rounds, "of which medians are told, and the worst loss (3)");
  app.add_option("--seconds", seconds, "measured of each (6)");
  app.add_flag("--tls", tls, "WebSockets by TLS beside such in the clear");
  app.add_flag("--relay", relay, "the consoles hang on a relay of the server")->excludes("--tls");
  app.add_flag("--ws", ws, "with --relay: by WebSocket")->needs("--relay");
  app.add_option("--core", core, "with --relay: the core of all its threads, and of the bare loop")
      ->needs("--relay");
  CLI11_PARSE(app, argc, argv);
  rlimit files{};
  ::getrlimit(RLIMIT_NOFILE, &files);
  files.rlim_cur = files.rlim_max;
  ::setrlimit(RLIMIT_NOFILE, &files);
  const Folder folder;
  fmt::print("{:8} {:^39} {:^39}\n{:>8}", "",
             tls     ? "wss"
             : relay ? (ws ? "relay, ws" : "relay, native")
                     : "skerryd, native",
             tls ? "ws" : "bare loop", "consoles");
  for (int i = 0; i < 2; ++i) {
    fmt::print(" {:>9} {:>9} {:>9} {:>9}", "MB/s", "ms/MB", "lost %", "p99 ms");
  }
  fmt::print(" {:>8}\n", "ms ratio");
  const std::chrono::seconds time(seconds);
  for (const std::size_t count : counts) {
    const auto served = [&](Way way) {
      return [&, way] { return run_server(folder, way, count, time); };
    };
    if (tls) {
      compare(count, rounds, served(Way::wss), served(Way::ws));
    } else if (relay) {
      compare(
          count, rounds,
          [&] { return run_relay(folder, ws ? Way::ws : Way::native, count, time, core); },
          [&] { return run_bare(kStream, count, time, core); });
    } else {
      compare(count, rounds, served(Way::native), [&] { return run_bare(kStream, count, time); });
    }
  }
  return 0;
}

}  // namespace
}  // namespace skerry::bench

int main(int argc, char** argv) {
  std::signal(SIGPIPE, SIG_IGN);  // a server that closes is told as an error
  try {
    return skerry::bench::run_all(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "fan_out: {}\n", error.what());
    return 1;
  }
}

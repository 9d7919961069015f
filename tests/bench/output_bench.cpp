// output_bench: the built skerryd with outputs on loopback, and a display for each that takes all
// it is sent.  Bandwidth and CPU of every kind of output alone; then ten outputs at once, at 24 and
// at 48 turns a minute: how far the intervals of datagrams are from the real radars' cadence. Times
// are the kernel's, of when a datagram had come.  Takes two and a half minutes; --seconds N for
// less.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "tests/bench/child_server.hpp"
#include "tests/unit/net/display_socket.hpp"

namespace skerry::bench {
namespace {

using server::DisplaySocket;

// A radar of 4096 spokes of 1024 cells off Bergen.
std::string scenario(int rpm) {
  return fmt::format(R"(name: Outputs
seed: 7
own_ships:
  - name: Tern
    position: {{lat: 60.425, lon: 5.040}}
    course_deg: 335
    speed_kn: 12
    radars:
      - {{name: One, spokes: 4096, cells: 1024, bits: 8, rpm: {}, range_nm: 6}}
targets:
  - {{name: Tanker, position: {{lat: 60.445, lon: 5.020}}, course_deg: 160, speed_kn: 10,
     length_m: 182, beam_m: 32, height_m: 22}}
)",
                     rpm);
}

// The datagrams whose times are the cadence.
enum class Beat {
  each,    // every datagram
  bursts,  // the first of those that come within 2 ms of each other
};

struct Kind {
  std::string name;
  std::string output;   // but for the interface
  Ipv4Endpoint group;   // of the picture; address 0: unicast, and the port is added
  double per_turn = 0;  // beats; 0: not measured
  Beat beat = Beat::each;
};

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> all = {
      {"navico_br24", "navico_br24", {ipv4(236, 6, 7, 8), 6678}, 64},
      {"navico_4g", "navico_4g", {ipv4(236, 6, 7, 8), 6678}, 64},
      {"navico_halo",
       "navico_halo:addresses=239.255.75.1:7101,addresses=239.255.75.2:7102,"
       "addresses=239.255.75.3:7103",
       {ipv4(239, 255, 75, 1), 7101},
       64},
      {"garmin_xhd", "garmin_xhd", {ipv4(239, 254, 2, 0), 50102}, 256, Beat::bursts},
      {"raymarine_quantum",
       "raymarine_quantum:addresses=239.255.75.4:7104,addresses=0.0.0.0:7105",
       {ipv4(239, 255, 75, 4), 7104},
       250},
      {"native", "native", {0, 7411}},
      {"native 720x512x4", "native:spokes=720,cells=512,bits=4", {0, 7411}},
      {"cat240", "cat240", {0, 8600}},
      {"cat240 720x512x4", "cat240:spokes=720,cells=512,bits=4", {0, 8600}},
      {"cat240 compressed", "cat240:compressed=true", {0, 8600}},
  };
  return all;
}

struct Counted {
  std::uint64_t datagrams = 0, bytes = 0;
  std::vector<std::int64_t> times_ns;
};

// A display that takes everything until it ends.
class Taker {
 public:
  Taker(const Kind& kind, std::uint32_t at)
      : from_(at),
        quantum_(kind.per_turn == 250),
        socket_(kind.group.address == 0 ? Ipv4Endpoint{} : kind.group, at),
        thread_([this](const std::stop_token& stop) {
          while (!stop.stop_requested()) {
            const auto received = socket_.receive(from_, std::chrono::milliseconds(50));
            if (!received || !counting_) continue;
            ++counted_.datagrams;
            counted_.bytes += received->payload.size();
            // A Quantum's reports come with its spokes.
            const Bytes& payload = received->payload;
            const bool report = quantum_ && (payload.size() < 20 || payload[0] != 3);
            if (!report) counted_.times_ns.push_back(received->time.count());
          }
        }) {}
  std::uint16_t port() const { return socket_.port(); }
  void count() { counting_ = true; }
  Counted finish() {
    thread_.request_stop();
    thread_.join();
    return counted_;
  }

 private:
  std::uint32_t from_;
  bool quantum_;
  DisplaySocket socket_;
  std::atomic<bool> counting_ = false;
  Counted counted_;
  std::jthread thread_;
};

std::string address_text(std::uint32_t address) {
  const std::string text = text_of({address, 0});
  return text.substr(0, text.find(':'));
}

std::string argument(const Kind& kind, std::uint32_t at, std::uint16_t port) {
  const char joint = kind.output.find(':') == std::string::npos ? ':' : ',';
  std::string text = fmt::format("{}{}interface_address={}", kind.output, joint, address_text(at));
  // A stream's source is 127.0.0.1 whatever its interface: that is of multicast.
  if (kind.group.address == 0) text += fmt::format(",address=127.0.0.1,port={}", port);
  return text;
}

struct Run {
  double seconds = 0.0, core = 0.0;
  std::vector<Counted> displays;
};

// A server with those outputs and a display for each.
Run run(const std::string& scenario_file, const std::vector<Kind>& outputs, double seconds) {
  std::vector<std::unique_ptr<Taker>> takers;
  std::vector<std::string> arguments = {"--scenario", scenario_file, "--no-signalk"};
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const bool unicast = outputs[i].group.address == 0;
    const std::uint32_t at = ipv4(127, 0, 0, unicast ? 1 : static_cast<std::uint32_t>(61 + i));
    takers.push_back(std::make_unique<Taker>(outputs[i], at));
    arguments.insert(arguments.end(),
                     {"--output", argument(outputs[i], at, takers.back()->port())});
  }
  const ChildServer server(arguments);
  std::this_thread::sleep_for(std::chrono::seconds(3));  // past the first turn
  for (const auto& taker : takers) taker->count();
  const auto begun = std::chrono::steady_clock::now();
  const double cpu = server.cpu_seconds();
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
  Run result;
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
  result.core = (server.cpu_seconds() - cpu) / result.seconds;
  for (const auto& taker : takers) result.displays.push_back(taker->finish());
  return result;
}

// Intervals between beats, ms, in order of size.
std::vector<double> intervals_ms(const Counted& counted, Beat beat) {
  constexpr std::int64_t kBurst = 2'000'000;
  std::vector<double> out;
  std::int64_t last_beat = 0, last = 0;
  for (const std::int64_t time : counted.times_ns) {
    const bool begins = beat == Beat::each || last == 0 || time - last > kBurst;
    if (begins && last_beat != 0) out.push_back(static_cast<double>(time - last_beat) * 1e-6);
    if (begins) last_beat = time;
    last = time;
  }
  std::sort(out.begin(), out.end());
  return out;
}

void print_timing(const std::string& scenario_file, int rpm, double seconds) {
  const Run ten = run(scenario_file, kinds(), seconds);
  std::printf("\nten outputs at %d turns a minute, %.0f %% of a core\n", rpm, 100.0 * ten.core);
  std::printf("%-18s %10s %10s %10s %10s %14s\n", "output", "cadence ms", "p1", "p50", "p99",
              "p99 off by");
  for (std::size_t i = 0; i < kinds().size(); ++i) {
    const Kind& kind = kinds()[i];
    if (kind.per_turn == 0) continue;
    const std::vector<double> all = intervals_ms(ten.displays[i], kind.beat);
    if (all.empty()) {
      std::printf("%-18s nothing came\n", kind.name.c_str());
      continue;
    }
    const double cadence = 60'000.0 / rpm / kind.per_turn;
    std::vector<double> off;
    for (const double one : all) off.push_back(std::abs(one - cadence));
    std::sort(off.begin(), off.end());
    const auto at = [](const std::vector<double>& sorted, double share) {
      return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
    };
    std::printf("%-18s %10.2f %10.2f %10.2f %10.2f %14.2f\n", kind.name.c_str(), cadence,
                at(all, 0.01), at(all, 0.5), at(all, 0.99), at(off, 0.99));
  }
}

void print_each(const std::string& scenario_file, double seconds) {
  const double idle = run(scenario_file, {}, seconds).core;
  std::printf("the server without outputs: %.2f %% of a core\n", 100.0 * idle);
  std::printf("%-18s %12s %12s %14s\n", "output alone", "datagrams/s", "kB/s", "+ % of a core");
  for (const Kind& kind : kinds()) {
    const Run alone = run(scenario_file, {kind}, seconds);
    const Counted& counted = alone.displays.front();
    std::printf("%-18s %12.1f %12.1f %14.2f\n", kind.name.c_str(),
                static_cast<double>(counted.datagrams) / alone.seconds,
                static_cast<double>(counted.bytes) / alone.seconds / 1000.0,
                100.0 * (alone.core - idle));
    std::fflush(stdout);
  }
}

void bench(double seconds) {
  const auto folder =
      std::filesystem::temp_directory_path() / fmt::format("output-bench-{}", ::getpid());
  std::filesystem::create_directory(folder);
  const auto file = [&](int rpm) {
    const auto path = folder / fmt::format("{}.yaml", rpm);
    std::ofstream(path) << scenario(rpm);
    return path.string();
  };
  print_each(file(24), seconds);
  for (const int rpm : {24, 48}) print_timing(file(rpm), rpm, 2 * seconds);
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace skerry::bench

int main(int argc, char** argv) {
  double seconds = 10.0;
  if (argc == 3 && std::string(argv[1]) == "--seconds") {
    seconds = std::atof(argv[2]);
  } else if (argc == 2 && std::string_view(argv[1]).starts_with("--benchmark")) {
    seconds = 0.5;  // run with the others, shortly
  } else if (argc != 1) {
    seconds = 0.0;
  }
  if (!(seconds > 0)) {
    std::fprintf(stderr, "output_bench [--seconds N]\n");
    return 2;
  }
  try {
    skerry::bench::bench(seconds);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "output_bench: %s\n", error.what());
    return 1;
  }
}

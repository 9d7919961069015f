// class_check: a class on one host.  Own ships with a radar each, each with a console on TCP that
// has the con and steers and a console on WebSocket; hundreds of targets that give way, sea and
// rain; an instructor who looks at everything and changes the rain.
//
//   class_check                          30 minutes of 20 ships and 500 targets
//   class_check --ships 40 --cores 1     how many ships does one core carry?
//
// Ends with 1 if a console missed a spoke, an order was refused, a sector was late or the memory
// grew; prints the CPU time of each part.  With --small it only counts: for tests, on busy
// machines.
#include <fmt/format.h>
#include <sched.h>
#include <sys/resource.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <exception>
#include <functional>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/system/class_scenario.hpp"
#include "tests/system/load_console.hpp"
#include "tests/system/running_server.hpp"

namespace skerry::system_test {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::seconds kPatience{120};
constexpr double kOrderEvery = 15.0;      // s, of each helm
constexpr double kMemoryEvery = 10.0;     // s
constexpr double kMemorySettles = 120.0;  // s: heaps and rings fill
constexpr double kMemoryGrows = 1.03;     // at most, from then to the end

struct Options {
  ClassSize size;
  double seconds = 1800.0;
  double rain_every = 60.0;  // s
  int cores = 0;             // 0: all
};

double seconds_since(Clock::time_point begun) {
  return std::chrono::duration<double>(Clock::now() - begun).count();
}

double own_cpu_seconds() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

// What is started while this lives runs on that many of this machine's cores.
class FewerCores {
 public:
  explicit FewerCores(int cores) {
    ::sched_getaffinity(0, sizeof all_, &all_);
    cpu_set_t few;
    CPU_ZERO(&few);
    for (int cpu = 0; cpu < CPU_SETSIZE && CPU_COUNT(&few) < cores; ++cpu) {
      if (CPU_ISSET(cpu, &all_)) CPU_SET(cpu, &few);
    }
    if (cores > 0) ::sched_setaffinity(0, sizeof few, &few);
  }
  ~FewerCores() { ::sched_setaffinity(0, sizeof all_, &all_); }
  FewerCores(const FewerCores&) = delete;
  FewerCores& operator=(const FewerCores&) = delete;

 private:
  cpu_set_t all_;
};

class ClassCheck {
 public:
  explicit ClassCheck(const Options& options) : options_(options) {
    {
      const FewerCores fewer(options.cores);
      server_ = std::make_unique<ServerProcess>(std::vector<std::string>{
          "--scenario", folder_.write("class.yaml", class_scenario(options.size))});
    }
    for (unsigned ship = 0; ship < options.size.ships; ++ship) {
      auto helm = std::make_unique<LoadConsole>(server_->tcp_port());
      wire::Subscribe looks;
      looks.set_radar(ship);
      looks.set_own_ship_hz(2);
      helm->subscribe(looks);
      wire::Set takes;
      takes.set_radar(ship);
      takes.mutable_con()->set_take(true);
      helm->set(takes);
      readers_.push_back({ship, helm.get()});
      helms_.push_back(std::move(helm));
      seconds_.push_back(std::make_unique<LoadWebConsole>(server_->http_port()));
      seconds_.back()->subscribe(ship);
      readers_.push_back({ship, seconds_.back().get()});
    }
    instructor_ = std::make_unique<LoadConsole>(server_->tcp_port());
    wire::Subscribe sees;
    sees.set_no_spokes(true);
    sees.set_exercise_hz(2);
    instructor_->subscribe(sees);
  }

  // True if all is as it should be.
  bool run() {
    read_until([&] {
      return std::all_of(readers_.begin(), readers_.end(), [](const Reader& reader) {
        return reader.console->spokes().newest().has_value();
      });
    });
    begin_counting();
    const wire::Status before = status();
    const auto threads_before = server_->cpu_seconds_by_thread();
    const double consoles_before = own_cpu_seconds();
    const std::uint64_t bytes_before = bytes();
    begun_ = Clock::now();
    while (seconds_since(begun_) < options_.seconds) {
      read_once();
      give_orders();
      look_at_memory();
    }
    const double seconds = seconds_since(begun_);
    auto threads = server_->cpu_seconds_by_thread();
    for (auto& [name, cpu] : threads) {
      const auto old = threads_before.find(name);
      if (old != threads_before.end()) cpu -= old->second;
    }
    const double consoles = own_cpu_seconds() - consoles_before;
    const double megabytes = static_cast<double>(bytes() - bytes_before) * 1e-6;
    end_counting();
    const wire::Status after = status();
    check_lateness(before, after);
    check_memory();
    expect(instructor_->exercise_states() > 0 && helms_.front()->own_ships() > 0,
           "the instructor sees the exercise, the helms their ships");
    print(threads, seconds, consoles, megabytes);
    const Ending ending = server_->stop();
    expect(ending.code == 0, "the server ended well");
    if (ending.code != 0) std::printf("%s\n", ending.err.c_str());
    return good_;
  }

 private:
  struct Reader {
    std::uint32_t radar;
    LoadConsole* console;
  };

  void expect(bool right, const std::string& what) {
    std::printf("%s  %s\n", right ? "ok   " : "WRONG", what.c_str());
    good_ = good_ && right;
  }

  void read_once() {
    std::vector<LoadReceiver*> receivers = {instructor_.get()};
    for (const Reader& reader : readers_) receivers.push_back(reader.console);
    read_ready(receivers);
  }

  void read_until(const std::function<bool()>& condition) {
    for (const auto deadline = Clock::now() + kPatience; !condition(); read_once()) {
      if (Clock::now() > deadline) throw std::runtime_error("the server does not go on");
    }
  }

  wire::Status status() {
    instructor_->ask_status();
    read_until([&] { return instructor_->status().has_value(); });
    return *instructor_->status();
  }

  std::uint64_t bytes() const {
    std::uint64_t sum = 0;
    for (const Reader& reader : readers_) sum += reader.console->bytes();
    return sum;
  }

  // Each helm in its turn, so that some order is always on its way.  An order that is refused ends
  // the check (LoadConsole::read).
  void give_orders() {
    const double now = seconds_since(begun_);
    const double step = kOrderEvery / static_cast<double>(helms_.size());
    for (; static_cast<double>(orders_) * step < now; ++orders_) {
      const std::size_t ship = orders_ % helms_.size();
      const std::size_t round = orders_ / helms_.size();
      wire::Set set;
      set.set_radar(static_cast<std::uint32_t>(ship));
      if (round % 4 == 3) {
        set.mutable_con()->set_heading_deg(38.0);
        set.mutable_con()->set_steering(wire::STEERING_HEADING);
      } else {
        set.mutable_con()->set_rudder_deg(round % 2 == 0 ? 10.0 : -10.0);
        set.mutable_con()->set_engine_percent(60.0 + static_cast<double>(10 * (ship % 4)));
      }
      helms_[ship]->set(set);
    }
    if (static_cast<double>(rains_ + 1) * options_.rain_every < now) {
      wire::Set set;
      set.set_instructor(true);
      wire::RainChange& rain = *set.mutable_world()->add_rain();
      rain.set_id(1);
      rain.set_rate_mm_h(rains_ % 2 == 0 ? 16.0 : 8.0);
      instructor_->set(set);
      ++rains_;
    }
  }

  void look_at_memory() {
    if (seconds_since(begun_) < static_cast<double>(memory_.size()) * kMemoryEvery) return;
    memory_.push_back(status().resident_mib());
    std::fprintf(stderr, "\r%.0f of %.0f s, %.1f MiB ", seconds_since(begun_), options_.seconds,
                 memory_.back());
  }

  // All consoles of a radar count from the same spoke to the same spoke.
  void begin_counting() {
    for (const Reader& reader : readers_) {
      std::uint64_t& begin = begin_[reader.radar];
      begin = std::max(begin, *reader.console->spokes().newest() + 1);
    }
    for (const Reader& reader : readers_) {
      reader.console->spokes().count_from(begin_[reader.radar]);
    }
  }

  void end_counting() {
    std::map<std::uint32_t, std::uint64_t> end;
    for (const Reader& reader : readers_) {
      end[reader.radar] = std::max(end[reader.radar], *reader.console->spokes().newest());
    }
    std::uint64_t spokes = 0, lost = 0, twice = 0;
    bool all = true;
    for (const Reader& reader : readers_) {
      SpokeCount& count = reader.console->spokes();
      read_until([&] { return *count.newest() >= end[reader.radar]; });
      const std::uint64_t wanted = *count.newest() - begin_[reader.radar] + 1;
      all = all && count.counted() == wanted;
      spokes += count.counted();
      lost += count.losses().lost();
      twice += count.losses().duplicates();
    }
    std::fprintf(stderr, "\n");
    expect(all && lost == 0 && twice == 0,
           fmt::format("{} consoles got {} spokes: {} lost, {} came twice", readers_.size(), spokes,
                       lost, twice));
  }

  void check_lateness(const wire::Status& before, const wire::Status& after) {
    std::uint64_t late = 0, skipped = 0;
    double worst = 0.0;
    for (int radar = 0; radar < after.radars_size(); ++radar) {
      late += after.radars(radar).spokes_late() - before.radars(radar).spokes_late();
      skipped += after.radars(radar).sectors_skipped() - before.radars(radar).sectors_skipped();
      worst = std::max(worst, after.radars(radar).lateness_max_ms());
    }
    const std::string what = fmt::format(
        "{} spokes late by more than a sector, {} sectors left out; the latest {:.1f} ms after its "
        "end",
        late, skipped, worst);
    if (options_.size.small) {
      std::printf("       %s\n", what.c_str());
    } else {
      expect(late == 0 && skipped == 0, what);
    }
  }

  void check_memory() {
    const auto settled = static_cast<std::size_t>(kMemorySettles / kMemoryEvery);
    if (memory_.size() < settled + 6) {
      std::printf("       memory %.1f MiB; too short a time to say whether it grows\n",
                  memory_.back());
      return;
    }
    const auto median = [](std::vector<double> values) {
      std::nth_element(values.begin(), values.begin() + static_cast<long>(values.size() / 2),
                       values.end());
      return values[values.size() / 2];
    };
    const auto sixth = static_cast<long>((memory_.size() - settled) / 6);
    const auto first = memory_.begin() + static_cast<long>(settled);
    const double early = median({first, first + sixth}),
                 late = median({memory_.end() - sixth, memory_.end()});
    expect(late < kMemoryGrows * early,
           fmt::format("memory {:.1f} MiB after two minutes, {:.1f} MiB at the end", early, late));
  }

  void print(const std::map<std::string, double>& threads, double seconds, double consoles,
             double megabytes) const {
    const double ships = options_.size.ships;
    std::printf("\n%u own ships, %u targets, %.0f s, %.1f MB/s to %zu consoles\n",
                options_.size.ships, options_.size.targets, seconds, megabytes / seconds,
                readers_.size());
    std::printf("%-28s %10s %14s\n", "part", "% of core", "ms/s and ship");
    double sum = 0.0;
    for (const auto& [name, cpu] : threads) {
      sum += cpu;
      std::printf("%-28s %10.1f %14.2f\n", name.c_str(), 100.0 * cpu / seconds,
                  1000.0 * cpu / seconds / ships);
    }
    std::printf("%-28s %10.1f %14.2f\n", "server", 100.0 * sum / seconds,
                1000.0 * sum / seconds / ships);
    std::printf("%-28s %10.1f %14.2f\n", "the consoles (this program)", 100.0 * consoles / seconds,
                1000.0 * consoles / seconds / ships);
  }

  Options options_;
  TempFolder folder_;
  std::unique_ptr<ServerProcess> server_;
  std::vector<std::unique_ptr<LoadConsole>> helms_;
  std::vector<std::unique_ptr<LoadWebConsole>> seconds_;
  std::unique_ptr<LoadConsole> instructor_;
  std::vector<Reader> readers_;
  std::map<std::uint32_t, std::uint64_t> begin_;
  std::vector<double> memory_;  // MiB, every kMemoryEvery
  Clock::time_point begun_;
  std::size_t orders_ = 0, rains_ = 0;
  bool good_ = true;
};

}  // namespace
}  // namespace skerry::system_test

int main(int argc, char** argv) {
  using namespace skerry::system_test;
  Options options;
  CLI::App cli{"Runs skerryd with a class: own ships, two consoles each, traffic, sea and rain"};
  cli.add_option("--ships", options.size.ships, "Own ships")->check(CLI::Range(1, 64));
  cli.add_option("--targets", options.size.targets, "Targets")->check(CLI::Range(20, 500));
  cli.add_option("--seconds", options.seconds, "How long")->check(CLI::Range(4.0, 86400.0));
  cli.add_option("--rain-every", options.rain_every, "Seconds between changes of a rain")
      ->check(CLI::Range(1.0, 86400.0));
  cli.add_option("--cores", options.cores, "For the server; 0: all")->check(CLI::Range(0, 64));
  cli.add_flag(
      "--open-sea", options.size.open_sea,
      "In the Atlantic instead of the Dover Strait: no coast, whose indexes differ in size");
  cli.add_flag("--small", options.size.small,
               "Small radars, and lateness is no fault: for servers with a sanitizer");
  CLI11_PARSE(cli, argc, argv);
  try {
    return ClassCheck(options).run() ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "class_check: %s\n", error.what());
    return 1;
  }
}

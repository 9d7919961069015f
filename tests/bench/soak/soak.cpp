// soak: a server with radars that record, and one that plays, for hours: consoles come and go, turn
// knobs, stall and are cut off; strangers talk nonsense; the disk fills; SIGHUPs come.
//
//   soak                                  two hours, 20 consoles, graph in soak.png
//   soak --minutes 10 --consoles 40       shorter and fuller
//   soak --minutes 0.6 --ebb-seconds 18   the short form that the tests run
//
// Now and then all leave; what the servers hold then is compared.  Ends with 1 if a console that
// read all the time lost a spoke, a file of the recording is damaged or misses a spoke that the
// recorder does not tell of, descriptors or threads stay behind, memory grows, or a server ends
// badly.  Radars that are late are told and are no fault: the machine may be busy.
#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/mount.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <exception>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "tests/bench/child_server.hpp"
#include "tests/bench/soak/intruders.hpp"
#include "tests/bench/soak/series_check.hpp"
#include "tests/bench/soak/soak_graph.hpp"
#include "tests/bench/soak/visitors.hpp"
#include "tests/system/child_process.hpp"
#include "tests/system/load_console.hpp"

namespace skerry::bench {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using system_test::LoadConsole;
using system_test::LoadReceiver;

struct Options {
  double minutes = 120.0;
  std::size_t consoles = 20;
  double ebb_seconds = 600.0;
  double fault_seconds = 20.0;
  std::uint64_t seed = 1;
  std::string graph = "soak.png", log = "/dev/null";
};

constexpr double kEbbLasts = 8.0;  // views end some seconds after their last subscriber
constexpr double kDiskIsFull = 5.0;
constexpr double kSampleEvery = 5.0;
constexpr double kPlayedSeconds = 8.0;
constexpr std::chrono::seconds kPatience{30};
// What may stay behind from ebb to ebb: caches, fragments of the heap.
constexpr double kRoomMib = 12.0, kRoomShare = 0.05;
constexpr double kCachesFill = 10.0;  // minutes; memory of shorter soaks is told and not judged
// A recording rolls just now, or a page is being sent.
constexpr int kRoomDescriptors = 2;

double seconds_since(Clock::time_point begun) {
  return std::chrono::duration<double>(Clock::now() - begun).count();
}

// Where recordings go: a disk of its own that can be filled, if this process may mount one.
class RecordingDisk {
 public:
  explicit RecordingDisk(std::string folder) : folder_(std::move(folder)) {
    fs::create_directory(folder_);
    is_small_ = ::mount("none", folder_.c_str(), "tmpfs", 0, "size=1280m") == 0;
  }
  ~RecordingDisk() {
    if (is_small_) ::umount2(folder_.c_str(), MNT_DETACH);
  }
  RecordingDisk(const RecordingDisk&) = delete;
  RecordingDisk& operator=(const RecordingDisk&) = delete;

  const std::string& folder() const { return folder_; }
  bool can_be_filled() const { return is_small_; }
  // On a thread of its own: consoles go on being read.
  void fill() {
    filling_ = std::jthread([file_name = ballast(), folder = folder_] {
      struct statvfs room {};
      ::statvfs(folder.c_str(), &room);
      const int file = ::open(file_name.c_str(), O_CREAT | O_WRONLY | O_CLOEXEC, 0600);
      ::posix_fallocate(file, 0, static_cast<off_t>(room.f_bavail * room.f_frsize));
      ::close(file);
    });
  }
  void make_room() {
    filling_ = {};
    fs::remove(ballast());
  }

 private:
  std::string ballast() const { return folder_ + "/ballast"; }
  std::string folder_;
  bool is_small_ = false;
  std::jthread filling_;
};

// A short recording for the server that plays.
std::string record_something(const std::string& folder, const std::string& log) {
  ChildServer server({"--record", "--record-folder", folder}, log);
  std::this_thread::sleep_for(std::chrono::duration<double>(kPlayedSeconds));
  if (server.stop() != 0) throw std::runtime_error("the server that records ended badly");
  const auto files = recordings_in(folder);
  if (files.empty()) throw std::runtime_error("nothing was recorded");
  return files.front().string();
}

class Soak {
 public:
  explicit Soak(const Options& options)
      : options_(options),
        disk_(folder_.path("recordings")),
        played_(record_something(folder_.path("played"), options.log)),
        live_({"--record", "--record-folder", disk_.folder(), "--record-roll-minutes", "1",
               "--record-keep-gib", "1", "--record-reserve-mib", "0", "--record-fsync", "none",
               "--audit", folder_.path("audit"), "--audit-roll-mib", "1"},
              options.log),
        player_({"--play", played_, "--play-loop"}, options.log),
        at_live_(live_.tcp_port()),
        at_player_(player_.tcp_port()),
        series_(disk_.folder()),
        intruders_(live_.tcp_port(), live_.http_port(), options.seed + 2) {
    const wire::Status live = status(at_live_);
    consoles_.emplace(Visited{live_.tcp_port(), live_.http_port(),
                              static_cast<std::uint32_t>(live.radars_size()), true, 0.0},
                      options.consoles - options.consoles / 4, options.seed);
    const wire::Status player = status(at_player_);
    lookers_.emplace(
        Visited{player_.tcp_port(), player_.http_port(),
                static_cast<std::uint32_t>(player.radars_size()), false, kPlayedSeconds - 2.0},
        options.consoles / 4, options.seed + 1);
    if (!disk_.can_be_filled()) {
      fmt::print("the disk is not filled: that needs to mount a tmpfs, run as root\n");
    }
  }

  // True if nothing was lost and nothing grew.
  bool run() {
    while (seconds_since(begun_) < 60.0 * options_.minutes) {
      flow(std::min(options_.ebb_seconds - kEbbLasts,
                    60.0 * options_.minutes - seconds_since(begun_) - kEbbLasts));
      ebb();
    }
    end();
    write_soak_graph(options_.graph, samples_);
    fmt::print("graph: {}\n", options_.graph);
    return good_;
  }

 private:
  void expect(bool right, const std::string& what) {
    fmt::print("{}  {}\n", right ? "ok   " : "WRONG", what);
    good_ = good_ && right;
  }

  void read_once() {
    std::vector<LoadReceiver*> readers = {&at_live_, &at_player_};
    if (consoles_) consoles_->add_readers(readers);
    if (lookers_) lookers_->add_readers(readers);
    read_ready(readers);
  }

  wire::Status status(LoadConsole& console) {
    console.ask_status();
    for (const auto asked = Clock::now(); !console.status(); read_once()) {
      if (Clock::now() - asked > kPatience) throw std::runtime_error("a server does not answer");
    }
    return *console.status();
  }

  void sample(bool is_ebb) {
    SoakSample sample{seconds_since(begun_) / 60.0, figures_of(live_.pid()),
                      figures_of(player_.pid()), is_ebb ? 0 : options_.consoles, is_ebb};
    samples_.push_back(sample);
    sampled_ = Clock::now();
    if (!is_ebb && seconds_since(told_) < 60.0) return;
    told_ = Clock::now();
    fmt::print(
        "{:6.1f} min {:>4} live {:6.1f} MiB {:3} descriptors {:2} threads; player {:6.1f} {:3} "
        "{:2}; "
        "{} visits, {} spokes, {} lost; {} files\n",
        sample.minutes, is_ebb ? "ebb" : "", sample.live.resident_mib, sample.live.descriptors,
        sample.live.threads, sample.player.resident_mib, sample.player.descriptors,
        sample.player.threads, consoles_->counts().visits + lookers_->counts().visits,
        consoles_->counts().spokes + lookers_->counts().spokes,
        consoles_->counts().lost + lookers_->counts().lost, series_.files());
    std::fflush(stdout);
  }

  void flow(double seconds) {
    const auto begun = Clock::now();
    consoles_->begin();
    lookers_->begin();
    while (seconds_since(begun) < seconds) {
      const auto now = Clock::now();
      consoles_->look(now);
      lookers_->look(now);
      intruders_.look(now);
      read_once();
      if (seconds_since(faulted_) > options_.fault_seconds) do_harm();
      if (full_since_ && seconds_since(*full_since_) > kDiskIsFull) make_room();
      if (seconds_since(sampled_) > kSampleEvery) {
        sample(false);
        series_.look(false);
      }
    }
  }

  void do_harm() {
    faulted_ = Clock::now();
    switch (harm_++ % 4) {
      case 1:
        ::kill(live_.pid(), SIGHUP);
        ::kill(player_.pid(), SIGHUP);
        ++hangups_;
        break;
      case 3:
        if (!disk_.can_be_filled() || full_since_) break;
        lost_before_ = status(at_live_).recorder().spokes_lost();
        lost_meanwhile_not_ += lost_before_ - lost_seen_;
        disk_.fill();
        full_since_ = Clock::now();
        ++fillings_;
        break;
      default:
        intruders_.come(faulted_);
    }
  }

  void make_room() {
    full_since_.reset();
    disk_.make_room();
    // It goes on by itself; what it lost until then is the disk's fault.
    const auto since = Clock::now();
    while (status(at_live_).recorder().phase() != wire::RecorderState::RECORDING) {
      if (Clock::now() - since > kPatience) throw std::runtime_error("the recorder does not go on");
    }
    lost_seen_ = status(at_live_).recorder().spokes_lost();
    lost_to_the_disk_ += lost_seen_ - lost_before_;
  }

  void ebb() {
    if (full_since_) make_room();
    consoles_->leave();
    lookers_->leave();
    intruders_.leave();
    while (consoles_->is_anybody_there() || lookers_->is_anybody_there()) {
      consoles_->look(Clock::now());
      lookers_->look(Clock::now());
      read_once();
    }
    for (const auto begun = Clock::now(); seconds_since(begun) < kEbbLasts;) read_once();
    sample(true);
  }

  void end() {
    const wire::Status live = status(at_live_);
    lost_meanwhile_not_ += live.recorder().spokes_lost() - lost_seen_;
    fmt::print("\n{:.1f} minutes\n", seconds_since(begun_) / 60.0);
    const VisitCounts& at_live = consoles_->counts();
    const VisitCounts& at_player = lookers_->counts();
    for (const auto& [name, counts] :
         {std::pair("radars", at_live), std::pair("player", at_player)}) {
      fmt::print(
          "{}: {} visits, {} of them to views of their own, {} orders, {} cut off, {} stalled "
          "(these missed {} spokes)\n",
          name, counts.visits, counts.views, counts.orders, counts.resets, counts.stalls,
          counts.stalls_lost);
    }
    fmt::print("intruders: {} came, {} were closed by the server, {} were let in not at all\n",
               intruders_.came(), intruders_.closed_by_server(), intruders_.refused());
    for (const wire::RadarStatus& radar : live.radars()) {
      fmt::print("radar {}: {} spokes, {} late, {} sectors skipped, at most {:.1f} ms late\n",
                 radar.radar(), radar.spokes(), radar.spokes_late(), radar.sectors_skipped(),
                 radar.lateness_max_ms());
    }
    fmt::print("{} SIGHUPs; the disk was full {} times, which cost the recording {} spokes\n",
               hangups_, fillings_, lost_to_the_disk_);
    std::uint64_t skipped = 0;
    for (const wire::RadarStatus& radar : live.radars()) skipped += radar.sectors_skipped();
    // On a machine that leaves radars no time for half a second, nobody else has any.
    const char* const excuse = skipped > 0 ? ", on a machine that was too slow for its radars" : "";
    const std::uint64_t spokes = at_live.spokes + at_player.spokes;
    const std::uint64_t lost = at_live.lost + at_player.lost;
    expect(spokes > 0 && (lost == 0 || skipped > 0),
           fmt::format("consoles that read all the time: {} spokes, {} lost{}", spokes, lost,
                       lost > 0 ? excuse : ""));
    expect(at_live.untold + at_player.untold == 0,
           fmt::format("losses that the servers do not tell of: {} at the radars, {} at the player",
                       at_live.untold, at_player.untold));
    expect(live_.stop() == 0, "the server with radars ended well");
    expect(player_.stop() == 0, "the server that plays ended well");
    series_.finish();
    for (const std::string& damage : series_.damaged()) fmt::print("{}\n", damage);
    expect(series_.files() > 0 && series_.damaged().empty(),
           fmt::format("{} files of the recording, {} spokes: {} damaged", series_.files(),
                       series_.spokes(), series_.damaged().size()));
    expect(
        (lost_meanwhile_not_ == 0 || skipped > 0) &&
            series_.missing() == lost_to_the_disk_ + lost_meanwhile_not_,
        fmt::format("missing in them: {} spokes; the recorder told of {} lost to the full disk and "
                    "{} besides{}",
                    series_.missing(), lost_to_the_disk_, lost_meanwhile_not_,
                    lost_meanwhile_not_ > 0 ? excuse : ""));
    judge("radars", &SoakSample::live);
    judge("player", &SoakSample::player);
  }

  void judge(const std::string& name, ProcessFigures SoakSample::*of) {
    std::vector<ProcessFigures> ebbs;
    for (const SoakSample& sample : samples_) {
      if (sample.is_ebb) ebbs.push_back(sample.*of);
    }
    const ProcessFigures& first = ebbs.front();
    const ProcessFigures& last = ebbs.back();
    expect(
        ebbs.size() > 1 && last.descriptors <= first.descriptors + kRoomDescriptors &&
            last.threads <= first.threads,
        fmt::format("{}: {} ebbs, from {} to {} descriptors, from {} to {} threads", name,
                    ebbs.size(), first.descriptors, last.descriptors, first.threads, last.threads));
    // The first half fills caches; from its highest to that of the second nothing may grow.
    const auto highest = [](auto begin, auto end) {
      return std::max_element(begin, end,
                              [](const auto& a, const auto& b) { return a.heap_mib < b.heap_mib; })
          ->heap_mib;
    };
    const auto half = ebbs.begin() + static_cast<long>((ebbs.size() + 1) / 2);
    const double before = highest(ebbs.begin(), half);
    const double after = half == ebbs.end() ? before : highest(half, ebbs.end());
    expect(
        options_.minutes < kCachesFill || after <= before * (1.0 + kRoomShare) + kRoomMib,
        fmt::format("{}: memory of its own at ebb at most {:.1f} MiB in the first half, {:.1f} in "
                    "the second",
                    name, before, after));
  }

  const Options options_;
  system_test::TempFolder folder_;
  RecordingDisk disk_;
  const std::string played_;
  ChildServer live_, player_;
  LoadConsole at_live_, at_player_;
  SeriesCheck series_;
  std::optional<Visitors> consoles_, lookers_;
  Intruders intruders_;
  const Clock::time_point begun_ = Clock::now();
  Clock::time_point sampled_ = begun_, told_ = begun_, faulted_ = begun_;
  std::optional<Clock::time_point> full_since_;
  std::vector<SoakSample> samples_;
  std::uint64_t harm_ = 0, hangups_ = 0, fillings_ = 0;
  // Of the recorder: at the last look, before the disk was filled, while it was, and otherwise.
  std::uint64_t lost_seen_ = 0, lost_before_ = 0, lost_to_the_disk_ = 0, lost_meanwhile_not_ = 0;
  bool good_ = true;
};

}  // namespace
}  // namespace skerry::bench

int main(int argc, char** argv) {
  using namespace skerry::bench;
  Options options;
  CLI::App cli{"Runs servers for hours under consoles that come and go, and sees what grows"};
  cli.add_option("--minutes", options.minutes, "how long")
      ->check(CLI::Range(0.5, 10000.0))
      ->capture_default_str();
  cli.add_option("--consoles", options.consoles, "at a time; a quarter at the server that plays")
      ->check(CLI::Range(4, 200))
      ->capture_default_str();
  cli.add_option("--ebb-seconds", options.ebb_seconds, "from one ebb to the next")
      ->check(CLI::Range(16.0, 100000.0))
      ->capture_default_str();
  cli.add_option("--fault-seconds", options.fault_seconds, "from one fault to the next")
      ->check(CLI::Range(1.0, 100000.0))
      ->capture_default_str();
  cli.add_option("--seed", options.seed, "what consoles do")->capture_default_str();
  cli.add_option("--graph", options.graph, "a PNG")->capture_default_str();
  cli.add_option("--log", options.log, "the servers' log")->capture_default_str();
  CLI11_PARSE(cli, argc, argv);
  try {
    return Soak(options).run() ? 0 : 1;
  } catch (const std::exception& error) {
    fmt::print(stderr, "soak: {}\n", error.what());
    return 1;
  }
}

// load_check: 16 consoles on TCP, 4 subscribers of datagrams and one console that stops reading for
// a while.  Fails if one of the others loses a spoke, if the stalled one's loss is not counted
// exactly, or if a spoke was encoded twice.  Prints how late the antenna was, which is no business
// of a test: the machine may be busy.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <exception>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "protocol/video/scan_geometry.hpp"
#include "tests/system/load_console.hpp"
#include "tests/system/running_server.hpp"
#include "tests/system/small_scenario.hpp"

namespace skerry::system_test {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::uint32_t kConsoles = 16, kSubscribers = 4;
constexpr std::uint32_t kRadars = 2;  // half of them on each
constexpr int kStalledReceiveBuffer = 32 * 1024;
constexpr std::chrono::seconds kPatience{60};

struct Options {
  double seconds = 60.0;
  bool small = false;
};

class LoadCheck {
 public:
  explicit LoadCheck(const Options& options) : options_(options) {
    for (std::uint32_t i = 0; i < kSubscribers; ++i) {
      subscribers_.push_back(std::make_unique<LoadSubscriber>());
    }
    std::vector<std::string> arguments;
    if (options.small) arguments = {"--scenario", folder_.write("small.yaml", small_scenario())};
    for (std::uint32_t i = 0; i < kSubscribers; ++i) {
      arguments.push_back("--udp");
      arguments.push_back(fmt::format("{}@127.0.0.1:{}", i % kRadars, subscribers_[i]->port()));
    }
    server_ = std::make_unique<ServerProcess>(arguments);
    for (std::uint32_t i = 0; i < kConsoles; ++i) {
      consoles_.push_back(std::make_unique<LoadConsole>(server_->tcp_port()));
      consoles_.back()->subscribe(i % kRadars);
    }
    stalled_ = std::make_unique<LoadConsole>(server_->tcp_port(), kStalledReceiveBuffer);
    stalled_->subscribe(0);
    control_ = std::make_unique<LoadConsole>(server_->tcp_port());
    for (std::uint32_t i = 0; i < kConsoles; ++i)
      readers_.push_back({i % kRadars, consoles_[i].get()});
    for (std::uint32_t i = 0; i < kSubscribers; ++i) {
      readers_.push_back({i % kRadars, subscribers_[i].get()});
    }
  }

  // True if all counts are right.
  bool run() {
    read_until([&] { return stalled_->spokes().newest() && everybody_has_spokes(); });
    begin_counting();
    const auto unencoded_before = unencoded();
    const double cpu_before = server_->cpu_seconds();
    const std::uint64_t bytes_before = bytes();
    const auto begun = Clock::now();

    read_for(0.25 * options_.seconds);
    stalled_reads_ = false;
    read_for(0.25 * options_.seconds);
    // More than all buffers on the way hold: two turns.  The server counts what a console misses
    // when it takes the next spokes for it, so not before that reads again.
    const std::uint64_t enough = *stalled_->spokes().newest() + 2 * spokes_per_turn();
    read_until([&] { return *readers_.front().receiver->spokes().newest() > enough; });
    stalled_reads_ = true;
    read_for(options_.seconds - seconds_since(begun));

    const double seconds = seconds_since(begun);
    const double cpu = server_->cpu_seconds() - cpu_before;
    const double rate = static_cast<double>(bytes() - bytes_before) / seconds;
    end_counting();
    stalled_->ask_status();
    read_until([&] { return stalled_->status().has_value(); });
    check_stalled();
    check_encodes(unencoded_before);
    print(status(), seconds, cpu, rate);
    const Ending ending = server_->stop();
    expect(ending.code == 0, "the server ended well");
    if (ending.code != 0) std::printf("%s\n", ending.err.c_str());
    return good_;
  }

 private:
  struct Reader {
    std::uint32_t radar;
    LoadReceiver* receiver;
  };

  static double seconds_since(Clock::time_point begun) {
    return std::chrono::duration<double>(Clock::now() - begun).count();
  }

  void expect(bool right, const std::string& what) {
    std::printf("%s  %s\n", right ? "ok   " : "WRONG", what.c_str());
    good_ = good_ && right;
  }

  bool everybody_has_spokes() const {
    return std::all_of(readers_.begin(), readers_.end(), [](const Reader& reader) {
      return reader.receiver->spokes().newest().has_value();
    });
  }

  void read_once() {
    std::vector<LoadReceiver*> receivers = {control_.get()};
    if (stalled_reads_) receivers.push_back(stalled_.get());
    for (const Reader& reader : readers_) receivers.push_back(reader.receiver);
    read_ready(receivers);
  }

  void read_for(double seconds) {
    for (const auto begun = Clock::now(); seconds_since(begun) < seconds;) read_once();
  }

  void read_until(const std::function<bool()>& condition) {
    for (const auto deadline = Clock::now() + kPatience; !condition(); read_once()) {
      if (Clock::now() > deadline) throw std::runtime_error("the server does not go on");
    }
  }

  wire::Status status() {
    control_->ask_status();
    read_until([&] { return control_->status().has_value(); });
    return *control_->status();
  }

  std::uint64_t spokes_per_turn() const {
    return options_.small ? kSmallSpokes : ScanGeometry().spokes_per_turn;
  }

  std::uint64_t bytes() {
    std::uint64_t sum = 0;
    for (const Reader& reader : readers_) sum += reader.receiver->bytes();
    return sum;
  }

  // All receivers of a radar count from the same spoke to the same spoke.
  void begin_counting() {
    for (const Reader& reader : readers_) {
      begin_[reader.radar] =
          std::max(begin_[reader.radar], *reader.receiver->spokes().newest() + 1);
    }
    for (const Reader& reader : readers_) {
      reader.receiver->spokes().count_from(begin_[reader.radar]);
    }
  }

  void end_counting() {
    std::array<std::uint64_t, kRadars> end{};
    for (const Reader& reader : readers_) {
      end[reader.radar] = std::max(end[reader.radar], *reader.receiver->spokes().newest());
    }
    std::uint64_t lost = 0, duplicates = 0;
    bool equal = true;
    for (const Reader& reader : readers_) {
      SpokeCount& spokes = reader.receiver->spokes();
      read_until([&] { return *spokes.newest() >= end[reader.radar]; });
      const std::uint64_t beyond = *spokes.newest() - end[reader.radar];
      equal = equal && spokes.counted() == end[reader.radar] - begin_[reader.radar] + 1 + beyond;
      lost += spokes.losses().lost();
      duplicates += spokes.losses().duplicates();
    }
    expect(lost == 0 && duplicates == 0, fmt::format("{} readers: {} spokes lost, {} came twice",
                                                     readers_.size(), lost, duplicates));
    expect(equal, fmt::format("every reader counts the same: {} spokes of radar 0, {} of radar 1",
                              end[0] - begin_[0] + 1, end[1] - begin_[1] + 1));
  }

  std::uint64_t lost_by_stalled(const wire::Status& status) const {
    for (const wire::ClientStatus& client : status.clients()) {
      if (client.peer() == stalled_->name()) return client.spokes_lost();
    }
    throw std::runtime_error("the server does not know the stalled console");
  }

  // The status it asked for itself stands in its stream behind all that was sent before.
  void check_stalled() {
    const LossCounter& seen = stalled_->spokes().losses();
    const std::uint64_t lost = lost_by_stalled(*stalled_->status());
    expect(lost == seen.lost() && lost > 0,
           fmt::format("the stalled console got {} spokes and missed {}; the server says {}",
                       seen.received(), seen.lost(), lost));
  }

  // Spokes of each radar that were made but not encoded: those before the first reader was there.
  // A status taken while a sector is on its way counts it as encoded but not yet as made, and on a
  // busy machine the radar's thread may wait there for many milliseconds; hence the highest of a
  // second's statuses.
  std::array<std::int64_t, kRadars> unencoded() {
    std::array<std::int64_t, kRadars> highest;
    highest.fill(INT64_MIN);
    for (const auto begun = Clock::now(); seconds_since(begun) < 1.0; read_for(0.02)) {
      const wire::Status now = status();
      for (std::uint32_t radar = 0; radar < kRadars; ++radar) {
        const wire::RadarStatus& counts = now.radars(radar);
        highest[radar] =
            std::max(highest[radar], static_cast<std::int64_t>(counts.spokes()) -
                                         static_cast<std::int64_t>(counts.encodes().at("native")));
      }
    }
    return highest;
  }

  void check_encodes(const std::array<std::int64_t, kRadars>& before) {
    const auto after = unencoded();
    for (std::uint32_t radar = 0; radar < kRadars; ++radar) {
      expect(
          after[radar] == before[radar],
          fmt::format("radar {}: each spoke was encoded once ({} were not before, {} are not now)",
                      radar, before[radar], after[radar]));
    }
    const wire::Status now = status();
    for (std::uint32_t radar = 0; radar < kRadars; ++radar) {
      for (const auto& [format, spokes] : now.radars(radar).encodes()) {
        if (format == "native") continue;
        expect(spokes == 0, fmt::format("radar {}: {} spokes encoded as {}, which nobody reads",
                                        radar, spokes, format));
      }
    }
  }

  void print(const wire::Status& status, double seconds, double cpu, double rate) {
    std::printf("%.1f s, server CPU %.2f s (%.0f %% of a core), %.1f MB/s to %zu readers\n",
                seconds, cpu, 100.0 * cpu / seconds, rate * 1e-6, readers_.size());
    for (const wire::RadarStatus& radar : status.radars()) {
      std::printf(
          "radar %u: lateness max %.1f ms, %llu of %llu spokes late, %llu sectors skipped, "
          "%.1f ns per cell\n",
          radar.radar(), radar.lateness_max_ms(),
          static_cast<unsigned long long>(radar.spokes_late()),
          static_cast<unsigned long long>(radar.spokes()),
          static_cast<unsigned long long>(radar.sectors_skipped()), radar.render_ns_per_cell());
    }
    std::printf("server memory %.1f MiB\n", status.resident_mib());
  }

  Options options_;
  TempFolder folder_;
  std::vector<std::unique_ptr<LoadSubscriber>> subscribers_;
  std::unique_ptr<ServerProcess> server_;
  std::vector<std::unique_ptr<LoadConsole>> consoles_;
  std::unique_ptr<LoadConsole> stalled_;
  std::unique_ptr<LoadConsole> control_;
  std::vector<Reader> readers_;  // all but the stalled one
  std::array<std::uint64_t, kRadars> begin_{};
  bool stalled_reads_ = true;
  bool good_ = true;
};

}  // namespace
}  // namespace skerry::system_test

int main(int argc, char** argv) {
  using namespace skerry::system_test;
  Options options;
  CLI::App cli{"Runs skerryd with 16 consoles, 4 subscribers and one that stops reading"};
  cli.add_option("--seconds", options.seconds, "How long")->check(CLI::Range(4.0, 86400.0));
  cli.add_flag("--small", options.small, "A scenario that a server with a sanitizer keeps up with");
  CLI11_PARSE(cli, argc, argv);
  try {
    return LoadCheck(options).run() ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "load_check: %s\n", error.what());
    return 1;
  }
}

// skerryd: the marine-radar video server.
#include <fmt/format.h>
#include <google/protobuf/stubs/logging.h>
#include <malloc.h>
#include <signal.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <chrono>
#include <cstdio>
#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <thread>
#include <utility>

#include "server/access/gate.hpp"
#include "server/app/exercise_files.hpp"
#include "server/app/fleet/joined_fleet.hpp"
#include "server/app/greeting.hpp"
#include "server/app/joined_host.hpp"
#include "server/app/journal_lines.hpp"
#include "server/app/load_estimate.hpp"
#include "server/app/logging_recorder.hpp"
#include "server/app/options/charts.hpp"
#include "server/app/options/options.hpp"
#include "server/app/options/state_folder.hpp"
#include "server/app/played_coast.hpp"
#include "server/app/radar_server.hpp"
#include "server/app/service_manager.hpp"
#include "server/app/signals.hpp"
#include "server/app/supervision.hpp"
#include "server/app/verification.hpp"
#include "server/app/version.hpp"
#include "server/app/web_files.hpp"
#include "server/audit/audit_log.hpp"
#include "server/core/run_identity.hpp"
#include "server/navigation/ship_sensors.hpp"
#include "server/net/common/encoders.hpp"
#include "server/net/live/live_inputs.hpp"
#include "server/net/net_server.hpp"
#include "server/playback/playback_host.hpp"
#include "server/recorder/recorder.hpp"
#include "server/relay/upstream_links.hpp"
#include "server/relay/waiting_room.hpp"
#include "server/tracking/target_service.hpp"
#include "server/world/scenario.hpp"

namespace {

using namespace skerry::server;
namespace wire = skerry::wire;

// `radars`: nullptr if a recording is played.
void await(const Signals& signals, const std::string& what, const NetServer& net,
           const RadarServer* radars) {
  const ServiceManager manager = ServiceManager::of_environment();
  Supervision supervision(manager, [&net, radars] {
    std::vector<std::uint64_t> steps = {net.looks()};
    for (const RadarPace& radar : radars ? radars->pace() : std::vector<RadarPace>()) {
      steps.push_back(radar.sectors);
    }
    return steps;
  });
  supervision.on_reload([&signals] { signals.hang_up(); });
  const int signal = supervision.await(signals.set(), what);
  spdlog::info("stopping on signal {}", signal);
}

// Begins and ends with an entry.
class Audit {
 public:
  Audit(const Options& options, const std::string& what)
      : log(options.audit, options.audit_roll_bytes) {
    const std::string from = log.head().n == 0 ? "" : "; from head " + log.head().chain;
    log.add({.what = fmt::format("{} begins: {}{}", kServerName, what, from)});
  }
  ~Audit() { log.add({.what = fmt::format("{} ends", kServerName)}); }

  AuditLog log;
};

NetConfig with_audit(NetConfig net, Audit& audit, std::string identity = new_run_identity()) {
  net.audit = &audit.log;
  net.identity = std::move(identity);
  return net;
}

// Own ship as her sensors tell of her, and as recordings have told.
TargetService::Sensed sensors_of(const RadarHost& host, const SensorErrors& errors) {
  return [&host, errors](std::uint32_t radar) { return sensed(host.own_ship(radar), errors); };
}

int run_playback(const Options& options, LogTap& tap) {
  const auto playback = open_playback(options.playback);
  const std::string what = description_of(*playback);
  if (options.check_only) {
    std::fprintf(stderr, "%s: %s\n", kServerName, what.c_str());
    return 0;
  }
  const auto coast = PlayedCoast::of(*playback, {options.charts, options.elevation});
  make_state_folder(options.state);
  Signals signals;
  Audit audit(options, what);
  signals.on_hang_up([&] { audit.log.reopen(); });
  LoggingRecorder logging(*playback, options.recorder, tap, audit.log);
  playback->set_recording(&logging.recorder);
  TargetService plotters(*playback, kNativeFormat, sensors_of(*playback, SensorErrors::none()));
  playback->set_targets(&plotters);
  NetServer net(*playback, with_audit(options.net, audit), web_files());
  signals.on_hang_up([&] { net.read_certificate(); });
  if (coast) coast->start();
  net.start();
  playback->start();
  plotters.start();
  logging.recorder.start();
  greet(options, net, "playback of " + what);
  await(signals, "playback of " + what, net, nullptr);
  playback->stop();
  plotters.stop();
  logging.recorder.stop();
  if (coast) coast->stop();
  net.stop();
  return 0;
}

// Waits for a signal that ends the server, for so long.
bool is_to_end(const Signals& signals, std::chrono::milliseconds time) {
  const timespec most{.tv_sec = time.count() / 1000, .tv_nsec = time.count() % 1000 * 1'000'000};
  const int signal = sigtimedwait(&signals.set(), nullptr, &most);
  return signal == SIGINT || signal == SIGTERM;
}

// Until what consoles ask for can be passed up, but for a few seconds at most: then without. False:
// a signal ends the server.
bool await_upstream(const UpstreamHost& host, const Signals& signals) {
  constexpr std::chrono::milliseconds kLook{20};
  for (auto waited = kLook; waited < std::chrono::seconds(10); waited += kLook) {
    if (host.hops().front().connected()) return true;
    if (is_to_end(signals, kLook)) return false;
  }
  return true;
}

int run_relay(const Options& options, LogTap& tap) {
  const UpstreamPlace& place = options.relay.place;
  Gate({options.net.control_token, options.net.tokens, options.net.users});
  Signals signals;
  const ServiceManager manager = ServiceManager::of_environment();
  const std::string identity = new_run_identity();
  std::optional<WaitingRoom> room;
  if (!options.check_only && options.net.tls.empty()) {
    wire::Hello waits;
    waits.set_protocol_version(1);
    waits.set_server(kServerName);
    waits.set_identity(identity);
    room.emplace(options.net.bind, options.net.tcp_port, std::move(waits));
  }
  const auto hello = first_hello(
      place, options.check_only ? Tries::one : Tries::until_it_is_there,
      [&](std::chrono::milliseconds time) {
        manager.starting("waits for " + place.name());
        return is_to_end(signals, time);
      },
      [&](const std::string& why) { spdlog::warn("relay: waiting for {}: {}", place.name(), why); },
      room ? &*room : nullptr);
  room.reset();
  if (!hello) return options.check_only ? 2 : 0;
  UpstreamHost host(*hello, {place.name(), kServerName, identity, kNativeFormat});
  const std::string what = fmt::format("relay of {}, {} radar{}", place.name(), host.radar_count(),
                                       host.radar_count() == 1 ? "" : "s");
  if (options.check_only) {
    std::fprintf(stderr, "%s: %s\n", kServerName, what.c_str());
    return 0;
  }
  if (!options.relay.token.empty() && !place.host.starts_with("tls://")) {
    spdlog::warn("relay: its token goes to {} in the clear; --relay tls://{} encrypts it",
                 place.name(), place.name());
  }
  make_state_folder(options.state);
  Audit audit(options, what);
  signals.on_hang_up([&] { audit.log.reopen(); });
  host.set_audit(&audit.log);
  LoggingRecorder logging(host, options.recorder, tap, audit.log);
  host.set_recording(&logging.recorder);
  TargetService plotters(
      host, kNativeFormat,
      sensors_of(host, hello->playback() ? SensorErrors::none() : options.net.sensors));
  host.set_targets(&plotters);
  UpstreamLinks links(host, place, options.relay.token, options.relay.thin);
  NetServer net(host, with_audit(options.net, audit, identity), web_files());
  signals.on_hang_up([&] { net.read_certificate(); });
  links.start();
  if (!await_upstream(host, signals)) return 0;
  net.start();
  plotters.start();
  logging.recorder.start();
  greet(options, net, what);
  await(signals, what, net, nullptr);
  links.stop();
  plotters.stop();
  logging.recorder.stop();
  net.stop();
  return 0;
}

// Does it when it goes.
class AtEnd {
 public:
  explicit AtEnd(std::function<void()> end) : end_(std::move(end)) {}
  ~AtEnd() { end_(); }
  AtEnd(const AtEnd&) = delete;
  AtEnd& operator=(const AtEnd&) = delete;

 private:
  std::function<void()> end_;
};

// Real radars beside the simulated ones.
struct Live {
  Live(RadarServer& simulated, const std::vector<LiveSource>& sources)
      : host(sources, kServerName), joined(simulated, host), inputs(host, sources) {}
  LiveHost host;
  JoinedHost joined;
  LiveInputs inputs;
};

// Runs the scenario for some seconds, with nobody to see it, and tells what that took.
void try_load(const skerry::scenario::Scenario& scenario,
              std::unique_ptr<const skerry::echo::ChartSource> chart, std::size_t workers) {
  RadarServer radars(scenario, std::move(chart), workers);
  spdlog::set_level(spdlog::level::err);  // an overload is told below
  radars.start();
  const LoadEstimate load =
      estimate_load([&] { return radars.pace(); },
                    [](std::chrono::milliseconds time) { std::this_thread::sleep_for(time); });
  radars.stop();
  std::fprintf(stderr, "%s: %s%s\n", kServerName, load.is_too_much() ? "warning: " : "",
               load.text().c_str());
}

int run(const Options& options, LogTap& tap) {
  if (!options.verify.empty()) {
    return verify({options.verify,
                   options.verify_video,
                   {options.charts, options.elevation},
                   options.workers});
  }
  if (!options.playback.file.empty()) return run_playback(options, tap);
  if (!options.relay.place.host.empty()) return run_relay(options, tap);
  // Its errors before all else takes time.
  Gate({options.net.control_token, options.net.tokens, options.net.users});
  const auto [yaml, scenario] = open_scenario(options.scenario);
  auto chart = open_charts(options.charts, options.elevation);
  if (options.check_only) {
    std::fprintf(stderr, "%s: scenario '%s' is good; its load is tried for 4 s\n", kServerName,
                 scenario.name().c_str());
    try_load(scenario, std::move(chart), options.workers);
    return 0;
  }
  make_state_folder(options.state);
  Signals signals;
  Audit audit(options, "scenario " + scenario.name());
  signals.on_hang_up([&] { audit.log.reopen(); });
  RadarServer radars(scenario, std::move(chart), options.workers,
                     exercise_documents(yaml, {options.charts, options.elevation}));
  radars.set_audit(&audit.log);
  std::unique_ptr<Live> live;
  if (!options.live.empty()) live = std::make_unique<Live>(radars, options.live);
  RadarHost& host = live ? static_cast<RadarHost&>(live->joined) : radars;
  LoggingRecorder logging(host, options.recorder, tap, audit.log);
  radars.set_recording(&logging.recorder);
  TargetService plotters(host, kNativeFormat, sensors_of(host, options.net.sensors));
  radars.set_targets(&plotters);
  if (live) {
    live->joined.set_recording(&logging.recorder);
    live->joined.set_targets(&plotters);
    live->host.set_audit(&audit.log);
  }
  NetServer net(host, with_audit(options.net, audit), web_files());
  signals.on_hang_up([&] { net.read_certificate(); });
  radars.name_shared_rings(net.tcp_port(), options.board_ring_bytes);
  const ServiceManager manager = ServiceManager::of_environment();
  const JoinedFleet fleet =
      join_fleet(options, radars, net, yaml, [&](std::chrono::milliseconds time) {
        manager.starting("joins the fleet");
        return is_to_end(signals, time);
      });
  if (fleet.ends) return 0;
  // Also where something cannot be started: what asks others ends before those.
  const AtEnd stop([&] {
    if (live) live->inputs.stop();
    if (fleet.host) fleet.host->stop();
    radars.stop();
    plotters.stop();
    logging.recorder.stop();
    net.stop();
  });
  net.start();
  radars.start(fleet.time);
  plotters.start();
  if (live) live->inputs.start();
  logging.recorder.start();
  const std::string on_air = std::to_string(host.radar_count()) + " radars on the air";
  greet(options, net, on_air);
  await(signals, on_air, net, &radars);
  return 0;
}

// What radars allocate the network frees, on other threads.  With glibc's arena for each thread and
// its threshold for mmap that grows with what is freed, a server held a sixth more than it used,
// and more for a quarter of an hour (class_check --open-sea).
void keep_memory_flat() {
  mallopt(M_ARENA_MAX, 2);
  mallopt(M_MMAP_THRESHOLD, 128 * 1024);
}

}  // namespace

int main(int argc, char** argv) {
  keep_memory_flat();
  signal(SIGPIPE, SIG_IGN);
  signal(SIGXFSZ, SIG_IGN);  // a file that may not grow takes nothing, as one on a full disk
  // Protobuf's complaints about bytes from outside are in replies and counters; they need no log.
  google::protobuf::SetLogHandler(nullptr);
  const auto tap = std::make_shared<LogTap>();
  spdlog::set_default_logger(spdlog::stderr_color_mt("skerryd"));
  spdlog::default_logger()->sinks().push_back(tap);
  const bool in_journal = stderr_is_journal();
  if (in_journal) spdlog::set_formatter(journal_formatter());
  try {
    const auto options = read_options(argc, argv);
    if (!options) return 0;
    spdlog::set_level(spdlog::level::from_str(options->log_level));
    return run(*options, *tap);
  } catch (const std::exception& error) {
    std::istringstream lines(error.what());  // a ConfigError has one for each error of a file
    for (std::string line; std::getline(lines, line);) {
      std::fprintf(stderr, "%sskerryd: %s\n", in_journal ? kJournalError : "", line.c_str());
    }
    return 2;
  }
}

#include "server/app/options/options.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <stdexcept>

#include "server/app/config.pb.h"
#include "server/app/options/exposure.hpp"
#include "server/app/options/field_options.hpp"
#include "server/app/options/inputs.hpp"
#include "server/app/options/output_text.hpp"
#include "server/app/options/outputs.hpp"
#include "server/app/options/recorder_options.hpp"
#include "server/app/options/state_folder.hpp"
#include "server/app/version.hpp"
#include "server/config/yaml_message.hpp"

namespace skerry::server {
namespace {

using app::Output;
using app::ServerConfig;
using Destinations = google::protobuf::RepeatedPtrField<app::Destination>;

constexpr const char* kExamples = R"(Examples:
  skerryd                                   the built-in scenario off Bergen, on loopback
  skerryd --scenario dover.yaml             another scenario
  skerryd --scenario dover.yaml --check     only read it, say what is wrong and what load it is
  skerryd --chart US5WA22M.000              an ENC cell over the world's shoreline
  skerryd --udp 1@127.0.0.1:7412            native datagrams of radar 1, not 0
  skerryd --cat240 239.192.43.78:4378       CAT240 to a multicast group (on this host: TTL 0)
  skerryd --sweeps 127.0.0.1:7413           sweeps of radar 0's interface board
  skerryd --output navico_4g                radar 0 as a Navico 4G, for displays on this host
  skerryd --output navico_halo:radar=1,interface_address=192.0.2.7,dual_range=true,obeys=true
  skerryd --output cat240:port=8601,spokes=720,cells=512,bits=4,compressed=true
  skerryd --output cat048:sac=25            plots and tracks of radar 0, for a traffic display
  skerryd --output nmea0183:port=10110 --input nmea0183:port=10111
  skerryd --input navico_halo:interface_address=192.0.2.7 --output garmin_xhd
                                            a real HALO in place of radar 0, for a Garmin display
  skerryd --record --record-roll-minutes 60 --record-keep-gib 100
  skerryd --play exercise.mcap --play-loop  a recording in place of radars
  skerryd --relay 192.0.2.7:7410            another server's radars, for consoles here
  skerryd --fleet 192.0.2.1:2379,192.0.2.2:2379,192.0.2.3:2379 --fleet-host bridge-1
                                            the exercise with other hosts, over their etcd
  skerryd --verify exercise.mcap            make its video again from what it was given, compare
  skerryd --config server.yaml              everything from a file; the command line wins

Every stream goes to loopback until told otherwise.  Then look at http://127.0.0.1:7480/ or run
`skerry status`, `skerry snapshot`.)";

// "native, cat240, ... or iec61162_450".
template <typename Kinds>
std::string names_of(const Kinds& kinds) {
  std::string text;
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    text += i == 0 ? "" : i + 1 < kinds.size() ? ", " : " or ";
    text += kinds[i].name;
  }
  return text;
}

// Broken at spaces into lines of at most 72 characters, as the help prints them.
std::string in_lines(std::string text) {
  constexpr std::size_t kWidth = 72;
  for (std::size_t begin = 0; text.size() - begin > kWidth;) {
    const std::size_t space = text.rfind(' ', begin + kWidth);
    text[space] = '\n';
    begin = space + 1;
  }
  return text;
}

// The command line as it was given: what a configuration file can say too, and the rest.
struct CommandLine {
  ServerConfig config;
  std::string config_file, log_level = "info", verify, verify_video;
  std::vector<std::string> udp, cat240, sweeps, outputs, inputs;
  bool no_udp = false, no_cat240 = false, no_signalk = false, exact_sensors = false,
       print_ports = false, check = false, insecure = false;
};

void add_options(CLI::App& cli, CommandLine& line) {
  ServerConfig& config = line.config;
  FieldOptions add(cli);
  cli.add_option("--config", line.config_file, "configuration file (YAML)");
  add.text("--scenario", config, &ServerConfig::mutable_scenario,
           "scenario file (YAML) or shipped exercise; the built-in Bergen without");
  cli.add_option_function<std::vector<std::string>>(
      "--chart",
      [&config](const std::vector<std::string>& charts) {
        config.mutable_charts()->Assign(charts.begin(), charts.end());
      },
      "ENC cell, folder of cells, GeoJSON, Shapefile or GSHHG file; several: each over\n"
      "those after it, all over the finest GSHHG installed");
  add.text("--elevation", config, &ServerConfig::mutable_elevation,
           "heights of the ground: GeoTIFF, DTED or SRTM, a file or a folder of them");
  add.text("--bind", config, &ServerConfig::mutable_bind, "address for TCP and HTTP (127.0.0.1)");
  add.number<std::uint16_t>("--tcp-port", config, &ServerConfig::set_tcp_port,
                            "native protocol (7410); 0: any free port");
  add.number<std::uint16_t>("--http-port", config, &ServerConfig::set_http_port,
                            "web console (7480); 0: any free port");
  cli.add_option("--udp", line.udp, "native datagrams to [RADAR@]ADDRESS:PORT (127.0.0.1:7411)");
  cli.add_option("--cat240", line.cat240, "CAT240 to [RADAR@]ADDRESS:PORT (127.0.0.1:8600)");
  cli.add_option("--sweeps", line.sweeps,
                 "records of a radar's interface board to [RADAR@]ADDRESS:PORT (none)");
  cli.add_option("--output", line.outputs,
                 in_lines("KIND:key=value,...: " + names_of(output_kinds()) +
                          ", with the keys of `outputs` in a configuration file"));
  cli.add_option("--input", line.inputs,
                 in_lines("KIND:key=value,...: nmea0183, to move own ship from outside; or a real "
                          "radar on the network, in place of the simulated one of its number: " +
                          names_of(live_kinds())));
  cli.add_flag("--exact-sensors", line.exact_sensors,
               "own ship's heading, course, speed and position without a sensor's small errors, in "
               "NMEA and Signal K");
  cli.add_flag("--no-signalk", line.no_signalk, "no Signal K on the HTTP port");
  cli.add_flag("--no-udp", line.no_udp, "no native datagrams");
  cli.add_flag("--no-cat240", line.no_cat240, "no CAT240");
  add.text("--control-token", config, &ServerConfig::mutable_control_token,
           "what a change of settings from another host must carry");
  add.text("--tokens", config, &ServerConfig::mutable_tokens,
           "file of tokens, made by `skerry token new`: then other hosts need one to see anything")
      ->type_name("FILE");
  add.text(
         "--users", config, &ServerConfig::mutable_users,
         "file of users, made by `skerry user add`: then other hosts must sign in to see anything")
      ->type_name("FILE");
  add.text("--tls", config, &ServerConfig::mutable_tls,
           "folder with certificate and key, made by `skerry tls init`: then other hosts come by "
           "TLS alone")
      ->type_name("FOLDER");
  cli.add_flag("--insecure", line.insecure,
               "let other hosts in without TLS or without users; every page says so");
  add.text("--setups", config, &ServerConfig::mutable_setups,
           "folder in which consoles keep set-ups by name, for all of them; made if missing")
      ->type_name("FOLDER");
  add.text("--audit", config, &ServerConfig::mutable_audit,
           "file that keeps who changed what, who signed in and what was refused; made if missing")
      ->type_name("FILE");
  add.number<std::uint32_t>("--audit-roll-mib", config, &ServerConfig::set_audit_roll_mib,
                            "another file of the audit after so many MiB (never)")
      ->check(CLI::Range(1, 1 << 24));
  add.text("--state", config, &ServerConfig::mutable_state,
           "folder for audit, recordings, set-ups, tokens and users, where nothing else is said; "
           "made if missing")
      ->type_name("FOLDER");
  add.text("--web-root", config, &ServerConfig::mutable_web_root,
           "serve the console from this folder, for those who work on it");
  add.number<std::uint32_t>("--workers", config, &ServerConfig::set_workers,
                            "helping threads per radar (0)")
      ->check(CLI::Range(0, 64));
  cli.add_option("--log-level", line.log_level, "trace, debug, info, warn or error")
      ->check(CLI::IsMember({"trace", "debug", "info", "warn", "error"}));
  cli.add_flag("--print-ports", line.print_ports, "print 'tcp PORT http PORT' once listening");
  cli.add_flag(
      "--check", line.check,
      "read configuration, scenario and charts, try its load for some seconds, serve nothing");
  add_playback_options(cli, *config.mutable_playback());
  add_relay_options(cli, *config.mutable_relay());
  add_fleet_options(cli, *config.mutable_fleet());
  add_recorder_options(cli, *config.mutable_recorder());
  cli.add_option("--verify", line.verify,
                 "make the video of a recorded exercise again from its inputs, compare, and end")
      ->type_name("FILE");
  cli.add_option("--video", line.verify_video, "with --verify: write that video to a recording")
      ->type_name("FILE");
}

// Reads the texts of outputs and inputs, and refuses what contradicts itself.
void complete(CommandLine& line) {
  ServerConfig& config = line.config;
  for (const std::string& text : line.udp) *config.add_udp() = parse_destination(text);
  for (const std::string& text : line.cat240) *config.add_cat240() = parse_destination(text);
  for (const std::string& text : line.sweeps) *config.add_sweeps() = parse_destination(text);
  for (const std::string& text : line.outputs) *config.add_outputs() = parse_output(text);
  for (const std::string& text : line.inputs) *config.add_inputs() = parse_input(text);
  if (line.exact_sensors) config.set_exact_sensors(true);
  if (line.no_signalk) config.mutable_signalk()->set_serve(false);
  if (line.verify.empty() && !line.verify_video.empty()) {
    throw std::runtime_error("--video: of which recording? give it with --verify FILE");
  }
  const app::Playback& playback = config.playback();
  if (playback.has_file() && playback.file().empty()) {
    throw std::runtime_error("--play: its file has no name");
  }
  if (config.relay().ByteSizeLong() == 0) config.clear_relay();
  if (config.fleet().ByteSizeLong() == 0) config.clear_fleet();
  if (!line.verify.empty() && config.has_relay()) {
    throw std::runtime_error("--verify and --relay exclude each other");
  }
  if (config.has_scenario() && playback.has_file()) {
    throw std::runtime_error("--scenario and --play exclude each other: radars or a recording");
  }
}

// The command line over the configuration file: a value over a value, a list in place of a list.
void put_over(const CommandLine& line, ServerConfig& file) {
  const app::Playback& playback = line.config.playback();
  // Options given for another file do not hold for this one.
  const bool is_relay = line.config.relay().has_server();
  if (playback.has_file() || line.config.has_scenario() || is_relay) file.clear_playback();
  if (playback.has_file() || line.config.has_scenario() || is_relay) file.clear_relay();
  if (is_relay) file.clear_scenario();
  if (is_relay || playback.has_file()) file.clear_fleet();
  if (!line.config.fleet().store().empty()) file.mutable_fleet()->clear_store();
  if (line.no_udp) file.clear_udp();
  if (line.no_cat240) file.clear_cat240();
  std::vector<const google::protobuf::FieldDescriptor*> given;
  line.config.GetReflection()->ListFields(line.config, &given);
  for (const auto* field : given) {
    if (field->is_repeated()) file.GetReflection()->ClearField(&file, field);
  }
  file.MergeFrom(line.config);
  if (file.has_relay() && !file.relay().has_server()) {
    throw std::runtime_error("--relay-token-file: of which server? give it with --relay HOST:PORT");
  }
  if (file.playback().file().empty() && playback.ByteSizeLong() > 0) {
    throw std::runtime_error(
        "--play-rate, --play-loop, --play-from, --play-paused, --current-timestamps: of which "
        "recording? give it with --play FILE");
  }
}

// The short forms `udp`, `cat240` and `sweeps` are outputs of these kinds.  Without an output of a
// kind there is the `usual` one, if any: radar 0 to the kind's own address and port.
void add_short_forms(const Destinations& destinations, Output::Kind kind, bool usual,
                     ServerConfig& config) {
  const auto& outputs = config.outputs();
  const bool any = std::any_of(outputs.begin(), outputs.end(),
                               [&](const Output& output) { return output.kind() == kind; });
  if (destinations.empty() && usual && !any) config.add_outputs()->set_kind(kind);
  for (const app::Destination& destination : destinations) {
    Output& output = *config.add_outputs();
    output.set_kind(kind);
    output.set_radar(destination.radar());
    output.set_address(destination.address());
    output.set_port(destination.port());
    output.set_max_datagram(destination.max_datagram());
    output.set_ttl(destination.multicast_ttl());
    output.set_interface_address(destination.interface_address());
  }
}

void apply_signalk(const app::Signalk& file, SignalkConfig& signalk) {
  if (file.has_serve()) signalk.serve = file.serve();
  signalk.dialect = static_cast<signalk::Dialect>(file.dialect());
  if (file.has_advertise()) signalk.advertise = file.advertise();
  for (const app::Signalk::Ship& ship : file.further_ships()) {
    signalk.further_ships.push_back({ship.radar(), static_cast<std::uint16_t>(ship.port())});
  }
}

Options options_of(const ServerConfig& config) {
  Options options;
  NetConfig& net = options.net;
  options.scenario = config.scenario();
  options.charts.assign(config.charts().begin(), config.charts().end());
  options.elevation = config.elevation();
  if (config.has_bind()) net.bind = config.bind();
  if (config.has_tcp_port()) net.tcp_port = static_cast<std::uint16_t>(config.tcp_port());
  if (config.has_http_port()) net.http_port = static_cast<std::uint16_t>(config.http_port());
  if (config.has_board_ring_mib()) {
    options.board_ring_bytes = std::size_t{config.board_ring_mib()} << 20;
  }
  net.control_token = config.control_token();
  net.tokens = config.tokens();
  net.users = config.users();
  net.tls = config.tls();
  net.setups = config.setups();
  options.audit = config.audit();
  options.audit_roll_bytes = std::uint64_t{config.audit_roll_mib()} << 20;
  options.state = config.state();
  net.allowed_hosts.assign(config.allowed_hosts().begin(), config.allowed_hosts().end());
  net.web_root = config.web_root();
  if (config.has_max_connections()) net.max_connections = config.max_connections();
  options.workers = config.workers();
  apply_signalk(config.signalk(), net.signalk);
  add_outputs(config, net);
  add_inputs(config, net);
  options.live = live_sources(config);
  net.sensors = config.exact_sensors() ? SensorErrors::none() : SensorErrors{};
  options.playback = playback_options(config.playback());
  options.relay = relay_options(config, net);
  options.fleet = fleet_options(config, net);
  options.recorder = recorder_config(config.recorder());
  return options;
}

}  // namespace

std::optional<Options> read_options(int argc, const char* const* argv) {
  CLI::App cli{"Skerry: a networked marine-radar video server"};
  cli.footer(kExamples);
  cli.set_version_flag("--version", std::string(kServerName));
  CommandLine line;
  add_options(cli, line);
  try {
    cli.parse(argc, argv);
  } catch (const CLI::Success& done) {
    cli.exit(done);
    return std::nullopt;
  } catch (const CLI::ParseError& error) {
    throw std::runtime_error(std::string(error.what()) + "; see skerryd --help");
  }
  ServerConfig config;
  if (!line.config_file.empty()) {
    YamlSource source(line.config_file);
    read_yaml(read_yaml_file(line.config_file), source, config);
    check_outputs(config, source);
    source.require_sound();
  }
  complete(line);
  put_over(line, config);
  place_in_state_folder(config);
  add_short_forms(config.udp(), Output::native, !line.no_udp, config);
  add_short_forms(config.cat240(), Output::cat240, !line.no_cat240, config);
  add_short_forms(config.sweeps(), Output::sweeps, false, config);
  Options options = options_of(config);
  options.log_level = line.log_level;
  options.print_ports = line.print_ports;
  options.check_only = line.check;
  options.verify = line.verify;
  options.verify_video = line.verify_video;
  require_guarded(options.net, line.insecure || config.insecure());
  options.net.exposure = exposure_of(options.net);
  return options;
}

}  // namespace skerry::server

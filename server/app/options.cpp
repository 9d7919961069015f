#include "server/app/options.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cstdio>
#include <stdexcept>

#include "server/app/config.pb.h"
#include "server/app/output_text.hpp"
#include "server/app/outputs.hpp"
#include "server/app/recorder_options.hpp"
#include "server/app/version.hpp"
#include "server/config/yaml_message.hpp"

namespace skerry::server {
namespace {

constexpr const char* kExamples = R"(Examples:
  skerryd                                   the built-in scenario off Bergen, on loopback
  skerryd --scenario dover.yaml             another scenario
  skerryd --scenario dover.yaml --check     only read it and say what is wrong
  skerryd --chart US5WA22M.000              an ENC cell over the world's shoreline
  skerryd --udp 1@127.0.0.1:7412            native datagrams of radar 1, not 0
  skerryd --cat240 239.192.43.78:4378       CAT240 to a multicast group (on this host: TTL 0)
  skerryd --sweeps 127.0.0.1:7413           sweeps of radar 0's interface board
  skerryd --output navico_4g                radar 0 as a Navico 4G, for displays on this host
  skerryd --output navico_halo:radar=1,interface_address=192.0.2.7,dual_range=true
  skerryd --output cat240:port=8601,spokes=720,cells=512,bits=4,compressed=true
  skerryd --output nmea0183:port=10110 --input nmea0183:port=10111
  skerryd --record --record-roll-minutes 60 --record-keep-gib 100
  skerryd --play exercise.mcap --play-loop  a recording in place of radars
  skerryd --verify exercise.mcap            make its video again from what it was given, compare
  skerryd --config server.yaml              everything from a file; the command line wins

Every stream goes to loopback until told otherwise.  Then look at http://127.0.0.1:7480/ or run
`skerry status`, `skerry snapshot`.)";

// "native, cat240, ... or iec61162_450".
std::string kinds_of_outputs() {
  const std::vector<OutputKind>& kinds = output_kinds();
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

UdpDestination destination_of(const app::Destination& d) {
  UdpDestination out;
  out.radar = d.radar();
  out.address = d.address();
  out.port = static_cast<std::uint16_t>(d.port());
  out.max_datagram = d.max_datagram();
  out.multicast_ttl = static_cast<int>(d.multicast_ttl());
  out.interface_address = d.interface_address();
  return out;
}

void apply_signalk(const app::Signalk& file, SignalkConfig& signalk) {
  if (file.has_serve()) signalk.serve = file.serve();
  signalk.dialect = static_cast<signalk::Dialect>(file.dialect());
  if (file.has_advertise()) signalk.advertise = file.advertise();
  for (const app::Signalk::Ship& ship : file.further_ships()) {
    signalk.further_ships.push_back({ship.radar(), static_cast<std::uint16_t>(ship.port())});
  }
}

void apply_file(const app::ServerConfig& file, Options& options) {
  NetConfig& net = options.net;
  if (file.has_scenario()) options.scenario = file.scenario();
  for (const std::string& chart : file.charts()) options.charts.push_back(chart);
  if (file.has_elevation()) options.elevation = file.elevation();
  if (file.has_bind()) net.bind = file.bind();
  if (file.has_tcp_port()) net.tcp_port = static_cast<std::uint16_t>(file.tcp_port());
  if (file.has_http_port()) net.http_port = static_cast<std::uint16_t>(file.http_port());
  if (file.udp_size() > 0) net.udp.clear();
  for (const app::Destination& d : file.udp()) net.udp.push_back(destination_of(d));
  if (file.cat240_size() > 0) net.cat240.clear();
  for (const app::Destination& d : file.cat240()) net.cat240.push_back(destination_of(d));
  for (const app::Destination& d : file.sweeps()) net.sweeps.push_back(destination_of(d));
  if (file.has_board_ring_mib()) {
    options.board_ring_bytes = std::size_t{file.board_ring_mib()} << 20;
  }
  if (file.has_control_token()) net.control_token = file.control_token();
  for (const std::string& host : file.allowed_hosts()) net.allowed_hosts.push_back(host);
  if (file.has_web_root()) net.web_root = file.web_root();
  if (file.has_max_connections()) net.max_connections = file.max_connections();
  if (file.has_workers()) options.workers = file.workers();
  if (file.has_signalk()) apply_signalk(file.signalk(), net.signalk);
  if (file.has_playback()) apply_playback(file.playback(), options.playback);
}

// Streams that are asked for stand in place of the usual one of their kind.
void apply_outputs(const app::ServerConfig& file, bool keep_udp, bool keep_cat240, NetConfig& net) {
  const auto any = [&](app::Output::Kind kind) {
    return std::any_of(file.outputs().begin(), file.outputs().end(),
                       [&](const app::Output& output) { return output.kind() == kind; });
  };
  if (!keep_udp && any(app::Output::native)) net.udp.clear();
  if (!keep_cat240 && any(app::Output::cat240)) net.cat240.clear();
  add_outputs(file, net);
  add_inputs(file, net);
}

}  // namespace

UdpDestination parse_destination(const std::string& text) {
  const auto fail = [&](const std::string& why) -> std::runtime_error {
    return std::runtime_error("destination '" + text + "': " + why +
                              "; expected [RADAR@]ADDRESS:PORT, e.g. 127.0.0.1:7411, "
                              "1@239.192.7.1:7411 or [::1]:7411");
  };
  UdpDestination out;
  std::string rest = text;
  const auto number = [&](const std::string& digits, unsigned long most, const char* what) {
    unsigned long value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc{} || end != digits.data() + digits.size() || value > most) {
      throw fail(std::string(what) + " '" + digits + "' is not a number up to " +
                 std::to_string(most));
    }
    return value;
  };
  if (const auto at = rest.find('@'); at != std::string::npos) {
    out.radar = static_cast<std::uint32_t>(number(rest.substr(0, at), 4095, "radar"));
    rest = rest.substr(at + 1);
  }
  const auto colon = rest.rfind(':');
  if (colon == std::string::npos) throw fail("no port");
  out.port = static_cast<std::uint16_t>(number(rest.substr(colon + 1), 65535, "port"));
  if (out.port == 0) throw fail("port 0 cannot be sent to");
  out.address = rest.substr(0, colon);
  if (out.address.size() > 2 && out.address.front() == '[' && out.address.back() == ']') {
    out.address = out.address.substr(1, out.address.size() - 2);
  }
  if (out.address.empty()) throw fail("no address");
  return out;
}

std::optional<Options> read_options(int argc, const char* const* argv) {
  CLI::App cli{"Skerry: a networked marine-radar video server"};
  cli.footer(kExamples);
  cli.set_version_flag("--version", std::string(kServerName));
  std::string config, bind, web_root, token, scenario, elevation, log_level = "info";
  std::vector<std::string> udp, cat240, sweeps, charts, outputs, inputs;
  std::uint16_t tcp_port = 0, http_port = 0;
  std::size_t workers = 0;
  app::Playback playback;
  RecorderOptions recorder;
  std::string verify, verify_video;
  bool no_udp = false, no_cat240 = false, no_signalk = false, print_ports = false, check = false;
  cli.add_option("--config", config, "configuration file (YAML)");
  cli.add_option("--scenario", scenario, "scenario file (YAML); the built-in Bergen without");
  cli.add_option("--chart", charts,
                 "ENC cell, folder of cells, GeoJSON, Shapefile or GSHHG file; several: each over\n"
                 "those after it, all over the finest GSHHG installed");
  cli.add_option("--elevation", elevation,
                 "heights of the ground: GeoTIFF, DTED or SRTM, a file or a folder of them");
  cli.add_option("--bind", bind, "address for TCP and HTTP (127.0.0.1)");
  auto* tcp = cli.add_option("--tcp-port", tcp_port, "native protocol (7410); 0: any free port");
  auto* http = cli.add_option("--http-port", http_port, "web console (7480); 0: any free port");
  cli.add_option("--udp", udp, "native datagrams to [RADAR@]ADDRESS:PORT (127.0.0.1:7411)");
  cli.add_option("--cat240", cat240, "CAT240 to [RADAR@]ADDRESS:PORT (127.0.0.1:8600)");
  cli.add_option("--sweeps", sweeps,
                 "records of a radar's interface board to [RADAR@]ADDRESS:PORT (none)");
  cli.add_option("--output", outputs,
                 in_lines("KIND:key=value,...: " + kinds_of_outputs() +
                          ", with the keys of `outputs` in a configuration file"));
  cli.add_option("--input", inputs, "KIND:key=value,...: nmea0183, to move own ship from outside");
  cli.add_flag("--no-signalk", no_signalk, "no Signal K on the HTTP port");
  cli.add_flag("--no-udp", no_udp, "no native datagrams");
  cli.add_flag("--no-cat240", no_cat240, "no CAT240");
  cli.add_option("--control-token", token,
                 "what a change of settings from another host must carry");
  cli.add_option("--web-root", web_root,
                 "serve the console from this folder, for those who work on it");
  auto* help = cli.add_option("--workers", workers, "helping threads per radar (0)")
                   ->check(CLI::Range(0, 64));
  cli.add_option("--log-level", log_level, "trace, debug, info, warn or error")
      ->check(CLI::IsMember({"trace", "debug", "info", "warn", "error"}));
  cli.add_flag("--print-ports", print_ports, "print 'tcp PORT http PORT' once listening");
  cli.add_flag("--check", check, "read configuration, scenario and charts, start nothing");
  add_playback_options(cli, playback);
  add_recorder_options(cli, recorder);
  cli.add_option("--verify", verify,
                 "make the video of a recorded exercise again from its inputs, compare, and end")
      ->type_name("FILE");
  cli.add_option("--video", verify_video, "with --verify: write that video to a recording")
      ->type_name("FILE");
  try {
    cli.parse(argc, argv);
  } catch (const CLI::Success& done) {
    cli.exit(done);
    return std::nullopt;
  } catch (const CLI::ParseError& error) {
    throw std::runtime_error(std::string(error.what()) + "; see skerryd --help");
  }

  Options options;
  options.net.udp = {{.radar = 0, .address = "127.0.0.1", .port = 7411}};
  app::ServerConfig file;
  if (!config.empty()) {
    load_yaml_file(config, file);
    apply_file(file, options);
  }
  options.recorder = recorder_config(file.recorder(), recorder);
  options.verify = verify;
  options.verify_video = verify_video;
  if (verify.empty() && !verify_video.empty()) {
    throw std::runtime_error("--video: of which recording? give it with --verify FILE");
  }
  if (playback.has_file() && playback.file().empty()) {
    throw std::runtime_error("--play: its file has no name");
  }
  if (!scenario.empty() && playback.has_file()) {
    throw std::runtime_error("--scenario and --play exclude each other: radars or a recording");
  }
  if (!scenario.empty()) {
    options.scenario = scenario;
    options.playback.file.clear();  // of the configuration file
  }
  apply_playback(playback, options.playback);
  if (options.playback.file.empty() && playback.ByteSizeLong() > 0) {
    throw std::runtime_error(
        "--play-rate, --play-loop, --play-from, --play-paused, --current-timestamps: of which "
        "recording? give it with --play FILE");
  }
  if (!charts.empty()) options.charts = charts;
  if (!elevation.empty()) options.elevation = elevation;
  if (!bind.empty()) options.net.bind = bind;
  if (tcp->count() > 0) options.net.tcp_port = tcp_port;
  if (http->count() > 0) options.net.http_port = http_port;
  if (no_udp || !udp.empty()) options.net.udp.clear();
  if (no_cat240 || !cat240.empty()) options.net.cat240.clear();
  for (const std::string& text : udp) options.net.udp.push_back(parse_destination(text));
  for (const std::string& text : cat240) options.net.cat240.push_back(parse_destination(text));
  if (!sweeps.empty()) options.net.sweeps.clear();
  for (const std::string& text : sweeps) options.net.sweeps.push_back(parse_destination(text));
  if (!outputs.empty()) file.clear_outputs();
  for (const std::string& text : outputs) *file.add_outputs() = parse_output(text);
  if (!inputs.empty()) file.clear_inputs();
  for (const std::string& text : inputs) *file.add_inputs() = parse_input(text);
  apply_outputs(file, file.udp_size() > 0 || !udp.empty(),
                file.cat240_size() > 0 || !cat240.empty(), options.net);
  if (no_signalk) options.net.signalk.serve = false;
  if (!token.empty()) options.net.control_token = token;
  if (!web_root.empty()) options.net.web_root = web_root;
  if (help->count() > 0) options.workers = workers;
  options.log_level = log_level;
  options.print_ports = print_ports;
  options.check_only = check;
  return options;
}

}  // namespace skerry::server

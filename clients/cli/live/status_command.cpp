// skerry status: what a server is doing, as tables or JSON.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <set>

#include "clients/cli/command.hpp"
#include "clients/cli/console.hpp"
#include "clients/cli/message_json.hpp"
#include "clients/cli/recording/record_words.hpp"
#include "protocol/picture/label_text.hpp"
#include "protocol/wire/printable_text.hpp"
#include "protocol/wire/schema.hpp"

namespace skerry::client {
namespace {

std::string hours_minutes_seconds(double seconds) {
  const auto whole = static_cast<std::int64_t>(seconds);
  return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

std::string with_degree_signs(std::string text) {
  for (std::size_t at; (at = text.find('^')) != std::string::npos;) text.replace(at, 1, "\u00b0");
  return text;
}

std::string speed_and_turn(const wire::OwnShip& ship) {
  // A recording that knows no motion has neither log nor rate of turn.
  const bool no_motion = ship.no_motion() && ship.speed_kn() == 0.0;
  const bool no_speed = no_motion || ship.no_log(), no_turn = no_motion || ship.no_heading();
  return fmt::format("{:>9} {:>10}", no_speed ? "-" : fmt::format("{:.1f} kn", ship.speed_kn()),
                     no_turn ? "-" : fmt::format("{:.1f}^", ship.rate_of_turn_deg_min()));
}

std::string own_ships(const wire::Status& status) {
  std::string out = fmt::format("{:<20} {:<27} {:>7} {:>9} {:>10}  {}\n", "OWN SHIP", "POSITION",
                                "HEADING", "SPEED", "TURN/MIN", "ORDERED");
  std::set<std::string> seen;
  for (const auto& radar : status.radars()) {
    const wire::OwnShip& ship = radar.own_ship();
    if (!seen.insert(ship.name()).second) continue;
    out += with_degree_signs(fmt::format(
        "{:<20} {:<27} {:>7} {} {}\n", printable(ship.name(), 20),
        ship.no_position() ? "not known"
                           : position_text({ship.latitude_deg(), ship.longitude_deg()}),
        ship.no_heading() ? "-" : bearing_text(ship.heading_deg()), speed_and_turn(ship),
        ship.driven() ? " driven from outside"
                      : fmt::format(" {} {:.1f} kn", bearing_text(ship.ordered_course_deg()),
                                    ship.ordered_speed_kn())));
  }
  return out;
}

std::string radars(const wire::Status& status) {
  std::string out = fmt::format("{:<5} {:<16} {:>9} {:>8} {:>11} {:>6} {:>8} {:>9} {:>8} {:>7}\n",
                                "RADAR", "NAME", "RANGE", "SCAN", "SPOKES", "LATE", "SKIPPED",
                                "WORST", "NS/CELL", "EDGES");
  for (const auto& radar : status.radars()) {
    out +=
        fmt::format("{:<5} {:<16} {:>6g} NM {:>8} {:>11} {:>6} {:>8} {:>6.1f} ms {:>8.1f} {:>7}\n",
                    radar.radar(), printable(radar.name(), 16), radar.settings().range_nm(),
                    radar.scan(), radar.spokes(), radar.spokes_late(), radar.sectors_skipped(),
                    radar.lateness_max_ms(), radar.render_ns_per_cell(), radar.coast_edges());
  }
  return out;
}

// Faults by name stand in `skerry board registers`; here, whether there are any and why.
std::string boards(const wire::Status& status) {
  std::string out;
  for (const auto& radar : status.radars()) {
    if (!radar.has_board()) continue;
    const wire::BoardState& board = radar.board();
    out += fmt::format(
        "{:<5} {:<16} {:>12} {:>11} {:>8} {:>9.1f}  {:<24} {}\n", radar.radar(),
        printable(radar.name(), 16), board.triggers(), board.sweeps(), board.sweeps_late(),
        board.sweep_us(), board.ring_name().empty() ? "-" : printable(board.ring_name(), 24),
        board.faults() == 0
            ? "none"
            : fmt::format("0x{:02X} {}", board.faults(), printable(board.fault_reason(), 128)));
  }
  if (out.empty()) return "no boards\n";
  return fmt::format("{:<5} {:<16} {:>12} {:>11} {:>8} {:>9}  {:<24} {}\n", "BOARD", "NAME",
                     "TRIGGERS", "SWEEPS", "LATE", "US/SWEEP", "SHARED MEMORY", "FAULTS") +
         out;
}

std::string controls_line(const std::string& name, const wire::Settings& settings) {
  const auto* const pulse = wire::PulseChoice_descriptor()->FindValueByNumber(settings.pulse());
  return fmt::format(
      "{:<5} {:<4} {:<16} {:<8} {:<7} {:>5.3g} us {:>6.0f} Hz {:>5} {:>6g} NM {:>4.0f} {:>4.0f}{} "
      "{:>4.0f} {:>4.0f} {:>7.0f}{} {:>11.0f} {}\n",
      settings.radar(), settings.view(), printable(name, 16),
      settings.standby() ? "STANDBY" : "transmit", pulse != nullptr ? wire::word_of(*pulse) : "?",
      settings.pulse_length_us(), settings.prf_hz(),
      settings.tune_auto() ? "auto" : fmt::format("{:.0f}", settings.tune()), settings.range_nm(),
      settings.gain(), settings.sea(), settings.sea_auto() ? "A" : " ", settings.rain(),
      settings.interference_rejection(), settings.echo_stretch(),
      settings.stretch_bearing() ? "B" : " ", settings.integration(),
      settings.decimation() == wire::MEAN ? "mean" : "peak");
}

std::string controls(const wire::Status& status) {
  std::string out = fmt::format(
      "{:<5} {:<4} {:<16} {:<8} {:<7} {:>8} {:>9} {:>5} {:>9} {:>4} {:>4}  {:>4} {:>4} "
      "{:>7}  {:>11} {}\n",
      "RADAR", "VIEW", "NAME", "STATE", "PULSE", "LENGTH", "PRF", "TUNE", "RANGE", "GAIN", "SEA",
      "RAIN", "IR", "STRETCH", "INTEGRATION", "CELLS");
  for (const auto& radar : status.radars()) {
    out += controls_line(radar.name(), radar.settings());
    for (const auto& view : radar.views()) out += controls_line(radar.name(), view);
  }
  return out;
}

// Which controls controls_line() shows; those that are not here are told only where they differ
// from what they are without anybody's doing.
constexpr std::array kInTable = {"transmit",     "range_nm",
                                 "pulse",        "tune",
                                 "tune_auto",    "gain",
                                 "sea",          "sea_auto",
                                 "rain",         "interference_rejection",
                                 "echo_stretch", "stretch_bearing",
                                 "integration",  "decimation"};

// "noise rejection 30", "gain auto", "mode offshore", "bearing alignment -2.5 deg".
std::string special_control(const wire::FieldDescriptor& field, double value) {
  const std::string unit = wire::rule_of(field).unit();
  if (field.cpp_type() == wire::FieldDescriptor::CPPTYPE_BOOL) {
    return fmt::format("{}{}", wire::spoken_name(field), value != 0.0 ? "" : " off");
  }
  if (field.cpp_type() == wire::FieldDescriptor::CPPTYPE_ENUM) {
    const auto* const named = field.enum_type()->FindValueByNumber(static_cast<int>(value));
    return fmt::format("{} {}", wire::spoken_name(field),
                       named != nullptr ? wire::word_of(*named) : "?");
  }
  return fmt::format("{} {:g}{}{}", wire::spoken_name(field), value, unit.empty() ? "" : " ", unit);
}

std::string special_controls(const wire::Settings& settings) {
  std::string text;
  const auto add = [&](const std::string& part) { text += (text.empty() ? "" : ", ") + part; };
  for (const wire::FieldDescriptor* field : wire::fields_of(*wire::Controls::descriptor())) {
    const auto& rule = wire::rule_of(*field);
    if (std::find(kInTable.begin(), kInTable.end(), field->name()) != kInTable.end() ||
        !rule.has_default_()) {
      continue;
    }
    const auto value = wire::value_of(settings, *field);
    if (value && *value != rule.default_()) add(special_control(*field, *value));
  }
  for (const auto& sector : settings.blanked_sectors().sectors()) {
    add(fmt::format("blanked {:g}-{:g}^", sector.from_deg(), sector.to_deg()));
  }
  std::string locked;
  for (const std::string& control : settings.locked()) locked += " " + printable(control, 40);
  if (!locked.empty()) add("locked:" + locked);
  return text;
}

std::string special_controls(const wire::Status& status) {
  std::string out;
  const auto add = [&](const wire::Settings& settings) {
    const std::string text = special_controls(settings);
    if (!text.empty()) {
      out += with_degree_signs(
          fmt::format("{:<5} {:<4} {}\n", settings.radar(), settings.view(), text));
    }
  };
  for (const auto& radar : status.radars()) {
    add(radar.settings());
    for (const auto& view : radar.views()) add(view);
  }
  return out;
}

std::string switched_off(const wire::World& world) {
  std::string names;
  for (const wire::FieldDescriptor* field : wire::fields_of(*wire::Artefacts::descriptor())) {
    if (wire::value_of(world, *field).value_or(1.0) != 0.0) continue;
    names += fmt::format("{}{}", names.empty() ? "" : ", ", field->name());
  }
  return names.empty() ? "none" : names;
}

std::string world(const wire::Status& status) {
  const wire::World& world = status.world();
  std::string out = with_degree_signs(fmt::format(
      "WORLD  sea state {:g}, wind from {}, swell {:g} m, {:g} s from {}, waves ashore {:g} m\n"
      "       visibility {}, k factor {:.3g}, ducting {:g}, artefacts switched off: {}\n",
      world.sea_state(), bearing_text(world.wind_from_deg()), world.swell_height_m(),
      world.swell_period_s(), bearing_text(world.swell_from_deg()), world.wave_height_m(),
      world.has_visibility_nm() ? fmt::format("{:.3g} NM", world.visibility_nm()) : "clear",
      world.k_factor(), world.ducting(), switched_off(world)));
  for (const auto& rain : world.rain()) {
    out += with_degree_signs(fmt::format(
        "RAIN {:<3} {:<27} {}, radius {:g} NM, {:g} mm/h, drifting to {} at {:.1f} kn\n", rain.id(),
        position_text({rain.latitude_deg(), rain.longitude_deg()}),
        wire::word_of(*wire::RainKind_descriptor(), rain.kind()), rain.radius_nm(),
        rain.rate_mm_h(), bearing_text(rain.drift_deg()), rain.drift_kn()));
  }
  return out;
}

std::string clients(const wire::Status& status) {
  if (status.clients().empty()) return "no clients\n";
  std::string out = fmt::format("{:<9} {:<28} {:>5} {:>4} {:>12} {:>10} {:>10}\n", "CLIENT", "PEER",
                                "RADAR", "VIEW", "SENT", "LOST", "MIB");
  for (const auto& client : status.clients()) {
    out += fmt::format("{:<9} {:<28} {:>5} {:>4} {:>12} {:>10} {:>10.1f}\n",
                       printable(client.transport(), 9), printable(client.peer(), 48),
                       client.radar(), client.view(), client.spokes_sent(), client.spokes_lost(),
                       static_cast<double>(client.bytes_sent()) / (1 << 20));
  }
  return out;
}

std::string outputs(const wire::Status& status) {
  if (status.outputs().empty()) return "";
  std::string out =
      fmt::format("\n{:<18} {:<15} {:>5} {:>4} {:>10} {:>9} {:>8} {:>6} {:>8} {:>8} {}\n", "OUTPUT",
                  "AT", "RADAR", "VIEW", "DATAGRAMS", "REPORTS", "MIB", "LOST", "COMMANDS",
                  "REFUSED", "LAST DISPLAY");
  for (const auto& output : status.outputs()) {
    const std::string& at =
        output.interface_address().empty() ? output.address() : output.interface_address();
    out += fmt::format("{:<18} {:<15} {:>5} {:>4} {:>10} {:>9} {:>8.1f} {:>6} {:>8} {:>8} {}\n",
                       printable(output.name(), 18), printable(at, 15), output.radar(),
                       output.view(), output.datagrams(), output.reports(),
                       static_cast<double>(output.bytes()) / (1 << 20),
                       output.spokes_lost() + output.datagrams_unsent(), output.commands(),
                       output.commands_refused() + output.commands_dropped(),
                       output.last_display().empty() ? "-" : printable(output.last_display(), 21));
  }
  return out;
}

// How a relay is connected to the servers before it.
std::string hops(const wire::Status& status) {
  if (status.hops().empty()) return "";
  std::string out =
      fmt::format("\n{:<22} {:<18} {:<20} {:>12} {:>8} {:>10} {:>8} {:>7} {:>12}\n", "RELAY OF",
                  "SERVER", "STATE", "SPOKES", "LOST", "ROUND TRIP", "MIB/S", "BACK", "ASKED");
  for (const wire::HopStatus& hop : status.hops()) {
    const std::string state = fmt::format("{} {}", hop.connected() ? "connected" : "GONE",
                                          hours_minutes_seconds(hop.since_s()));
    out +=
        fmt::format("{:<22} {:<18} {:<20} {:>12} {:>8} {:>10} {:>8.2f} {:>7} {:>12}\n",
                    hop.upstream().empty() ? "-" : printable(hop.upstream(), 40),
                    hop.server().empty() ? "-" : printable(hop.server(), 18), state, hop.spokes(),
                    hop.spokes_lost(),
                    hop.has_round_trip_ms() ? fmt::format("{:.1f} ms", hop.round_trip_ms()) : "-",
                    hop.bytes_per_second() / (1 << 20), hop.reconnects(),
                    hop.requests_refused() == 0
                        ? fmt::format("{}", hop.requests())
                        : fmt::format("{} ({} no)", hop.requests(), hop.requests_refused()));
    if (hop.thin() > 0) out += fmt::format("{:>4}thin spokes of level {}\n", "", hop.thin());
    if (!hop.problem().empty()) out += fmt::format("{:>4}{}\n", "", printable(hop.problem(), 300));
  }
  return out;
}

std::string recorder(const wire::Status& status) {
  const wire::RecorderState& state = status.recorder();
  if (state.phase() == wire::RecorderState::OFF) return "";
  std::string out = "\nRECORDER  " + recorder_line(state) + "\n";
  if (!state.problem().empty()) out += fmt::format("{:>10}{}\n", "", printable(state.problem()));
  return out;
}

std::string errors(const wire::Status& status) {
  if (status.errors().empty()) return "no errors\n";
  std::string out = fmt::format("{:>10}  {}\n", "ERRORS", "KIND");
  for (const auto& [kind, count] : status.errors()) {
    out += fmt::format("{:>10}  {}\n", count, printable(kind));
  }
  return out;
}

std::string status_table(const wire::Status& status, const std::string& place) {
  return fmt::format(
      "{} at {}, scenario {}\nscenario time {}, up {}, {:.1f} MiB in memory\n{}\n"
      "{}\n{}\n{}\n{}\n{}\n{}\n{}",
      printable(status.server()), place, printable(status.scenario()),
      hours_minutes_seconds(status.scenario_s()), hours_minutes_seconds(status.uptime_s()),
      status.resident_mib(), status.warning().empty() ? "" : printable(status.warning()) + "\n",
      own_ships(status), radars(status), controls(status) + special_controls(status),
      boards(status), world(status),
      clients(status) + outputs(status) + hops(status) + recorder(status), errors(status));
}

int run_status(const ServerPlace& place, bool as_json) {
  auto client = place.connect();
  if (!client) return report(client.error());
  const auto status = client->get_status(place.timeout());
  if (!status) return report(status.error());
  write_out(as_json ? json_text(*status) : status_table(*status, client->name()));
  return kExitOk;
}

}  // namespace

Command make_status_command(CLI::App& app) {
  auto place = std::make_shared<ServerPlace>();
  auto as_json = std::make_shared<bool>(false);
  CLI::App* command = app.add_subcommand(
      "status",
      "Shows own ships, radars, their controls and boards, the world, clients, losses and errors");
  place->add_options(*command);
  command->add_flag("--json", *as_json,
                    "The Status message of radar.proto as JSON (64-bit counts "
                    "are strings, as protobuf writes them)");
  command->footer(
      "Examples:\n"
      "  skerry status\n"
      "  skerry status --host bridge-1 --json | jq '.radars[0].scan'\n");
  return {command, [place, as_json] { return run_status(*place, *as_json); }};
}

}  // namespace skerry::client

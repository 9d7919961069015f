// skerry set: changes the own ship's orders, the controls of a view and a radar, and the world.
#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "clients/cli/command.hpp"
#include "clients/cli/console.hpp"
#include "clients/cli/live/set_request.hpp"
#include "protocol/wire/printable_text.hpp"

namespace skerry::client {
namespace {

struct SetOptions {
  ServerPlace place;
  wire::Set request;
  RainOptions rain;
  std::vector<std::string> artefacts;
  std::vector<std::string> blanked;
};

// Whether the request says more than where it goes.
bool changes_anything(wire::Set request) {
  request.clear_radar();
  request.clear_view();
  request.clear_token();
  request.clear_instructor();
  return request.ByteSizeLong() > 0;
}

int refuse(const std::string& text) {
  report(text);
  return kExitUsage;
}

int run_set(const SetOptions& options, const CLI::App& command) {
  wire::Set request = options.request;
  for (const std::string& text : options.artefacts) {
    if (const auto wrong = add_artefact(text, *request.mutable_world())) return refuse(*wrong);
  }
  if (const auto wrong = add_blanked(options.blanked, request)) return refuse(*wrong);
  if (options.rain.any()) {
    if (const auto wrong = add_rain(options.rain, *request.mutable_world())) return refuse(*wrong);
  }
  if (!changes_anything(request)) {
    fmt::print(stderr, "skerry set: nothing to set; give at least one of the options below\n\n{}",
               command.help("skerry"));
    return kExitUsage;
  }
  auto client = options.place.connect();
  if (!client) return report(client.error());
  const auto reply = client->set(request, options.place.timeout());
  if (!reply) return report(reply.error());
  write_out(reply->text().empty() ? "OK\n" : fmt::format("OK: {}\n", printable(reply->text())));
  return kExitOk;
}

std::string finite(const std::string& text) {
  try {
    if (std::isfinite(std::stod(text))) return {};
  } catch (const std::exception&) {
  }
  return fmt::format("'{}' is not a number", printable(text));
}

void add_rain_options(CLI::App& command, RainOptions& rain, const CLI::Validator& number) {
  const char* const group = "Rain (the world's: for all radars)";
  command.add_option("--add-rain", rain.add, "A new rain cell at LATITUDE LONGITUDE, degrees")
      ->expected(2)
      ->check(number)
      ->group(group);
  auto* const change =
      command.add_option("--change-rain", rain.change, "Changes the rain cell of that number")
          ->excludes("--add-rain")
          ->group(group);
  command.add_option("--rain-at", rain.at, "Puts it at LATITUDE LONGITUDE")
      ->expected(2)
      ->check(number)
      ->needs(change)
      ->group(group);
  const auto add = [&](const char* name, std::optional<double>& value, const char* text) {
    command.add_option(name, value, text)->check(number)->group(group);
  };
  add("--rain-radius", rain.radius_nm, "Radius, NM, 0.1 to 50; a new one: 2");
  add("--rain-rate", rain.rate_mm_h, "Mean rate where it rains, mm/h, 0.1 to 100; a new one: 4");
  add("--rain-drift", rain.drift_deg, "Drifts to, degrees true, 0 to 360");
  add("--rain-speed", rain.drift_kn, "Drifts at, knots, 0 to 60");
  command.add_option("--rain-kind", rain.kind, "Its shape; a new one: cell")
      ->check(CLI::IsMember(rain_kinds()))
      ->group(group);
  command.add_option("--remove-rain", rain.remove, "Removes the rain cells of these numbers")
      ->group(group);
  command.add_flag("--remove-all-rain", rain.remove_all, "Removes all of them")->group(group);
}

void add_instructor_options(CLI::App& command, wire::Set& request) {
  const char* const group = "Instructor";
  command
      .add_flag_callback(
          "--instructor", [&request] { request.set_instructor(true); },
          "As the instructor, whom no lock holds")
      ->group(group);
  const auto add = [&](const char* name, void (wire::Set::*put)(const std::string&),
                       const char* text) {
    command
        .add_option_function<std::vector<std::string>>(
            name,
            [&request, put](const std::vector<std::string>& controls) {
              request.set_instructor(true);
              for (const std::string& control : controls) (request.*put)(control);
            },
            text)
        ->group(group);
  };
  add("--lock", &wire::Set::add_lock,
      "Only the instructor changes these controls of the radar from now on: names as in "
      "radar.proto "
      "(gain, range_nm, transmit, course_deg, world ...)");
  add("--unlock", &wire::Set::add_unlock, "All may change them again");
}

}  // namespace

Command make_set_command(CLI::App& app) {
  auto options = std::make_shared<SetOptions>();
  wire::Set* const request = &options->request;
  CLI::App* command = app.add_subcommand(
      "set",
      "Changes the own ship's orders, the controls of a view and a radar, and the world; all or "
      "nothing");
  options->place.add_options(*command);
  const auto add_index = [&](const char* name, void (wire::Set::*set)(std::uint32_t),
                             const char* text) {
    command->add_option_function<std::uint32_t>(
        name, [request, set](std::uint32_t value) { (request->*set)(value); }, text);
  };
  add_index("--radar", &wire::Set::set_radar, "Index of the radar [0]");
  add_index("--view", &wire::Set::set_view, "Number of the view [0]; 0 is shared by all");
  const CLI::Validator number(finite, "", "finite");
  for (const SetOption& option : set_options()) {
    command
        ->add_option_function<std::string>(
            option.name,
            [request, option](const std::string& text) { put_option(*request, option, text); },
            option.help)
        ->check(option.words.empty() ? number : CLI::Validator(CLI::IsMember(option.words)))
        ->group(option.group)
        ->type_name(option.words.empty() ? "FLOAT" : "TEXT");
  }
  add_rain_options(*command, options->rain, number);
  command
      ->add_option(
          "--blank", options->blanked,
          "Where the transmitter is off: up to four sectors FROM-TO, degrees clockwise from "
          "the bow, in place of those there were; none: nowhere")
      ->expected(1, 4)
      ->group(kRadarGroup);
  add_instructor_options(*command, *request);
  command
      ->add_option("--artefact", options->artefacts,
                   "NAME=on or NAME=off, as often as wanted: " + artefact_names())
      ->group(kWorldGroup);
  command
      ->add_option_function<std::string>(
          "--token", [request](const std::string& token) { request->set_token(token); },
          "Needed from another host than the server's")
      ->envname("SKERRY_TOKEN");
  command->footer(
      "Examples:\n"
      "  skerry set --course 045 --speed 12\n"
      "  skerry set --radar 1 --range 6 --gain 55 --sea-auto on\n"
      "  skerry set --radar 1 --transmit off              (standby)\n"
      "  skerry set --pulse long --tune-auto off --tune 48\n"
      "  skerry set --doppler both --mode harbour\n"
      "  skerry set --blank 350-10 120-150\n"
      "  skerry set --lock range_nm transmit\n"
      "  skerry set --instructor --range 12\n"
      "  skerry set --sea-state 4 --wind-from 225\n"
      "  skerry set --add-rain 60.45 4.95 --rain-radius 3 --rain-rate 16 --rain-drift 45 "
      "--rain-speed 12\n"
      "  skerry set --artefact interference=off --artefact side_lobes=off\n");
  return {command, [options, command] { return run_set(*options, *command); }};
}

}  // namespace skerry::client

// skerry set: changes the own ship's orders and a view's receiver settings.
#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <optional>

#include "clients/cli/command.hpp"
#include "clients/cli/console.hpp"
#include "clients/common/printable_text.hpp"

namespace skerry::client {
namespace {

struct SetOptions {
  ServerPlace place;
  ViewChoice choice;
  std::optional<double> course, speed, range, gain, sea, rain;
  std::string token;

  bool any() const { return course || speed || range || gain || sea || rain; }
};

wire::Set request_of(const SetOptions& options) {
  wire::Set request;
  request.set_radar(options.choice.radar);
  request.set_view(options.choice.view);
  if (options.course) request.set_course_deg(*options.course);
  if (options.speed) request.set_speed_kn(*options.speed);
  if (options.range) request.set_range_nm(*options.range);
  if (options.gain) request.set_gain(*options.gain);
  if (options.sea) request.set_sea(*options.sea);
  if (options.rain) request.set_rain(*options.rain);
  request.set_token(options.token);
  return request;
}

int run_set(const SetOptions& options, const CLI::App& command) {
  if (!options.any()) {
    fmt::print(stderr,
               "skerry set: nothing to set; give at least one of --course, --speed, --range, "
               "--gain, --sea, --rain\n\n{}",
               command.help("skerry"));
    return kExitUsage;
  }
  auto client = options.place.connect();
  if (!client) return report(client.error());
  const auto reply = client->set(request_of(options), options.place.timeout());
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

}  // namespace

Command make_set_command(CLI::App& app) {
  auto options = std::make_shared<SetOptions>();
  CLI::App* command = app.add_subcommand(
      "set", "Changes the own ship's orders and a view's receiver settings; all or nothing");
  options->place.add_options(*command);
  command->add_option("--radar", options->choice.radar, "Index of the radar")
      ->capture_default_str();
  command->add_option("--view", options->choice.view, "Index of the view; 0 is shared by all")
      ->capture_default_str();
  const CLI::Validator number(finite, "", "finite");
  const auto add = [&](const char* name, std::optional<double>& value, const char* text) {
    command->add_option(name, value, text)->check(number);
  };
  add("--course", options->course, "Ordered course, degrees true, 0 to below 360");
  add("--speed", options->speed, "Ordered speed, knots, -10 to 60");
  add("--range", options->range, "Range scale, NM: 0.125 0.25 0.5 0.75 1.5 3 6 12 24 48 72 96");
  add("--gain", options->gain, "Gain, 0 to 100");
  add("--sea", options->sea, "Sea clutter control (STC), 0 to 100");
  add("--rain", options->rain, "Rain clutter control (FTC), 0 to 100");
  command->add_option("--token", options->token, "Needed from another host than the server's")
      ->envname("SKERRY_TOKEN");
  command->footer(
      "Examples:\n"
      "  skerry set --course 045 --speed 12\n"
      "  skerry set --radar 1 --range 6 --gain 55 --sea 30\n");
  return {command, [options, command] { return run_set(*options, *command); }};
}

}  // namespace skerry::client

// A reader of scenario files: what it refuses names its place, what it accepts can be sailed.
#include <cmath>
#include <cstdio>
#include <sstream>
#include <string>
#include <vector>

#include "protocol/wire/utf8.hpp"
#include "server/config/config_error.hpp"
#include "server/config/yaml_message.hpp"
#include "server/world/scenario.hpp"
#include "server/world/world.hpp"
#include "tests/fuzz/fuzz_require.hpp"

namespace {

using namespace skerry;
using namespace skerry::server;

// "f:LINE:COLUMN: ..." in printable text, the place within `text` or just behind it.
TextPlace check_line(const std::string& what, const std::string& text) {
  unsigned long line = 0, column = 0;
  int length = 0;
  const int read = std::sscanf(what.c_str(), "f:%lu:%lu: %n", &line, &column, &length);
  fuzz::require(read == 2 && length > 0, "a refusal names file, line and column");
  fuzz::require(what.size() > static_cast<std::size_t>(length), "and says why");
  fuzz::require(printable(what, what.size()) == what, "in printable text");
  fuzz::require(what.size() < 20'000, "of bounded length");

  std::size_t lines = 1, start = 0;
  for (std::size_t at = 0; at < text.size() && lines < line; ++at) {
    if (text[at] != '\n') continue;
    ++lines;
    start = at + 1;
  }
  fuzz::require(line >= 1 && lines == line, "the line is one of the text");
  const std::string rest = text.substr(start, text.find('\n', start) - start);
  fuzz::require(column >= 1 && column <= character_count(rest) + 1, "the column one of the line");
  return {static_cast<int>(line), static_cast<int>(column)};
}

// One line, or several in the order of their places and how many there are.
void check_refusal(const std::string& what, const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream all(what);
  for (std::string line; std::getline(all, line);) lines.push_back(line);
  if (lines.size() > 1) {
    std::size_t errors = 0, shown = 0, more = 0;
    const int read = std::sscanf(lines.back().c_str(), "f: %zu errors: %zu shown and %zu more",
                                 &errors, &shown, &more);
    fuzz::require(read == 1 || read == 3, "the last line counts");
    lines.pop_back();
    if (read == 1) shown = errors;
    fuzz::require(lines.size() == shown && errors == shown + more, "rightly");
    fuzz::require(lines.size() <= YamlSource::kMostShown, "a bounded number of errors");
  }
  TextPlace before;
  for (const std::string& line : lines) {
    const TextPlace place = check_line(line, text);
    fuzz::require(before <= place, "errors come in the order of the text");
    before = place;
  }
}

bool on_earth(const ShipState& ship) {
  return std::fabs(ship.position.latitude_deg) <= 90.0 && ship.position.longitude_deg >= -180.0 &&
         ship.position.longitude_deg < 180.0 && ship.heading_deg >= 0.0 && ship.heading_deg < 360.0;
}

void check_voyage(const scenario::Scenario& scenario) {
  World world(scenario);
  for (int tick = 0; tick < 3; ++tick) {
    const WorldState state = world.state();
    for (const ShipState& ship : state.own_ships)
      fuzz::require(on_earth(ship), "own ship on Earth");
    for (const ShipState& ship : state.targets) fuzz::require(on_earth(ship), "target on Earth");
    world.step();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(data, data + size);
  scenario::Scenario scenario;
  try {
    scenario = parse_scenario(text, "f");
  } catch (const ConfigError& error) {
    check_refusal(error.what(), text);
    return 0;
  }
  fuzz::require(parse_scenario(text, "f").SerializeAsString() == scenario.SerializeAsString(),
                "a text reads the same twice");
  check_voyage(scenario);
  return 0;
}

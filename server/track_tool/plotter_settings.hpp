// The plotter's settings as options of a command line: a table with a row for each.
#pragma once

#include <CLI/CLI.hpp>

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "server/plotter/plotter.hpp"

namespace skerry::server {

struct PlotterSetting {
  const char* name;  // of the option, without hyphens
  double least, most;
  const char* unit;  // empty: a count
  bool whole;        // only whole numbers
  double (*get)(const Plotter::Rule& rule);
  void (*set)(Plotter::Rule& rule, double value);
  const char* help;
};

// The defaults are those of Plotter::Rule.
std::span<const PlotterSetting> plotter_settings();

// What a user chose.
class ChosenSettings {
 public:
  // An option for each row, with its range, unit and default in its help.
  void add_options(CLI::App& command);
  // The rule with what was chosen.
  Plotter::Rule rule() const;
  // Whether that one was chosen.
  bool has(std::string_view name) const;

 private:
  std::vector<std::optional<double>> values_;  // by row
};

}  // namespace skerry::server

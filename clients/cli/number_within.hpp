// A check of options with a number.
#pragma once

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <string>

namespace skerry::client {

// Like CLI::Range, but refuses "nan", which that lets pass.
inline CLI::Validator number_within(double least, double most) {
  const std::string range = fmt::format("[{} - {}]", least, most);
  return CLI::Validator(
      [=](std::string& text) {
        double number = 0.0;
        const bool is_number = CLI::detail::lexical_cast(text, number);
        if (is_number && number >= least && number <= most) return std::string{};
        return fmt::format("{} is not in {}", text, range);
      },
      "FLOAT in " + range);
}

}  // namespace skerry::client

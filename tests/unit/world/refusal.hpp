// The error that a scenario causes.
#pragma once

#include <string>

#include "server/config/config_error.hpp"
#include "server/world/scenario.hpp"

namespace skerry::server {

// "LINE:COLUMN: what is wrong", or "" if the text is accepted.
inline std::string refusal(const std::string& text) {
  try {
    parse_scenario(text, "test.yaml");
  } catch (const ConfigError& error) {
    return std::string(error.what()).substr(std::string("test.yaml:").size());
  }
  return "";
}

}  // namespace skerry::server

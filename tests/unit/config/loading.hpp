// The reader of YAML files, given a text.
#pragma once

#include <string>

#include "server/config/yaml_message.hpp"
#include "tests/unit/config/every_kind.pb.h"

namespace skerry::server {

template <typename Message = test::EveryKind>
Message loaded(const std::string& text) {
  Message message;
  load_yaml(text, "t.yaml", message);
  return message;
}

// The text of the ConfigError; empty if the text is accepted.
template <typename Message = test::EveryKind>
std::string refusal(const std::string& text) {
  Message message;
  try {
    load_yaml(text, "t.yaml", message);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return {};
}

}  // namespace skerry::server

#include "server/world/scenario.hpp"

#include "server/config/yaml_message.hpp"
#include "server/world/scenario_checks.hpp"

namespace skerry::server {

scenario::Scenario parse_scenario(const std::string& text, const std::string& file_name) {
  scenario::Scenario scenario;
  const YamlSource source = load_yaml(text, file_name, scenario);
  check_scenario(source, scenario);
  return scenario;
}

scenario::Scenario load_scenario(const std::string& path) {
  scenario::Scenario scenario;
  const YamlSource source = load_yaml_file(path, scenario);
  check_scenario(source, scenario);
  return scenario;
}

scenario::Scenario default_scenario() {
  return parse_scenario(default_scenario_yaml(), "built-in bergen.yaml");
}

}  // namespace skerry::server

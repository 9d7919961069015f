#include "server/net/navigation/navigation_ports.hpp"

namespace skerry::server {

NavigationPorts::NavigationPorts(NetContext& context) {
  for (const auto& config : context.config.navigation_outputs) {
    outputs_.push_back(std::make_unique<NavigationOutput>(context, config));
  }
  for (const auto& config : context.config.navigation_inputs) {
    inputs_.push_back(std::make_unique<NavigationInput>(context, config));
  }
}

void NavigationPorts::start() {
  for (const auto& output : outputs_) output->start();
  for (const auto& input : inputs_) input->start();
}

void NavigationPorts::close() {
  for (const auto& output : outputs_) output->close();
  for (const auto& input : inputs_) input->close();
}

}  // namespace skerry::server

// NavigationPorts: all navigation outputs and inputs of the server.
#pragma once

#include <memory>
#include <vector>

#include "server/net/navigation/navigation_input.hpp"
#include "server/net/navigation/navigation_output.hpp"

namespace skerry::server {

// Thread: constructed anywhere, then net-0.
class NavigationPorts {
 public:
  // Opens what context.config names.  Error: as of its parts.
  explicit NavigationPorts(NetContext& context);

  void start();
  void close();

 private:
  std::vector<std::unique_ptr<NavigationOutput>> outputs_;
  std::vector<std::unique_ptr<NavigationInput>> inputs_;
};

}  // namespace skerry::server

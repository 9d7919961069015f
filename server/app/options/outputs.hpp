// Outputs: from the configuration to the network's own terms.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "server/app/config.pb.h"
#include "server/config/config_error.hpp"
#include "server/net/common/net_config.hpp"

namespace skerry::server {

// Unless others are given.
inline constexpr std::uint16_t kCat240Port = 8600, kNativePort = 7411;

// One kind of output: a row for each value of Output.Kind, in the same order.
struct OutputKind {
  std::string_view name;
  std::vector<std::string_view> keys;  // that an entry of this kind takes

  // Adds entry `index` of file.outputs; `name` begins what it says of errors.
  void (*add)(const app::ServerConfig& file, int index, const std::string& name, NetConfig& net);
};
const std::vector<OutputKind>& output_kinds();

// Adds the outputs of `file` to `net`: streams, emulated radars and sentences each to their list.
// Error: std::runtime_error naming the entry, the key, and what was expected; also for a key that
// its kind does not take.
void add_outputs(const app::ServerConfig& file, NetConfig& net);

// Adds to the errors of the configuration file, for each output, the first for which add_outputs()
// would refuse it.
void check_outputs(const app::ServerConfig& file, YamlSource& source);

}  // namespace skerry::server

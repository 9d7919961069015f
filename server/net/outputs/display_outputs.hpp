// DisplayOutputs: all emulated radars of the server.
#pragma once

#include <chrono>
#include <memory>
#include <vector>

#include "server/net/outputs/display_output.hpp"

namespace skerry::server {

// Thread: constructed anywhere, then net-0.
class DisplayOutputs {
 public:
  // The period of RadarEmulation::on_time().
  static constexpr std::chrono::milliseconds kTick{10};

  // Opens the outputs of context.config.displays.
  // Error: std::runtime_error naming the output and the reason, among them that two of them cannot
  // be on one host (output_conflicts.hpp).
  explicit DisplayOutputs(NetContext& context);

  void start();
  void close();

 private:
  void tick();

  std::vector<std::unique_ptr<DisplayOutput>> outputs_;
  Timer timer_;
  std::chrono::steady_clock::time_point due_;
  bool closed_ = false;
};

}  // namespace skerry::server

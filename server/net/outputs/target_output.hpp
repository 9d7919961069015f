// TargetOutput: the plots and tracks of a radar's shared view as datagrams of ASTERIX.
#pragma once

#include <memory>

#include "server/core/target_port.hpp"
#include "server/net/common/destination_socket.hpp"
#include "server/net/common/net_context.hpp"
#include "server/net/outputs/target_reports.hpp"

namespace skerry::server {

// Keeps the plotter of the view running.  Sends each of its lists once and never waits: what the
// socket does not take at once is dropped and counted.
// Thread: constructed anywhere, then net-0.
class TargetOutput {
 public:
  // Error: std::runtime_error naming the output and the reason: no such radar, of
  // open_destination().
  TargetOutput(NetContext& context, const TargetOutputConfig& config);

  void tick();  // net-0, ten times a second: sends what is new
  void close();

 private:
  void send(const ReportedTargets& news);

  NetContext& context_;
  const TargetOutputConfig config_;
  const std::size_t max_datagram_;
  DestinationSocket destination_;
  OutputPtr counters_;
  std::shared_ptr<const void> wanted_targets_;  // TargetPort::want()
  ToldTracks told_;
  // What was sent last.
  TargetListPtr list_;
  TargetPlotsPtr plots_;
};

}  // namespace skerry::server

// TargetPort: the plotters of all views as the network and the recorder see them.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>

#include "protocol/wire/radar.pb.h"
#include "protocol/wire/targets.pb.h"

namespace skerry::server {

using TargetListPtr = std::shared_ptr<const wire::TargetList>;
using TargetPlotsPtr = std::shared_ptr<const wire::TargetPlots>;

// Implemented in server/plotting.  Thread: any; every function returns at once.
class TargetPort {
 public:
  static constexpr std::chrono::milliseconds kListPeriod{500};
  static constexpr std::chrono::seconds kGrace{60};
  static constexpr int kMostPlots = 4000;

  virtual ~TargetPort() = default;

  // Somebody wants the targets of this view: its plotter runs as long as anybody holds what this
  // returns, and kGrace longer, so that who comes back finds its tracks.  nullptr: no such view.
  virtual std::shared_ptr<const void> want(std::uint32_t radar, std::uint32_t view) = 0;

  // The newest list; nullptr until there is one, and for views that nobody wants.  A list is
  // immutable, and a new one comes twice a second (kListPeriod).
  virtual TargetListPtr targets(std::uint32_t radar, std::uint32_t view) const = 0;

  // The plots that came with that list: those since the list before, at most kMostPlots.
  virtual TargetPlotsPtr plots(std::uint32_t radar, std::uint32_t view) const = 0;

  // The token is not looked at.  Refused for a view that nobody wants.  `origin`: who asked, as
  // RadarHost::apply() has it.
  virtual wire::Reply order(const wire::TargetOrder& order, const std::string& origin) = 0;
};

}  // namespace skerry::server

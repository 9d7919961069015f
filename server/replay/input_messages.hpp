// The inputs of radars <-> recording::Input.
#pragma once

#include <optional>

#include "protocol/recording/inputs.pb.h"
#include "server/core/traffic.hpp"
#include "server/core/utc_clock.hpp"
#include "server/radar/sector_maker.hpp"

namespace skerry::server {

recording::Input::Radar message_of(const echo::RadarControls& controls);
recording::Input::View message_of(const ViewInForce& view);
recording::Input::Clock message_of(const UtcClock& clock);

// From outside: nothing if a value is none of those that the controls can have.
std::optional<echo::RadarControls> controls_of(const recording::Input::Radar& message);
std::optional<ViewInForce> view_of(const recording::Input::View& message);
std::optional<UtcClock> clock_of(const recording::Input::Clock& message);

recording::Input::Fix message_of(const OwnShipFix& fix);
OwnShipFix fix_of(const recording::Input::Fix& message);

}  // namespace skerry::server

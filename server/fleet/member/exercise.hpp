// Exercise: what the hosts of a fleet run, as the fleet sees it.
#pragma once

#include <string>
#include <vector>

#include "server/fleet/host_clock.hpp"
#include "server/fleet/log_event.hpp"
#include "server/fleet/world_hashes.hpp"

namespace skerry::fleet {

// Thread: the member's ("fleet"), but for refused(), and for a last hold() by who stops the member.
// keep() and come_back() are called under the member's mutex: they must not call the member.
class Exercise {
 public:
  virtual ~Exercise() = default;

  // Makes the ticks up to that one, and none beyond it, whoever asks.
  virtual void run_to(Tick tick) = 0;
  // An order of this or another host, which holds from the tick behind the last one made.
  virtual void give(const OrderSeen& order) = 0;
  // An order of this host that will never be given, or of which that is not known.  Thread: any.
  virtual void refused(const std::string& id, const std::string& text) = 0;
  // Keeps all that orders change, as of the last tick made.
  virtual void keep() = 0;
  // Back to what was kept, or to the beginning.  The tick it is at then is the caller's to know.
  enum class Back { kept, beginning };
  virtual void come_back(Back to) = 0;
  // Of the world as of the last tick made.
  virtual WorldDigest digest() const = 0;
  // Until when this host makes the spokes of each own ship's radars; a time that has passed: it
  // does not.  Called after each look, 5 ms apart or more.
  virtual void hold(const std::vector<HostTime>& until) = 0;
};

}  // namespace skerry::fleet

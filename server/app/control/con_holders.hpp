// ConHolders: who has the con of each own ship.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "protocol/wire/conning.pb.h"

namespace skerry::server {

// One console a ship.  A ship that nobody has takes orders from anyone.  Thread: one at a time.
class ConHolders {
 public:
  explicit ConHolders(std::size_t own_ships) : holders_(own_ships) {}

  // Why `origin` may not give this order to the ship; course and speed are orders too, without a
  // `con`.  The instructor always may.
  std::optional<std::string> refusal(std::size_t own_ship, const std::string& ship_name,
                                     const wire::ConOrder* con, const std::string& origin,
                                     bool instructor) const;
  // True if that has changed who has the con.
  bool change(std::size_t own_ship, const wire::ConOrder& con, const std::string& origin);
  // The connection of `origin` has ended; the own ships whose con it had, which are free now.
  std::vector<std::size_t> leave(const std::string& origin);

  // Empty: nobody.
  const std::string& holder(std::size_t own_ship) const { return holders_[own_ship]; }
  std::size_t size() const { return holders_.size(); }

 private:
  std::vector<std::string> holders_;
};

}  // namespace skerry::server

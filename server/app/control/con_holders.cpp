#include "server/app/control/con_holders.hpp"

#include <fmt/format.h>

namespace skerry::server {

std::optional<std::string> ConHolders::refusal(std::size_t own_ship, const std::string& ship_name,
                                               const wire::ConOrder* con, const std::string& origin,
                                               bool instructor) const {
  const std::string& holder = holders_[own_ship];
  if (con != nullptr && con->take() && con->release()) {
    return "con: taken and given away at once; expected one of the two";
  }
  if (holder.empty() || holder == origin || instructor) return std::nullopt;
  return fmt::format("{} has the con of {}; ask for it to be given away, or take it as instructor",
                     holder, ship_name);
}

bool ConHolders::change(std::size_t own_ship, const wire::ConOrder& con,
                        const std::string& origin) {
  std::string& holder = holders_[own_ship];
  const std::string before = holder;
  if (con.take()) holder = origin;
  if (con.release()) holder.clear();
  return holder != before;
}

std::vector<std::size_t> ConHolders::leave(const std::string& origin) {
  std::vector<std::size_t> freed;
  for (std::size_t own_ship = 0; own_ship < holders_.size(); ++own_ship) {
    if (holders_[own_ship] != origin) continue;
    holders_[own_ship].clear();
    freed.push_back(own_ship);
  }
  return freed;
}

}  // namespace skerry::server

// LogPace: when a thing that goes on happening may be told again.
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>

namespace skerry::server {

// `kind` is one of a few fixed names.  Time is passed in.
class LogPace {
 public:
  using Time = std::chrono::steady_clock::time_point;

  explicit LogPace(std::chrono::seconds period) : period_(period) {}

  // It has happened.  True if it is to be told now; then how often it happened since it was last
  // told without being told, and whether this is the first time.
  struct Tell {
    bool now = false;
    bool is_first = false;
    std::uint64_t untold = 0;
  };
  Tell tell(std::string_view kind, Time now) {
    const auto [known, is_first] = told_.try_emplace(std::string(kind), Told{now, 0});
    Told& told = known->second;
    if (!is_first && now - told.at < period_) {
      ++told.untold;
      return {};
    }
    const std::uint64_t untold = told.untold;
    told = {now, 0};
    return {.now = true, .is_first = is_first, .untold = untold};
  }

 private:
  struct Told {
    Time at;
    std::uint64_t untold;
  };
  std::chrono::seconds period_;
  std::map<std::string, Told, std::less<>> told_;
};

}  // namespace skerry::server

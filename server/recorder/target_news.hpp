// TargetNews: what a recording has not yet of the plotters at work.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <utility>

#include "server/core/target_port.hpp"

namespace skerry::server {

// Of each view a list of targets a second, and all plots.  It starts no plotter: what nobody looks
// for is not recorded.
// Thread: the recorder's.
class TargetNews {
 public:
  struct News {
    std::optional<wire::TargetList> list;  // without past places, which the lists before have
    TargetPlotsPtr plots;
  };
  News take(const TargetPort& port, std::uint32_t radar, std::uint32_t view);

 private:
  struct Told {
    TargetListPtr list;  // the last that was looked at
    TargetPlotsPtr plots;
    std::uint64_t utc_ns = 0;  // of the last list given
  };
  std::map<std::pair<std::uint32_t, std::uint32_t>, Told> told_;
};

}  // namespace skerry::server

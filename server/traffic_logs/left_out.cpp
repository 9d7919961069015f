#include "server/traffic_logs/left_out.hpp"

#include <numeric>

namespace skerry::server {
namespace {

constexpr std::array<std::string_view, kLeftOutKinds> kNames = {
    "no sentence in the line",
    "line too long",
    "cut short",
    "wrong checksum or characters",
    "row that cannot be read",
    "other sentence than VDM and VDO",
    "message with a part missing",
    "message too short or no six-bit text",
    "kind of message without ships",
    "MMSI of no ship",
    "base station",
    "aid to navigation",
    "SART, man overboard or EPIRB",
    "aircraft",
    "position not available",
    "no time",
    "out of the time wanted",
    "out of the area wanted",
    "not a second after the ship's fix before",
    "jump that no ship makes",
    "single fix",
    "of more ships than are followed",
};

}  // namespace

std::string_view name_of(LeftOut kind) { return kNames[static_cast<std::size_t>(kind)]; }

std::uint64_t LeftOutCounts::all() const {
  return std::accumulate(counts_.begin(), counts_.end(), std::uint64_t{0});
}

}  // namespace skerry::server

// Time that a board leaves out: counted, nothing made.
#include <algorithm>
#include <vector>

#include "server/board/board_core.hpp"

namespace skerry::server {
namespace {

// Turns that are counted one by one behind a skip, so that every tick in the counts is a true one.
constexpr std::uint64_t kTurnsBehind = 3;
constexpr std::uint32_t kPlaces = 3600;  // tenths of a degree

struct Part {
  std::uint32_t from = 0, to = 0;
};

// The parts of a turn outside the blanked sectors, in order.
std::vector<Part> clear_parts(const BoardSettings& settings) {
  std::vector<Part> parts;
  for (std::uint32_t place = 0; place < kPlaces; ++place) {
    // The middle of the tenth of a degree.
    const auto fraction = static_cast<std::uint64_t>(
        ((static_cast<unsigned __int128>(2 * place + 1) << 64) / (2 * kPlaces)));
    if (settings.blanks({0, fraction})) continue;
    if (parts.empty() || parts.back().to != place) parts.push_back({place, place});
    parts.back().to = place + 1;
  }
  return parts;
}

Azimuth azimuth_of(std::uint64_t turn, std::uint32_t place) {
  if (place == kPlaces) return {turn + 1, 0};
  const auto scaled = (static_cast<unsigned __int128>(place) << 64) + (kPlaces - 1);
  return {turn, static_cast<std::uint64_t>(scaled / kPlaces)};
}

}  // namespace

void BoardCore::skip_good_turns(Tick to) {
  const Tick from = azimuth_.next().tick;
  if (from >= to || !counter_.steady() || azimuth_.disturbed(from)) return;
  const auto turn =
      static_cast<Tick>(static_cast<Wide>(settings_.clock_hz) * 60'000 / settings_.milli_rpm) + 1;
  const std::uint64_t turns = (to - from) / turn;
  if (turns <= kTurnsBehind) return;
  azimuth_.skip_turns(turns - kTurnsBehind);
  const std::uint64_t triggers = skip_triggers(azimuth_.next().tick);
  counter_.skip(turns - kTurnsBehind, triggers);
  if (has_channels() && (streams() || fills_fifo())) sweeps_late_ += triggers;
}

std::uint64_t BoardCore::skip_triggers(Tick to) {
  if (settings_.blanking != board::BlankingMode::trigger) return triggers_.skip_to(to);
  const Tick from = triggers_.next();
  const std::vector<Part> parts = clear_parts(settings_);
  std::uint64_t sent = 0;
  if (from < to) {
    const std::uint64_t last_turn = azimuth_.at(to).turns;
    for (std::uint64_t turn = azimuth_.at(from).turns; turn <= last_turn; ++turn) {
      for (const Part& part : parts) {
        const Tick begin = std::max(azimuth_.first_tick(azimuth_of(turn, part.from)), from);
        const Tick end = std::min(azimuth_.first_tick(azimuth_of(turn, part.to)), to);
        if (begin < end) sent += triggers_.count(begin, end);
      }
    }
  }
  triggers_.skip_to(to);
  return sent;
}

}  // namespace skerry::server

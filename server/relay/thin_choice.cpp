#include "server/relay/thin_choice.hpp"

#include <algorithm>
#include <utility>

#include "protocol/thin/thin_shape.hpp"

namespace skerry::server {

ThinChoice::ThinChoice(std::optional<std::uint32_t> fixed, Time now)
    : fixed_(fixed.has_value()),
      level_(fixed.value_or(kThinLevels)),
      changed_(now),
      look_began_(now),
      calm_since_(now) {}

void ThinChoice::begin_look(Time now) {
  look_began_ = now;
  came_ = {};
}

void ThinChoice::change(std::uint32_t level, Time now) {
  level_ = level;
  changed_ = calm_since_ = now;
  begin_look(now);
}

bool ThinChoice::look(const Came& came, Time now) {
  if (fixed_) return false;
  if (now - changed_ < kSettle) {
    begin_look(now);
    return false;
  }
  came_.spokes += came.spokes;
  came_.lost += came.lost;
  came_.bytes += came.bytes;
  came_.made += came.made;
  came_.took += came.took;
  if (now - look_began_ < kLook) return false;
  const Came all = came_;
  begin_look(now);
  if (all.spokes == 0) {  // standby, or no connection: nothing is known of the link
    calm_since_ = now;
    return false;
  }
  const double lost = static_cast<double>(all.lost) / static_cast<double>(all.spokes + all.lost);
  const double behind =
      all.took > Duration{0} ? 1.0 - in_seconds(all.made) / in_seconds(all.took) : 0.0;
  if (lost > kMostLost || behind > kMostBehind) return go_thinner(all, std::max(lost, behind), now);
  if (is_trying_ && now - changed_ >= kProven) {
    is_trying_ = false;
    patience_ = std::min(patience_, kFirstPatience);
  }
  if (level_ == 0 || now - calm_since_ < patience_) return false;
  is_trying_ = true;
  change(level_ - 1, now);
  return true;
}

bool ThinChoice::go_thinner(const Came& all, double missing, Time now) {
  calm_since_ = now;
  const bool was_trying = std::exchange(is_trying_, false);
  patience_ = was_trying ? std::clamp(2 * patience_, kFirstPatience, kLastPatience)
                         : std::max(patience_, kFirstPatience);
  if (level_ == kThinLevels) return false;
  std::uint32_t next = level_ + 1;
  if (!was_trying) {
    // What the whole of this level would have been, and so of the others.
    const auto bytes = static_cast<double>(all.bytes);
    const double wanted = bytes / (1.0 - std::min(missing, 0.99));
    while (next < kThinLevels &&
           wanted * kThinShapes[next].share / kThinShapes[level_].share > kRoom * bytes) {
      ++next;
    }
  }
  change(next, now);
  return true;
}

}  // namespace skerry::server

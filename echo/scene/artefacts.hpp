// Which false echoes the instructor lets through.
#pragma once

namespace skerry::echo {

// On by default: none shows (or costs anything) where the scene has no cause for it.
struct Artefacts {
  bool side_lobes = true;
  bool multiple_echoes = true;
  bool indirect_echoes = true;
  bool shadow_sectors = true;  // of masts and funnels; blanked sectors are the set's own
  bool second_trace = true;
  bool interference = true;
  bool overhead_cables = true;
  bool saturation = true;     // the receiver recovers slowly behind a strong echo
  bool minimum_range = true;  // blind while the transmitter fires and the TR cell recovers
  bool antenna_motion = true;
  friend bool operator==(const Artefacts&, const Artefacts&) = default;
};

}  // namespace skerry::echo

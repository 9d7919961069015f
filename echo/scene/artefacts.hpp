// Which false echoes the instructor lets through.
#pragma once

#include <array>
#include <string_view>

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

// Every switch by the name that scenarios and messages give it.
struct ArtefactRow {
  std::string_view name;
  bool Artefacts::*on;
};
inline constexpr std::array kArtefactRows = {
    ArtefactRow{"side_lobes", &Artefacts::side_lobes},
    ArtefactRow{"multiple_echoes", &Artefacts::multiple_echoes},
    ArtefactRow{"indirect_echoes", &Artefacts::indirect_echoes},
    ArtefactRow{"shadow_sectors", &Artefacts::shadow_sectors},
    ArtefactRow{"second_trace", &Artefacts::second_trace},
    ArtefactRow{"interference", &Artefacts::interference},
    ArtefactRow{"overhead_cables", &Artefacts::overhead_cables},
    ArtefactRow{"saturation", &Artefacts::saturation},
    ArtefactRow{"minimum_range", &Artefacts::minimum_range},
    ArtefactRow{"antenna_motion", &Artefacts::antenna_motion},
};

}  // namespace skerry::echo

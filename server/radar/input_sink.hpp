// InputSink: is told what radars' sectors are made of.
#pragma once

#include <cstdint>

#include "server/radar/sector_maker.hpp"

namespace skerry::server {

// Called on the threads of radars; must return at once.
class InputSink {
 public:
  virtual ~InputSink() = default;

  // Before the first sector.
  virtual void warmed_up(std::uint32_t radar, const SectorInputs& inputs) = 0;
  // For every sector, before it is made.  `emits`: the version of emissions is the radar's own.
  virtual void took(std::uint32_t radar, std::uint64_t first, const SectorInputs& inputs,
                    bool emits) = 0;
  // Instead, for one that is not made.
  virtual void skipped(std::uint32_t radar, std::uint64_t first,
                       const echo::RadarControls& controls) = 0;
};

}  // namespace skerry::server

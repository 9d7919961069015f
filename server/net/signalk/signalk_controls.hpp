// The controls of Signal K displays and those of the server: which is which, both ways.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "protocol/quantity/result.hpp"
#include "protocol/signalk/control_value.hpp"
#include "protocol/signalk/documents.hpp"
#include "protocol/wire/radar.pb.h"

namespace skerry::server {

// The four sectors of a display are places that can be empty; the server's are a list.  Remembers
// in which place a display put one, for as long as the list is what came of it.
class SectorPlaces {
 public:
  struct Place {
    double from_deg = 0.0, to_deg = 0.0;
    bool enabled = false;
    friend bool operator==(const Place&, const Place&) = default;
  };
  using Places = std::array<Place, signalk::kNoTransmitSectors>;

  // The places as of now.
  const Places& places(const wire::BlankedSectors& sectors);
  // The list that comes of a change of one place, which is remembered.
  wire::BlankedSectors change(std::size_t place, const signalk::ControlChange& change,
                              const wire::BlankedSectors& sectors);

 private:
  static wire::BlankedSectors list_of(const Places& places);
  Places places_{};
};

// All controls but the texts.
signalk::ControlStates control_states(const wire::Settings& settings, SectorPlaces& sectors);

// The Set for a display's change of a control, without radar and view.  A value without a word of
// automatic ends the automatic.
wire::Set set_of(const signalk::ControlDefinition& definition, const signalk::ControlChange& change,
                 const wire::Settings& settings, SectorPlaces& sectors);

}  // namespace skerry::server

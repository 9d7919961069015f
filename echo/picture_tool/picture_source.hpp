// Turns of radar video out of a recording, or out of a capture of a real radar.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "echo/measure/picture_turn.hpp"

namespace skerry::echo {

// Whole turns of one radar at one reach, from bow to bow, in order.
struct TurnsOfPicture {
  std::string file, radar;
  double reach_m = 0.0;
  std::uint32_t spokes = 0, cells = 0;
  std::uint8_t full_scale = 255;
  std::vector<std::vector<std::uint8_t>> turns;
  std::vector<bool> follows;       // whether the turn comes right after the one before
  double rpm = 0.0;                // 0: not known
  std::vector<std::string> notes;  // what was left out, and why

  PictureTurn turn(std::size_t number, double beam_deg) const {
    return {spokes, cells, reach_m / cells, beam_deg, full_scale, turns[number]};
  }
};

struct PictureChoice {
  std::uint32_t radar = 0;
  double reach_m = 0.0;         // 0: that with the most whole turns; else to 2 %
  std::size_t most_turns = 16;  // memory
};

// A turn counts if at most a twentieth of its spokes is missing; those have their neighbour's
// cells.  Error: std::runtime_error naming the file: it can be read as neither, has no whole turn,
// or none of that radar or reach; says what it has.
TurnsOfPicture read_picture(const std::string& file, const PictureChoice& choice = {});

}  // namespace skerry::echo

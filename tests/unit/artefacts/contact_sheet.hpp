// ContactSheet: small radar pictures side by side, each with its name and what to look for.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "protocol/picture/canvas.hpp"
#include "protocol/video/scan.hpp"

namespace skerry {

struct Thumbnail {
  std::string name, caption;
  Scan scan;
};

// The last turn of `video` (one byte per cell, spoke after spoke) as a receiver has it, north up.
Scan last_turn(const std::vector<std::uint8_t>& video, const ScanGeometry& geometry,
               RangeScale scale);

// Rows of kColumns round pictures, the range scale at their edge and a ring at half of it.
RgbaImage contact_sheet(const std::string& title, const std::vector<Thumbnail>& pictures);

inline constexpr int kColumns = 6;
inline constexpr int kPicture = 300;  // pixels across

}  // namespace skerry

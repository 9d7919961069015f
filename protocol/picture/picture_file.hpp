// Writing pictures: PNG for people, PGM for programs.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "protocol/picture/canvas.hpp"
#include "protocol/video/scan.hpp"
#include "protocol/wire/wire_error.hpp"

namespace skerry {

// Keyword (1 .. 79 printable ASCII characters) and text of PNG tEXt chunks; the text is made
// printable.
using PngText = std::vector<std::pair<std::string, std::string>>;

// Radar, scan, range scale, cell size, heading, position, time: what a scan's picture shows.
PngText describe(const Scan& scan, const std::string& radar_name);

// Error: std::runtime_error if libpng refuses (sizes below 1, memory).
Bytes encode_png(const RgbaImage& image, const PngText& text);

// The cells of a scan as they came: PGM P5, one row per spoke from the bow clockwise, one pixel per
// cell from the ship outwards, maxval 255 or 15; the rows of missing spokes are 0.
Bytes encode_pgm(const Scan& scan);

// Error: std::runtime_error that names the file and what the system said.
void write_file(const std::string& path, const Bytes& bytes);

}  // namespace skerry

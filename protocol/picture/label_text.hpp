// Texts in the corners of a radar picture, with numbers as navigators write them.
#pragma once

#include <string>
#include <vector>

#include "protocol/picture/ppi_picture.hpp"
#include "protocol/quantity/geo_point.hpp"
#include "protocol/quantity/time.hpp"

namespace skerry {

struct LabelLine {
  std::string text;
  bool warning = false;
};

// One list of lines per corner, from the top.
struct LabelText {
  std::vector<LabelLine> top_left, top_right, bottom_left, bottom_right;
};

// Top: radar and range scale, own ship.  Bottom: receiver, scan and what is missing in it.
LabelText label_text(const Scan& scan, Orientation orientation, const PpiLabels& labels);

std::string three_digits(int degrees);      // 007
std::string bearing_text(double degrees);   // 007.0^ with the font's degree sign
std::string position_text(GeoPoint point);  // 60^24.300'N 005^18.120'E
std::string utc_text(UtcTime time);         // 2024-05-01T12:00:00.250Z
std::string range_text(RangeScale scale);   // 0.125, 12

}  // namespace skerry

// ContactSheet: radar pictures in rows, on one scale and in the same colours.
#pragma once

#include <string>

#include "echo/picture_tool/picture_source.hpp"
#include "protocol/picture/canvas.hpp"

namespace skerry::echo {

// Panels stand from left to right, kColumns to a row; spoke 0 looks up, the last cell ends at the
// rim.  A pixel shows the strongest of the cells whose middles lie in it, or the one it lies in.
class ContactSheet {
 public:
  static constexpr int kPanel = 480, kColumns = 3;

  explicit ContactSheet(const std::string& title);

  // Each row is a capture's; a row that is begun ends the one before.
  void begin_row(const std::string& heading);
  // The first turn.  Requires one, and a row with room.
  void add(const TurnsOfPicture& picture, const std::string& caption);

  RgbaImage take();

 private:
  void grow_to(int height);

  RgbaImage image_;
  int row_top_ = 0, column_ = 0;
};

}  // namespace skerry::echo

// FigureSheet: coasts and their echoes side by side in one picture.
#pragma once

#include <string>

#include "echo/coast_tool/figure_coast.hpp"
#include "protocol/picture/canvas.hpp"

namespace skerry::echo {

// Rows of round panels, kColumns each, north up, the range scale at the edge; two lines of text
// under each.  Thread: one at a time.
class FigureSheet {
 public:
  static constexpr int kColumns = 4;
  static constexpr int kPanel = 430;  // pixels across

  FigureSheet(const FigureCoast& coast, const std::string& title);

  // Begins a row under a heading of one line and one of smaller remarks.
  void begin_row(const std::string& heading, const std::string& remark);
  // The coast as a line, land shaded as the echo chain reads it; the chart's edges under it, grey.
  void add_coast(const CoastPicture& picture, const std::string& caption);
  // The echo picture.
  void add_echo(const CoastPicturePtr& picture, const std::string& caption);

  // The sheet, cut below the last row.
  RgbaImage take();

 private:
  struct Place {
    int left, top;
  };
  Place next_panel();
  void caption_under(Place panel, const std::string& first, const std::string& second);
  void draw_line(RgbaImage& panel, const CoastPicture& picture, double width, Rgba colour) const;
  void put_round(const RgbaImage& panel, Place place);
  void grow_to(int height);

  const FigureCoast& coast_;
  RgbaImage image_;
  int row_top_ = 0;
  int column_ = kColumns;
};

}  // namespace skerry::echo

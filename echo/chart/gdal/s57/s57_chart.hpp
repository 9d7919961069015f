// S57Chart: one cell of an electronic navigational chart.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "echo/chart/gdal/chart_sheet.hpp"
#include "echo/chart/gdal/coverage.hpp"

namespace skerry::echo {

// An S-57 edition 3.1 cell with its updates, read once into memory: about 100 bytes per vertex.
// See s57_land.hpp, s57_objects.hpp and s57_detail.hpp for the parts that become coast,
// objects, and depths and marks.  Positions are
// those of the file, to 1e-7 degrees; its heights are of its own vertical datum, which is taken as
// high water.  Not for navigation.
//
// Thread: load() from any thread.
class S57Chart final : public CoveredChart {
 public:
  // `file` ends in .000; updates .001, .002 ... lie beside it.  All bytes are checked before GDAL
  // gets them (cell_file.hpp).  Told in `warnings`: objects that cannot be used or are of no class
  // of the catalogue, updates that are missing, of another edition, damaged, or do not fit what
  // they change; in the last three cases no update is applied at all, for a cell updated by half is
  // worse than an old one.
  //
  // Error: std::runtime_error naming the file and what is wrong where.
  static S57Chart open(const std::filesystem::path& file, std::vector<std::string>& warnings);

  CoastChart load(GeoPoint centre, Length radius) const override {
    return sheet_.window(centre, radius);
  }
  ChartDetail detail(GeoPoint centre, Length radius) const override {
    return sheet_.detail_window(centre, radius);
  }
  std::string describe() const override { return sheet_.source; }  // "ENC US5WA22M edition 40 ..."
  const Coverage& coverage() const override { return sheet_.coverage; }
  // Compilation scale 1 : scale(); 0 if not stated.
  int scale() const { return scale_; }
  const std::string& name() const { return name_; }  // "US5WA22M"

 private:
  S57Chart() = default;
  ChartSheet sheet_;
  std::string name_;
  int scale_ = 0;
};

}  // namespace skerry::echo

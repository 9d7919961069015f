// GshhgFile: one binned GSHHG shoreline file (netCDF), read bin by bin.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "echo/chart/gshhg_bin.hpp"
#include "echo/chart/gshhg_grid.hpp"

namespace skerry::echo {

// The index of the file (2 MB for the finest) is read and checked once, by the constructor; points
// only for the bins asked for.  Antarctica is bounded by its ice front, which is what a radar at
// sea sees: the grounding line under the ice (level 6) is left out.
//
// Format.  Source: Wessel and Smith (1996), and shore/gmt_shore of GMT, which defines it.
//   Bin b holds the segments [Id_of_first_segment_in_a_bin[b], + N_segments_in_a_bin[b]).
//   Segment s holds the points [Id_of_first_point_in_a_segment[s], + npts), and
//   Embedded_npts_levels_exit_entry_for_a_segment[s] = npts << 9 | level << 6 | entry << 3 | exit.
//   Embedded_ANT_flag[s] marks level 1 segments that are Antarctica's ice front and islands.
//   Embedded_node_levels_in_a_bin[b] = SW << 9 | SE << 6 | NE << 3 | NW, with the ice front as
//   coast; its twin with the suffix _ANT is for the grounding line.
//   Relative_{longitude,latitude}_from_SW_corner_of_bin: uint16 stored as int16, in bin/65535 (the
//   units attribute says degree/65535 in every file, which is true only of the finest).
//
// Thread: any; the netCDF library is not thread-safe, so all files share one lock.
class GshhgFile {
 public:
  // Error: std::runtime_error, naming the file, the variable, and what was found and expected.
  explicit GshhgFile(std::filesystem::path path);
  ~GshhgFile();
  GshhgFile(const GshhgFile&) = delete;
  GshhgFile& operator=(const GshhgFile&) = delete;

  const GshhgGrid& grid() const { return grid_; }
  const std::filesystem::path& path() const { return path_; }
  std::string source() const { return source_; }  // "GSHHG 2.3.7 full"

  // The shoreline of the run's bins, west to east.  Error: std::runtime_error as above.
  std::vector<BinShore> read(BinRun run) const;

 private:
  [[noreturn]] void fail(const std::string& variable, const std::string& what) const;
  int find_variable(const char* name, int type, std::size_t* length) const;
  template <typename T>
  std::vector<T> read_all(const char* name, int type, std::size_t length) const;
  std::vector<std::uint16_t> read_points(const char* name, std::size_t first,
                                         std::size_t count) const;
  GshhgGrid read_grid() const;
  std::string read_source() const;
  void read_index();
  void check_index() const;
  std::size_t segment_end(int bin) const {
    return static_cast<std::size_t>(first_segment_[bin]) +
           static_cast<std::size_t>(segment_count_[bin]);
  }

  std::filesystem::path path_;
  int netcdf_id_ = -1;
  GshhgGrid grid_;
  std::string source_;
  std::size_t point_count_ = 0;
  std::vector<std::int32_t> first_segment_;  // per bin
  std::vector<std::int16_t> segment_count_;  // per bin
  std::vector<std::int16_t> corner_levels_;  // per bin, packed
  std::vector<std::int32_t> segment_info_;   // per segment, packed
  std::vector<std::int32_t> first_point_;    // per segment
  std::vector<std::int8_t> antarctic_;       // per segment
};

}  // namespace skerry::echo

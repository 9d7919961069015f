#include "echo/chart/gshhg_file.hpp"

#include <fmt/core.h>
#include <netcdf.h>

#include <algorithm>
#include <mutex>
#include <stdexcept>

namespace skerry::echo {
namespace {

constexpr const char* kBinSize = "Bin_size_in_minutes";
constexpr const char* kFirstSegment = "Id_of_first_segment_in_a_bin";
constexpr const char* kSegmentCount = "N_segments_in_a_bin";
constexpr const char* kCornerLevels = "Embedded_node_levels_in_a_bin";
constexpr const char* kSegmentInfo = "Embedded_npts_levels_exit_entry_for_a_segment";
constexpr const char* kFirstPoint = "Id_of_first_point_in_a_segment";
constexpr const char* kAntarctic = "Embedded_ANT_flag";
constexpr const char* kLongitudes = "Relative_longitude_from_SW_corner_of_bin";
constexpr const char* kLatitudes = "Relative_latitude_from_SW_corner_of_bin";

// Bounds on what a file may make this program allocate, ten times what the finest file holds.
constexpr std::size_t kMostSegments = 3'000'000;
constexpr std::size_t kMostPoints = 120'000'000;
constexpr int kLeastBinMinutes = 30;

constexpr std::uint8_t kGroundingLine = 6;

// A window reads each chunk (64 KB) of the points at most a few times: a small cache will do.
// netCDF's own is 16 MB a variable.
constexpr std::size_t kPointCacheBytes = 1 << 20;

std::mutex& netcdf_lock() {
  static std::mutex lock;
  return lock;
}

std::uint32_t as_bits(std::int32_t info) { return static_cast<std::uint32_t>(info); }
std::size_t point_count_of(std::int32_t info) { return as_bits(info) >> 9; }
std::uint8_t octal(std::uint32_t packed, int digit) {
  return static_cast<std::uint8_t>((packed >> (3 * digit)) & 7u);
}

std::string type_name(int type) {
  return type == NC_INT ? "int" : type == NC_SHORT ? "short" : "byte";
}

std::string detail_name(int bin_minutes) {
  switch (bin_minutes) {
    case 60:
      return "full";
    case 120:
      return "high";
    case 300:
      return "intermediate";
    case 600:
      return "low";
    case 1200:
      return "crude";
    default:
      return fmt::format("{}' bins", bin_minutes);
  }
}

// Closes the file again if its constructor throws.
struct OpenFile {
  int id = -1;
  ~OpenFile() {
    if (id >= 0) nc_close(id);
  }
  void release() { id = -1; }
};

}  // namespace

void GshhgFile::fail(const std::string& variable, const std::string& what) const {
  throw std::runtime_error(
      fmt::format("chart file {}: {}: {}; the file is damaged or not a binned GSHHG 2.3 shoreline",
                  path_.string(), variable, what));
}

GshhgFile::GshhgFile(std::filesystem::path path) : path_(std::move(path)), grid_(60) {
  const std::lock_guard lock(netcdf_lock());
  if (const int status = nc_open(path_.c_str(), NC_NOWRITE, &netcdf_id_); status != NC_NOERR)
    throw std::runtime_error(fmt::format("chart file {}: cannot open it as netCDF: {}",
                                         path_.string(), nc_strerror(status)));
  OpenFile open{netcdf_id_};
  grid_ = read_grid();
  source_ = read_source();
  read_index();
  check_index();
  open.release();
}

GshhgFile::~GshhgFile() {
  const std::lock_guard lock(netcdf_lock());
  nc_close(netcdf_id_);
}

int GshhgFile::find_variable(const char* name, int type, std::size_t* length) const {
  int variable = -1, dimensions = 0, dimension = -1;
  nc_type found = NC_NAT;
  if (nc_inq_varid(netcdf_id_, name, &variable) != NC_NOERR)
    fail(name, "there is no such variable");
  if (nc_inq_vartype(netcdf_id_, variable, &found) != NC_NOERR || found != type)
    fail(name, "is not of type " + type_name(type));
  if (nc_inq_varndims(netcdf_id_, variable, &dimensions) != NC_NOERR || dimensions != 1)
    fail(name, fmt::format("has {} dimensions instead of 1", dimensions));
  if (nc_inq_vardimid(netcdf_id_, variable, &dimension) != NC_NOERR ||
      nc_inq_dimlen(netcdf_id_, dimension, length) != NC_NOERR)
    fail(name, "has no length");
  return variable;
}

template <typename T>
std::vector<T> GshhgFile::read_all(const char* name, int type, std::size_t length) const {
  std::size_t found = 0;
  const int variable = find_variable(name, type, &found);
  if (found != length) fail(name, fmt::format("has {} values instead of {}", found, length));
  std::vector<T> values(length);
  if (const int status = nc_get_var(netcdf_id_, variable, values.data()); status != NC_NOERR)
    fail(name, nc_strerror(status));
  return values;
}

GshhgGrid GshhgFile::read_grid() const {
  const std::int32_t minutes = read_all<std::int32_t>(kBinSize, NC_INT, 1).front();
  if (minutes < kLeastBinMinutes || (180 * 60) % minutes != 0)
    fail(kBinSize, fmt::format("is {}, expected {} or more and a divisor of {}", minutes,
                               kLeastBinMinutes, 180 * 60));
  return GshhgGrid(minutes);
}

std::string GshhgFile::read_source() const {
  std::size_t length = 0;
  std::string version;
  if (nc_inq_attlen(netcdf_id_, NC_GLOBAL, "version", &length) == NC_NOERR && length < 64) {
    version.resize(length);
    if (nc_get_att_text(netcdf_id_, NC_GLOBAL, "version", version.data()) != NC_NOERR)
      version.clear();
  }
  while (!version.empty() && version.back() == '\0') version.pop_back();
  return fmt::format("GSHHG {} {}", version, detail_name(grid_.bin_minutes()));
}

void GshhgFile::read_index() {
  const auto bins = static_cast<std::size_t>(grid_.bin_count());
  first_segment_ = read_all<std::int32_t>(kFirstSegment, NC_INT, bins);
  segment_count_ = read_all<std::int16_t>(kSegmentCount, NC_SHORT, bins);
  corner_levels_ = read_all<std::int16_t>(kCornerLevels, NC_SHORT, bins);

  std::size_t segments = 0, latitudes = 0;
  find_variable(kSegmentInfo, NC_INT, &segments);
  if (segments > kMostSegments)
    fail(kSegmentInfo,
         fmt::format("has {} values, at most {} are accepted", segments, kMostSegments));
  segment_info_ = read_all<std::int32_t>(kSegmentInfo, NC_INT, segments);
  first_point_ = read_all<std::int32_t>(kFirstPoint, NC_INT, segments);
  antarctic_ = read_all<std::int8_t>(kAntarctic, NC_BYTE, segments);

  const int x = find_variable(kLongitudes, NC_SHORT, &point_count_);
  const int y = find_variable(kLatitudes, NC_SHORT, &latitudes);
  if (point_count_ > kMostPoints)
    fail(kLongitudes,
         fmt::format("has {} values, at most {} are accepted", point_count_, kMostPoints));
  if (latitudes != point_count_)
    fail(kLatitudes, fmt::format("has {} values instead of {}", latitudes, point_count_));
  for (const int variable : {x, y})
    nc_set_var_chunk_cache(netcdf_id_, variable, kPointCacheBytes, 101, 0.75f);
}

void GshhgFile::check_index() const {
  std::size_t next_segment = 0;
  for (int bin = 0; bin < grid_.bin_count(); ++bin) {
    if (segment_count_[bin] < 0)
      fail(kSegmentCount, fmt::format("bin {} has {} segments", bin, segment_count_[bin]));
    if (segment_count_[bin] == 0) continue;
    if (first_segment_[bin] < 0 || static_cast<std::size_t>(first_segment_[bin]) != next_segment)
      fail(kFirstSegment, fmt::format("bin {} begins with segment {} instead of {}", bin,
                                      first_segment_[bin], next_segment));
    next_segment = segment_end(bin);
  }
  if (next_segment != segment_info_.size())
    fail(kSegmentCount,
         fmt::format("the bins hold {} segments, the file {}", next_segment, segment_info_.size()));
  std::size_t next_point = 0;
  for (std::size_t s = 0; s < segment_info_.size(); ++s) {
    if (first_point_[s] < 0 || static_cast<std::size_t>(first_point_[s]) != next_point)
      fail(kFirstPoint, fmt::format("segment {} begins with point {} instead of {}", s,
                                    first_point_[s], next_point));
    next_point += point_count_of(segment_info_[s]);
  }
  if (next_point != point_count_)
    fail(kSegmentInfo,
         fmt::format("the segments hold {} points, the file {}", next_point, point_count_));
}

std::vector<std::uint16_t> GshhgFile::read_points(const char* name, std::size_t first,
                                                  std::size_t count) const {
  std::vector<std::uint16_t> values(count);
  std::size_t length = 0;
  const int variable = find_variable(name, NC_SHORT, &length);
  // nc_get_vara takes the 16 bits as they are; they are unsigned (see the class).
  if (const int status = nc_get_vara(netcdf_id_, variable, &first, &count, values.data());
      status != NC_NOERR)
    fail(name, fmt::format("values {} to {}: {}", first, first + count, nc_strerror(status)));
  return values;
}

std::vector<BinShore> GshhgFile::read(BinRun run) const {
  std::vector<BinShore> shores;
  std::size_t first_segment = segment_info_.size(), last_segment = 0;
  for (int bin = run.first; bin < run.first + run.count; ++bin) {
    if (segment_count_[bin] == 0) continue;
    first_segment = std::min(first_segment, static_cast<std::size_t>(first_segment_[bin]));
    last_segment = segment_end(bin);
  }
  std::vector<std::uint16_t> x, y;
  std::size_t first_point = 0;
  if (last_segment > first_segment) {
    first_point = static_cast<std::size_t>(first_point_[first_segment]);
    const std::size_t count = static_cast<std::size_t>(first_point_[last_segment - 1]) +
                              point_count_of(segment_info_[last_segment - 1]) - first_point;
    const std::lock_guard lock(netcdf_lock());
    x = read_points(kLongitudes, first_point, count);
    y = read_points(kLatitudes, first_point, count);
  }
  for (int bin = run.first; bin < run.first + run.count; ++bin) {
    BinShore shore;
    shore.bin = bin;
    for (int k = 0; k < 4; ++k)
      shore.corner_levels[k] = octal(static_cast<std::uint16_t>(corner_levels_[bin]), 3 - k);
    const std::size_t begin = segment_count_[bin] == 0 ? 0 : first_segment_[bin];
    const std::size_t end = segment_count_[bin] == 0 ? 0 : segment_end(bin);
    for (std::size_t s = begin; s < end; ++s) {
      ShoreSegment segment;
      const std::uint32_t info = as_bits(segment_info_[s]);
      segment.level = octal(info, 2);
      if (segment.level == kGroundingLine) continue;
      if (segment.level == 1 && antarctic_[s] != 0) segment.level = kIceFront;
      segment.entry = octal(info, 1);
      segment.exit = octal(info, 0);
      const std::size_t from = static_cast<std::size_t>(first_point_[s]) - first_point;
      for (std::size_t i = from; i < from + point_count_of(segment_info_[s]); ++i)
        segment.points.push_back({x[i], y[i]});
      shore.segments.push_back(std::move(segment));
    }
    shores.push_back(std::move(shore));
  }
  return shores;
}

}  // namespace skerry::echo

// ChartSheet: a whole chart in memory, of which windows are handed out.
#pragma once

#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

#include "echo/chart/chart_detail.hpp"
#include "echo/chart/coast_chart.hpp"
#include "echo/chart/gdal/coverage.hpp"

namespace skerry::echo {

// Bounds on what is kept of one chart.
inline constexpr std::size_t kMostVertices = 8'000'000;
inline constexpr std::size_t kMostOutlineVertices = 200'000;  // of all objects, each at least one
inline constexpr std::size_t kMostContourVertices = 4'000'000;
inline constexpr std::size_t kMostMarks = 100'000;
inline constexpr std::size_t kMostShores = 65'535;

// Coordinates of these charts are multiples of 1e-7 degrees (1.1 cm), or are named by the nearest.
inline constexpr double kStepsPerDegree = 1e7;

// The identity of a place: the same wherever it is met.
std::uint64_t identity_of(GeoPoint place);

// The index of `shore` in `shores`, appended if new; that of Shore{} when the table is full.
class ShoreTable {
 public:
  explicit ShoreTable(std::vector<Shore>& shores);
  std::uint16_t index_of(const Shore& shore);

 private:
  std::vector<Shore>& shores_;
  std::unordered_map<std::uint64_t, std::uint16_t> known_;
};

class ChartSheet {
 public:
  std::string source;
  Coverage coverage;
  std::vector<CoastRing> rings;
  std::vector<Shore> shores;
  std::vector<ChartObject> objects;
  std::vector<CoverArea> covers;
  std::vector<DepthContour> contours;
  std::vector<ChartMark> marks;

  // To be called once all is in.  Puts covers in order: the larger an area's box, the lower it
  // lies.
  void index();
  // All rings, objects and covers of which any part is within the window, whole.
  // Error: std::invalid_argument for a centre off the globe or a radius below 0.
  CoastChart window(GeoPoint centre, Length radius) const;
  // The same of contours and marks.
  ChartDetail detail_window(GeoPoint centre, Length radius) const;

 private:
  std::vector<GeoBox> ring_boxes_, object_boxes_, cover_boxes_, contour_boxes_;
};

// An edge by the identities of its ends, either way round.
struct EdgeName {
  std::uint64_t low = 0, high = 0;
  EdgeName(std::uint64_t a, std::uint64_t b) : low(a < b ? a : b), high(a < b ? b : a) {}
  friend bool operator==(const EdgeName&, const EdgeName&) = default;
};
struct EdgeNameHash {
  std::size_t operator()(const EdgeName& name) const {
    return static_cast<std::size_t>(name.low * 0x9E3779B97F4A7C15ull ^ name.high);
  }
};

}  // namespace skerry::echo

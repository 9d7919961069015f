// BlobBuilder: runs of rows that touch, joined into blobs while the turn goes on.
#pragma once

#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "server/plotter/plots/local_threshold.hpp"
#include "server/plotter/plots/video_row.hpp"

namespace skerry::server {

// A cell of a blob.  Rows count from the blob's first.
struct BlobCell {
  std::uint16_t row = 0, cell = 0;
  std::uint8_t level = 0;
  std::uint8_t over = 0;  // levels over the threshold, at least 1
};

// Where a row of a blob lies.
struct BlobRow {
  TrueBearing bearing;
  GeoPoint own_ship;
  ScenarioTime time{};
  UtcTime utc{};
};

struct Blob {
  std::vector<BlobRow> rows;    // from the first to the last
  std::vector<BlobCell> cells;  // by row, then by cell
  double row_width_rad = 0.0, cell_m = 0.0;
  // A piece of what has more rows or cells than a ship can have.
  bool extended = false;
  // Video is missing beside it: it may be a part of an echo.
  bool cut = false;
};

// Runs of consecutive rows join if they overlap or touch at a corner (eight neighbours).  A blob
// ends with the first row that adds nothing to it, so it is known one row after the beam has passed
// it, and a turn has no seam, at north or elsewhere.
//
// Bounds: a blob of kMostRows or kMostCells ends as a piece, extended, and so are all pieces that
// go on from it.  With kMostOpen blobs open, runs that belong to none are left out and counted.
//
// Thread: one at a time.
class BlobBuilder {
 public:
  static constexpr std::size_t kMostRows = 256, kMostCells = 8192, kMostOpen = 2048;

  // Blobs of fewer are noise and not told; pieces of larger ones are.
  struct Least {
    std::size_t cells = 1, rows = 1;
  };
  BlobBuilder() = default;
  explicit BlobBuilder(const Least& least) : least_(least) {}

  // Appends the blobs that end before this row.  `runs` and `thresholds` are those of
  // LocalThreshold::find() for it.
  void add(const VideoRow& row, std::span<const Run> runs, std::span<const std::uint8_t> thresholds,
           std::vector<Blob>& out);
  // Takes the memory of blobs that are done with, for the next ones.
  void give_back(std::vector<Blob>& blobs);
  // All that is open ends here, cut.
  void flush(std::vector<Blob>& out);

  std::uint64_t left_out() const { return left_out_; }

 private:
  struct Open {
    std::vector<BlobCell> cells;  // their rows count from `first`
    std::uint64_t first = 0;      // rows are numbered as they come
    std::uint64_t last = 0;       // that added to it
    bool extended = false, cut = false, used = false;
    bool joined = false;  // of several: its cells are perhaps in no order
  };
  struct OwnedRun {
    Run run;
    std::size_t open = 0;
  };

  std::size_t owner_of(const Run& run, std::vector<Blob>& out);
  std::size_t take_free();
  void join(std::size_t into, std::size_t from, std::vector<Blob>& out);
  void put(Open& open, const VideoRow& row, const Run& run,
           std::span<const std::uint8_t> thresholds, std::vector<Blob>& out);
  // Appends what it has, unless that is nothing or too little.
  void cut_off(Open& open, std::vector<Blob>& out);
  // By row, then by cell.
  void put_in_order(std::vector<BlobCell>& cells);
  void end(std::size_t open, std::vector<Blob>& out);

  Least least_;
  std::vector<Open> open_;
  std::vector<std::size_t> free_;
  std::vector<Blob> spare_;
  std::vector<BlobCell> ordered_;
  std::vector<OwnedRun> before_, now_;
  std::size_t from_ = 0;      // of before_: those before it end nearer than all runs that come
  std::deque<BlobRow> rows_;  // the last kMostRows + 1
  std::uint64_t oldest_ = 0;  // number of the first of them
  std::uint64_t next_ = 0;    // number of the row that comes
  double row_width_rad_ = 0.0, cell_m_ = 0.0;
  std::uint64_t left_out_ = 0;
};

}  // namespace skerry::server

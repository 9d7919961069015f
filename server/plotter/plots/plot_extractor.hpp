// PlotExtractor: spokes of a radar in, plots out, while the turn goes on.
#pragma once

#include <cstdint>
#include <vector>

#include "protocol/video/spoke.hpp"
#include "server/plotter/plots/blob_builder.hpp"
#include "server/plotter/plots/blob_split.hpp"
#include "server/plotter/plots/land_map.hpp"
#include "server/plotter/plots/local_threshold.hpp"
#include "server/plotter/plots/plot.hpp"
#include "server/plotter/plots/pulse_length.hpp"
#include "server/plotter/plots/video_row.hpp"

namespace skerry::server {

// Knows nothing of a radar but its spokes, of whichever source.  The same spokes give the same
// plots, bit for bit, on every machine.
//
// Thread: one at a time.
class PlotExtractor {
 public:
  struct Rule {
    RowMaker::Grain grain;
    LocalThreshold::Rule threshold;
    // What the set adds to an echo: deducted from its size, and the scale of its errors.
    double beam_deg = 1.2;  // 0.1 to 10; between its points of -3 dB, one way
    double pulse_m = 0.0;   // 0 to 500; 0: learnt from the echoes (pulse_length.hpp)
    double levels_per_db =
        4.0;  // of the video, 0.5 to 20: a strong point is seen by more than the beam
    // Fewer cells of rows, a single row, or an echo narrower than this share of the beam, is noise
    // or interference: what one pulse smears over several cells of a row is not in the next one.
    std::uint32_t least_cells = 3;
    double least_width = 0.5;
    // Longer or wider than this, after the deduction, is land or rain: an extended plot.
    double most_size_m = 500.0;
    double valley = 0.6;  // of echoes that lie together (blob_split.hpp)
    // Where plots come and go, a plot must stand farther over the threshold (land_map.hpp).
    bool bars = true;
  };
  PlotExtractor() : PlotExtractor(Rule{}) {}
  // Errors: std::invalid_argument, says which value is out of its range.
  explicit PlotExtractor(const Rule& rule);

  // Appends the plots that this spoke completes: those which the beam passed a row or two ago.
  // True if it completes a row, which is row() then.
  bool add(const Spoke& spoke, std::vector<Plot>& out);
  // Those of what has come so far; the spokes stop here.
  bool flush(std::vector<Plot>& out);
  const VideoRow& row() const { return rows_.row(); }

  struct Counts {
    std::uint64_t rows = 0, runs = 0, blobs = 0, plots = 0;
    std::uint64_t in_clutter = 0;  // plots below a bar: not told, and not among the above
    std::uint64_t spokes_left_out = 0, runs_left_out = 0;
  };
  Counts counts() const;

 private:
  struct Shape;

  void take_row(std::vector<Plot>& out);
  void take_blobs(std::vector<Plot>& out);
  // Makes a plot of cells of a blob, unless they are too little or below a bar.  `only_below`: does
  // nothing if it would tell one, and says so by false.
  // `whole` is the shape of all of the blob.
  bool take(const Blob& blob, const std::vector<BlobCell>& cells, const Shape& shape,
            const Shape& whole, bool only_below, std::vector<Plot>& out);
  Plot plot_of(const Blob& blob, const Shape& shape, const Shape& whole);
  void add_echo(const Blob& blob, const std::vector<BlobCell>& cells, bool extended);

  Rule rule_;
  double beam_rad_;
  PulseLength pulse_;
  double turns_ = 0.0;  // that the rows so far make
  RowMaker rows_;
  LocalThreshold threshold_;
  BlobBuilder builder_;
  LandMap land_;
  std::vector<Run> runs_;
  std::vector<Blob> blobs_;
  SplitScratch scratch_;
  Counts counts_;
};

}  // namespace skerry::server

// RadarFaults: what a set that is not well shows.
#pragma once

#include <cstdint>
#include <span>

#include "echo/radar/radar_model.hpp"

namespace skerry::echo {

// 0, false: none.  Without faults not one bit of a row changes.
struct RadarFaults {
  double power_loss_db = 0.0;    // transmitted power: on all echoes of the own pulse; 0 to 60
  double detuned_db = 0.0;       // besides the tune control: on echoes and racons; 0 to 60
  double noise_db = 0.0;         // added to the noise figure; 0 to 30
  double range_error_m = 0.0;    // all that is received lies so much farther; -1000 to 1000
  double blind_from_deg = 0.0;   // clockwise from the bow ...
  double blind_width_deg = 0.0;  // ... where nothing is received but the receiver's own noise
  bool trigger_lost = false;     // nothing is received anywhere
  friend bool operator==(const RadarFaults&, const RadarFaults&) = default;
};

// The faults on rows of power over noise.  Thread: set() the radar's; the rest any.
class FaultyReceiver {
 public:
  // Of the model's cells.
  void set(const RadarFaults& faults, double cell_m);
  const RadarFaults& faults() const { return faults_; }

  // Power factors: of echoes, and of what the tune acts on besides.
  float power_factor() const { return power_factor_; }
  float tune_factor() const { return tune_factor_; }

  // Whether there is anything for apply() to do.
  bool acts() const { return acts_; }
  // Row operation after all others.  The shift along range is linear between neighbouring cells: an
  // echo's centroid moves by it to rounding, and an echo becomes wider by a cell at most.  What is
  // shifted out of the row is gone, and nothing comes after it; see row_cells_for_error().
  // `closing`: speeds beside the row, or empty; they move by whole cells.
  void apply(std::uint32_t relative_units, std::span<float> row, std::span<float> closing) const;

 private:
  bool is_blind(std::uint32_t relative_units) const;

  RadarFaults faults_;
  float power_factor_ = 1.0f, tune_factor_ = 1.0f, noise_factor_ = 1.0f;
  std::uint32_t blind_from_units_ = 0, blind_width_units_ = 0;
  bool is_blind_ = false, acts_ = false;
  std::int64_t shift_cells_ = 0;  // rounded down
  float shift_part_ = 0.0f;       // the rest, [0, 1)
};

// Rows of `cells` cells made longer, in quarters of the geometry's, so that a negative range error
// finds what it brings nearer; at most twice the geometry's cells, as far as rows go.
std::uint32_t row_cells_for_error(const ScanGeometry& geometry, RangeScale scale,
                                  std::uint32_t cells, double range_error_m);

}  // namespace skerry::echo

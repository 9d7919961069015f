// The controls of a Quantum radar on those of a view: commands into Sets, settings into a status.
#pragma once

#include <cstdint>
#include <optional>

#include "protocol/raymarine/quantum_command.hpp"
#include "protocol/raymarine/quantum_report.hpp"
#include "protocol/wire/radar.pb.h"
#include "server/displays/display_range.hpp"

namespace skerry::server {

// A Quantum's mode is four sets of controls of which one is in use: choosing another sets gain, sea
// and rain of the view to what that mode had.  Colour gain and the suppression of the main bang
// have no counterpart here; they are kept and reported.  Thread: one at a time.
class QuantumControls {
 public:
  QuantumControls();

  // The command as a Set; empty if it only changes a value that is remembered here.
  std::optional<wire::Set> set_of(const raymarine::QuantumCommand& command,
                                  const wire::Settings& now) const;
  // The command took effect; `after` is what came of it.
  void accept(const raymarine::QuantumCommand& command, const wire::Settings& after);
  // The settings changed, by whomever.
  void observe(const wire::Settings& now);

  raymarine::QuantumStatus status(const wire::Settings& now) const;

  const DisplayRanges& ranges() const { return ranges_; }
  double range_m(const wire::Settings& now) const;

 private:
  raymarine::QuantumModeControls& in_use() { return controls_[static_cast<std::size_t>(mode_)]; }
  const raymarine::QuantumModeControls& in_use() const {
    return controls_[static_cast<std::size_t>(mode_)];
  }

  DisplayRanges ranges_;
  Remembered<double> range_;  // by range scale, NM
  Remembered<std::int32_t> rejection_, expansion_, bearing_;
  raymarine::QuantumMode mode_ = raymarine::QuantumMode::harbour;
  std::array<raymarine::QuantumModeControls, raymarine::kQuantumModes> controls_;
};

}  // namespace skerry::server

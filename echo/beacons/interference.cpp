#include "echo/beacons/interference.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "echo/beacons/listening.hpp"
#include "echo/kernel/exact_math.hpp"
#include "echo/radar/beam.hpp"
#include "protocol/quantity/bearing.hpp"
#include "protocol/quantity/plane_geometry.hpp"

namespace skerry::echo {
namespace {

constexpr auto kSecond = static_cast<double>(PulseTrain::kSecond);
constexpr float kLeastShown = 1e-4f;  // of the noise: a null of the own pattern

// The cosine taper's main lobe over bearing in beam widths, to its first null.
class MainLobe {
 public:
  static constexpr double kEnd = 1.25;
  MainLobe() {
    for (std::size_t i = 0; i < table_.size(); ++i) {
      // For a beam so narrow that sine and angle agree.
      const double voltage =
          cosine_taper_voltage(static_cast<double>(i) * kEnd / kSteps * 0.01, 0.01);
      table_[i] = static_cast<float>(voltage * voltage);
    }
  }
  float at(double beam_widths) const {
    if (beam_widths >= kEnd) return 0.0f;
    const double x = beam_widths * (kSteps / kEnd);
    const auto i = static_cast<std::size_t>(x);
    const auto part = static_cast<float>(x - static_cast<double>(i));
    return table_[i] + part * (table_[i + 1] - table_[i]);
  }

 private:
  static constexpr double kSteps = 125.0;
  std::array<float, 127> table_;
};

}  // namespace

double frequency_coupling(const Emitter& emitter, double own_frequency_hz, double bandwidth_hz) {
  const double off = std::fabs(emitter.frequency_hz - own_frequency_hz);
  if (off > kOtherBand) return 0.0;
  const double beyond = std::max(0.0, off - 0.5 * bandwidth_hz);
  const double x = std::numbers::pi * emitter.pulse_s * beyond;
  const double filled = std::min(1.0, bandwidth_hz * emitter.pulse_s);
  return filled * filled / (1.0 + x * x);
}

float emitter_beam(std::uint32_t off_units, double beam_width_deg, float side_lobe) {
  static const MainLobe kMain;
  const std::uint32_t off = units_apart(off_units, 0);
  const double widths = off * kDegreesPerUnit / beam_width_deg;
  const double part = widths - std::floor(widths);
  const float lobes = side_lobe * static_cast<float>(4.0 * part * (1.0 - part));
  return std::max(kMain.at(widths), lobes);
}

Interference::Interference(const RadarModel& model)
    : own_period_ps_(PulseTrain(model.pulse.prf_hz, model.radar).period_ps()) {}

void Interference::list_own_pulses(const RadarModel& model, std::uint64_t first,
                                   std::uint64_t last) {
  pulses_.clear();
  begins_ = model.clock.time_of(first);
  const PulseTrain own(model.pulse.prf_hz, model.radar);
  std::int64_t at = own.wait_ps(begins_);
  for (std::uint64_t spoke = first; spoke <= last; ++spoke) {
    const std::int64_t end = (model.clock.time_of(spoke + 1) - begins_).count() * 1000;
    for (; at < end; at += own_period_ps_)
      pulses_.push_back({at, static_cast<std::uint32_t>(spoke - first)});
  }
}

void Interference::know_stations(const Listening& at) {
  const auto step = static_cast<std::int64_t>(std::floor(at.dt() / kFixEvery));
  since_fix_ = at.dt() - static_cast<double>(step) * kFixEvery;
  const Fix fix{at.scene.time, at.scene.own_ship, at.scene.own_velocity, step};
  const bool known = known_ == at.scene.emitters;
  if (known && fix == fix_) return;
  fix_ = fix;
  if (!known) {
    known_ = at.scene.emitters;
    stations_.clear();
    const Pulse& pulse = at.model.pulse;
    for (const Emitter& emitter : known_) {
      const double eirp = emitter.power_w * ratio_from_decibels(emitter.antenna_gain_db);
      const double coupling =
          frequency_coupling(emitter, at.model.set.frequency_hz, pulse.bandwidth_hz);
      const double length = std::max(emitter.pulse_s, 1.0 / pulse.bandwidth_hz);
      stations_.push_back({PulseTrain(emitter.prf_hz, emitter.identity),
                           at.link.received_at_1m(eirp) * coupling,
                           emitter.rpm / 60.0 * kUnitsPerTurn / kSecond,
                           static_cast<float>(ratio_from_decibels(emitter.side_lobe_db)),
                           static_cast<float>(length * 0.5 * kLightSpeed / at.model.cell_m)});
    }
  }
  fix_stations(at);
}

void Interference::fix_stations(const Listening& at) {
  const double dt = static_cast<double>(fix_.step) * kFixEvery;
  for (std::size_t i = 0; i < stations_.size(); ++i) {
    const Emitter& emitter = known_[i];
    Station& station = stations_[i];
    station.power = 0.0;
    if (station.power_1m <= 0.0) continue;
    const PlanePoint speed = emitter.velocity - at.scene.own_velocity;
    const PlanePoint offset = emitter.place - at.scene.own_ship + speed * dt;
    station.place = polar_of(offset);
    const double range = std::max(station.place.range_m, OneWayLink::kNearest);
    station.range_rate = dot(speed, offset) / range;
    station.units_rate = cross(speed, offset) / (range * range) * (kUnitsPerTurn / kRadiansPerTurn);
    station.power = station.power_1m / (range * range) *
                    static_cast<double>(at.propagation.one_way(range, emitter.height_m));
    if (station.power >= kLeastHeard && at.behind_land(station.place, emitter.height_m))
      station.power *= kBehindLand;
  }
}

void Interference::hear(const Listening& at, const Emitter& emitter, const Station& station) {
  const double power = station.power;
  if (!(power >= kLeastHeard)) return;
  const Polar place{std::max(0.0, station.place.range_m + station.range_rate * since_fix_),
                    station.place.units + static_cast<std::uint32_t>(static_cast<std::int64_t>(
                                              station.units_rate * since_fix_))};
  const auto own_beam = static_cast<double>(at.bound.most(at.sector.off(place.units)));
  if (power * own_beam < kLeastHeard) return;
  const auto least = static_cast<float>(kLeastHeard / (power * own_beam));  // of its beam

  const std::int64_t period = station.train.period_ps();
  const std::int64_t back = own_period_ps_ % period;  // what the delay loses from pulse to pulse
  const auto way = static_cast<std::int64_t>(place.range_m / kLightSpeed * kSecond + 0.5);
  const double cells_per_ps = 0.5 * kLightSpeed / (at.model.cell_m * kSecond);
  const auto window = static_cast<std::int64_t>(at.model.geometry.cells / cells_per_ps);
  const std::uint32_t beam = beam_units(emitter.bearing_deg, emitter.rpm, begins_);
  const std::uint32_t towards = place.units + kUnitsPerHalfTurn;

  std::int64_t delay = (station.train.wait_ps(begins_) + way - pulses_.front().at_ps) % period;
  if (delay < 0) delay += period;
  for (const OwnPulse& pulse : pulses_) {
    for (std::int64_t heard = delay; heard < window; heard += period) {
      const double sent = static_cast<double>(pulse.at_ps + heard - way);
      const auto turned =
          static_cast<std::uint32_t>(static_cast<std::int64_t>(sent * station.turn_per_ps));
      const float gain =
          emitter_beam(towards - (beam + turned), emitter.beam_width_deg, station.side_lobe);
      if (gain < least) continue;
      if (made_.size() >= kMostDots) return;
      const double heard_power = std::min(power * static_cast<double>(gain), kMostHeard);
      made_.push_back({place.units, static_cast<float>(heard_power),
                       static_cast<float>(static_cast<double>(heard) * cells_per_ps), station.cells,
                       pulse.spoke});
    }
    delay -= back;
    if (delay < 0) delay += period;
  }
}

void Interference::sort_by_spoke(std::size_t spokes) {
  starts_.assign(spokes + 1, 0);
  for (const Dot& dot : made_) ++starts_[dot.spoke + 1];
  for (std::size_t k = 0; k < spokes; ++k) starts_[k + 1] += starts_[k];
  dots_.resize(made_.size());
  for (const Dot& dot : made_) dots_[starts_[dot.spoke]++] = dot;
  for (std::size_t k = spokes; k > 0; --k) starts_[k] = starts_[k - 1];
  starts_[0] = 0;
}

void Interference::prepare(const Listening& at, std::uint64_t first, std::uint64_t last) {
  dots_.clear();
  if (at.scene.emitters.empty() || !at.scene.artefacts.interference) return;
  list_own_pulses(at.model, first, last);
  if (pulses_.empty()) return;
  first_ = first;
  made_.clear();
  know_stations(at);
  for (std::size_t i = 0; i < stations_.size(); ++i) hear(at, known_[i], stations_[i]);
  sort_by_spoke(static_cast<std::size_t>(last - first + 1));
}

void Interference::add(const AntennaPattern& pattern, const SpokeAim& aim,
                       std::span<float> power) const {
  const std::uint64_t spoke = aim.spoke - first_;
  if (dots_.empty() || spoke + 1 >= starts_.size()) return;
  for (std::uint32_t i = starts_[spoke]; i < starts_[spoke + 1]; ++i) {
    const Dot& dot = dots_[i];
    const float value = dot.power * pattern.one_way(aim.plane_units - dot.bearing_units);
    if (value < kLeastShown) continue;
    const auto from = static_cast<double>(dot.from_cell);
    add_span(from, from + static_cast<double>(dot.cells), value, power);
  }
}

}  // namespace skerry::echo

#include "server/board/azimuth_generator.hpp"

#include <algorithm>
#include <cmath>

#include "echo/kernel/exact_math.hpp"
#include "echo/kernel/hash.hpp"
#include "protocol/quantity/angle.hpp"

namespace skerry::server {
namespace {

constexpr std::uint64_t kFaultEvery = 16;

// Share of the mean slowness whose wave lets the speed deviate by `ppm` of itself at most.
double slowness_of(std::uint32_t ppm) {
  const double speed = static_cast<double>(ppm) * 1e-6;
  return speed / (1.0 + speed);
}

double gust_strength(std::uint64_t seed, std::uint64_t turn) {
  return echo::as_unit(echo::mixed(seed, turn));
}

}  // namespace

AzimuthGenerator::AzimuthGenerator(const RotationSettings& settings) {
  settings_ = settings;
  set_origin({}, 0);
  if (settings.arp_error < 0) arp_turn_ = 1;
  find_next();
}

void AzimuthGenerator::set_origin(Azimuth azimuth, Tick now) {
  turn_numerator_ = static_cast<Wide>(settings_.clock_hz) * 60'000 << kFineBits;
  turn_denominator_ = settings_.milli_rpm;
  turn_ticks_ =
      static_cast<double>(settings_.clock_hz) * 60'000.0 / static_cast<double>(settings_.milli_rpm);
  wow_ = settings_.wow_per_turn == 0 ? 0.0 : slowness_of(settings_.wow_ppm);
  gust_ = slowness_of(settings_.gust_ppm);
  origin_ = 0;
  origin_ = fine_of(now) - fine_tick(azimuth);
}

void AzimuthGenerator::set(const RotationSettings& settings, Tick now, Tick new_now) {
  if (settings == settings_) return;
  const RotationSettings old = settings_;
  const Azimuth azimuth = at(now);
  const Tick still_stalled = stalled_until_ > now ? stalled_until_ - now : 0;
  stalled_at_.reset();
  settings_ = settings;
  set_origin(azimuth, new_now);
  if (settings.acp_per_turn != old.acp_per_turn) {
    const Wide acps = settings.acp_per_turn;
    const Wide part = (static_cast<Wide>(azimuth.fraction) * acps + ((Wide{1} << 64) - 1)) >> 64;
    half_acp_ = 2 * static_cast<std::uint64_t>(static_cast<Wide>(azimuth.turns) * acps + part);
  }
  if (settings.arp_error != old.arp_error) {
    arp_turn_ = azimuth.turns > 0 ? azimuth.turns - 1 : 0;
    while (arp().numerator < 0 || nearest_tick(fine_tick(arp())) < new_now) ++arp_turn_;
  }
  const auto in_new_clock = [&](Tick ticks) {
    return static_cast<Tick>(static_cast<Wide>(ticks) * settings.clock_hz / old.clock_hz);
  };
  faults_.stall = in_new_clock(faults_.stall);
  stalled_until_ = stalled_from_ = 0;
  if (still_stalled > 0) {
    stalled_from_ = new_now;
    stalled_until_ = new_now + in_new_clock(still_stalled);
    origin_ += fine_of(stalled_until_ - stalled_from_);
  }
  earliest_ = new_now;
  find_next();
}

double AzimuthGenerator::displacement(std::uint64_t turn, double fraction) const {
  double ticks = 0.0;
  if (wow_ > 0.0) {
    const double waves = static_cast<double>(settings_.wow_per_turn);
    ticks -= wow_ / (kRadiansPerTurn * waves) * echo::sin_cos_degrees(360.0 * waves * fraction).sin;
  }
  if (gust_ > 0.0) {
    const double strength = gust_ * gust_strength(settings_.seed, turn);
    ticks += strength / kRadiansPerTurn * (echo::sin_cos_degrees(360.0 * fraction).cos - 1.0);
  }
  return ticks * turn_ticks_;
}

double AzimuthGenerator::displacement_slope(std::uint64_t turn, double fraction) const {
  double slope = 0.0;
  if (wow_ > 0.0) {
    const double waves = static_cast<double>(settings_.wow_per_turn);
    slope -= wow_ * echo::sin_cos_degrees(360.0 * waves * fraction).cos;
  }
  if (gust_ > 0.0) {
    const double strength = gust_ * gust_strength(settings_.seed, turn);
    slope -= strength * echo::sin_cos_degrees(360.0 * fraction).sin;
  }
  return slope;
}

Wide AzimuthGenerator::fine_tick(const Ratio& azimuth) const {
  Wide fine =
      origin_ + azimuth.numerator * turn_numerator_ / (azimuth.denominator * turn_denominator_);
  if (is_disturbed_in_speed() && azimuth.numerator >= 0) {
    const Wide turn = azimuth.numerator / azimuth.denominator;
    const auto rest = static_cast<double>(azimuth.numerator - turn * azimuth.denominator);
    const double ticks = displacement(static_cast<std::uint64_t>(turn),
                                      rest / static_cast<double>(azimuth.denominator));
    fine += static_cast<std::int64_t>(std::floor(ticks * (1 << kFineBits) + 0.5));
  }
  if (stalled_at_ && compare(azimuth, *stalled_at_) <= 0) fine -= stall_fine_;
  return fine;
}

Wide AzimuthGenerator::fine_tick(Azimuth azimuth) const {
  const Wide whole = static_cast<Wide>(azimuth.turns) * turn_numerator_;
  // 2^-64 turn is far below a fine tick.
  const Wide part = static_cast<Wide>(static_cast<unsigned __int128>(azimuth.fraction) *
                                          static_cast<unsigned __int128>(turn_numerator_) >>
                                      64);
  Wide fine = origin_ + (whole + part) / turn_denominator_;
  if (is_disturbed_in_speed()) {
    const double ticks = displacement(azimuth.turns, azimuth.fraction_of_turn());
    fine += static_cast<std::int64_t>(std::floor(ticks * (1 << kFineBits) + 0.5));
  }
  return fine;
}

Azimuth AzimuthGenerator::even_azimuth(Wide fine) const {
  const Wide scaled = (fine < 0 ? 0 : fine) * turn_denominator_;
  const Wide turns = scaled / turn_numerator_;
  const auto rest = static_cast<unsigned __int128>(scaled - turns * turn_numerator_);
  return {
      static_cast<std::uint64_t>(turns),
      static_cast<std::uint64_t>((rest << 64) / static_cast<unsigned __int128>(turn_numerator_))};
}

Azimuth AzimuthGenerator::at(Tick tick) const {
  // During a stall it points to where it will go on from.
  if (tick >= stalled_from_ && tick < stalled_until_) tick = stalled_until_;
  const Wide fine = fine_of(tick) - origin_ + (tick < stalled_from_ ? stall_fine_ : 0);
  if (!is_disturbed_in_speed()) return even_azimuth(fine);

  // Undisturbed it would be where it is `shift` fine ticks sooner.  Newton's method on shift =
  // displacement; its slope lies in (-1, 1), the bracket is that of a step of bisection.
  constexpr double kFine = 1 << kFineBits;
  const double widest = (wow_ + gust_) * turn_ticks_ * kFine;
  double low = -widest, high = widest, shift = 0.0;
  Azimuth azimuth;
  for (int i = 0; i < 60; ++i) {
    azimuth = even_azimuth(fine - static_cast<Wide>(std::floor(shift + 0.5)));
    const double miss =
        displacement(azimuth.turns, azimuth.fraction_of_turn()) * kFine - std::floor(shift + 0.5);
    if (miss > -1.0 && miss < 1.0) break;
    (miss > 0.0 ? low : high) = shift;
    const double slope = 1.0 + displacement_slope(azimuth.turns, azimuth.fraction_of_turn());
    double better = shift + miss / slope;
    if (!(better > low && better < high)) better = 0.5 * (low + high);
    shift = better;
  }
  return azimuth;
}

Tick AzimuthGenerator::first_tick(Azimuth azimuth) const {
  Tick tick = nearest_tick(fine_tick(azimuth));
  while (tick > 0 && at(tick - 1) >= azimuth) --tick;
  while (at(tick) < azimuth) ++tick;
  return tick;
}

void AzimuthGenerator::find_next() {
  const Ratio count = acp(), reference = arp(), bow = heading();
  const bool reference_first = compare(reference, bow) <= 0;
  const Ratio& other = reference_first ? reference : bow;
  if (compare(count, other) <= 0) {
    const bool extra = half_acp_ % 2 == 1;
    const bool out =
        !extra && faults_.missing_acp > 0 && (half_acp_ / 2) % kFaultEvery == kFaultEvery / 2;
    next_ = {nearest_tick(fine_tick(count)), AzimuthLine::acp, !out};
  } else if (reference_first) {
    next_ = {nearest_tick(fine_tick(reference)), AzimuthLine::arp, faults_.missing_arp == 0};
  } else {
    next_ = {nearest_tick(fine_tick(bow)), AzimuthLine::heading, true};
  }
  next_.tick = std::max(next_.tick, earliest_);
}

void AzimuthGenerator::pop() {
  earliest_ = next_.tick;
  switch (next_.line) {
    case AzimuthLine::acp: {
      if (!next_.sent) --faults_.missing_acp;
      const std::uint64_t number = half_acp_ / 2;
      if (half_acp_ % 2 == 1) {
        ++half_acp_;
        break;
      }
      if (faults_.stall > 0) {
        stalled_at_ = acp();
        stalled_from_ = next_.tick;
        stalled_until_ = next_.tick + faults_.stall;
        stall_fine_ = fine_of(faults_.stall);
        origin_ += stall_fine_;
        faults_.stall = 0;
      }
      const bool one_more = faults_.extra_acp > 0 && number % kFaultEvery == 0;
      if (one_more) --faults_.extra_acp;
      half_acp_ += one_more ? 1 : 2;
      break;
    }
    case AzimuthLine::arp:
      if (!next_.sent) --faults_.missing_arp;
      ++arp_turn_;
      break;
    case AzimuthLine::heading:
      ++heading_turn_;
      break;
  }
  find_next();
}

void AzimuthGenerator::inject(const AzimuthOrders& orders, Tick now) {
  faults_.missing_acp = orders.missing_acp.value_or(faults_.missing_acp);
  faults_.extra_acp = orders.extra_acp.value_or(faults_.extra_acp);
  faults_.missing_arp = orders.missing_arp.value_or(faults_.missing_arp);
  if (orders.stall && now < stalled_until_) {
    const Wide longer = fine_of(now + *orders.stall) - fine_of(stalled_until_);
    origin_ += longer;
    stall_fine_ += longer;
    stalled_until_ = now + *orders.stall;
    faults_.stall = 0;
  } else {
    faults_.stall = orders.stall.value_or(faults_.stall);
  }
  find_next();
}

void AzimuthGenerator::forget_faults() {
  faults_ = {};
  find_next();
}

AzimuthFaults AzimuthGenerator::left(Tick now) const {
  AzimuthFaults faults = faults_;
  if (now < stalled_until_) faults.stall += stalled_until_ - std::max(now, stalled_from_);
  return faults;
}

void AzimuthGenerator::skip_turns(std::uint64_t turns) {
  half_acp_ += 2 * turns * settings_.acp_per_turn;
  arp_turn_ += turns;
  heading_turn_ += turns;
  find_next();
}

}  // namespace skerry::server

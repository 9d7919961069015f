#include "server/board/trigger_generator.hpp"

#include <algorithm>

#include "echo/kernel/hash.hpp"

namespace skerry::server {
namespace {

constexpr std::uint64_t kParts = 1'000'000;

TickSeries series_of(const TriggerSettings& settings, Tick origin) {
  return {fine_of(origin), std::uint64_t{settings.clock_hz} * 1000, settings.prf_millihertz};
}

}  // namespace

void TriggerGenerator::lay(const TriggerSettings& settings, Tick origin) {
  settings_ = settings;
  series_ = series_of(settings, origin);
  jitter_ = series_.period() * settings.jitter_ppm / kParts;
  stagger_ = series_.period() * settings.stagger_ppm / kParts;
  index_ = 0;
  next_ = tick_of(0);
}

void TriggerGenerator::set(const TriggerSettings& settings, Tick now) {
  if (settings == settings_) return;
  // Ticks of another clock say nothing about the last trigger.
  if (settings.clock_hz != settings_.clock_hz) fired_ = false;
  lay(settings, fired_ ? std::max(now, last_ + series_of(settings, 0).period()) : now);
}

Tick TriggerGenerator::tick_of(std::uint64_t n) const {
  const Tick even = series_.at(n);
  if (jitter_ == 0 && stagger_ == 0) return even;
  const std::uint64_t random = echo::mixed(settings_.seed, even);
  const auto width = static_cast<unsigned __int128>(2 * jitter_ + 1);
  const auto shaken = static_cast<Tick>(random * width >> 64);  // 0 .. 2 jitter
  return even + shaken + (n % 2 == 0 ? 2 * stagger_ : 0);
}

std::uint64_t TriggerGenerator::first_from(Tick tick) const {
  // A trigger is displaced to later, by less than a period.
  std::uint64_t n = series_.first_from(tick);
  if (n > 0) --n;
  while (tick_of(n) < tick) ++n;
  return n;
}

std::uint64_t TriggerGenerator::skip_to(Tick tick) {
  if (next_ >= tick) return 0;
  const std::uint64_t from = index_;
  index_ = first_from(tick);
  next_ = tick_of(index_);
  last_ = tick_of(index_ - 1);
  fired_ = true;
  return index_ - from;
}

std::uint64_t TriggerGenerator::count(Tick from, Tick to) const {
  const std::uint64_t begin = std::max(first_from(from), index_);
  return std::max(first_from(to), begin) - begin;
}

}  // namespace skerry::server

#include "echo/receiver/doppler_colours.hpp"

#include <algorithm>
#include <cstddef>

namespace skerry::echo {
namespace {

constexpr float kLeastColoured = 1.0f;  // of the noise

void stretch_colours(unsigned reach, std::span<const std::uint8_t> video,
                     std::span<DopplerClass> colours) {
  const std::size_t n = colours.size();
  for (unsigned step = 0; step < reach; ++step) {
    DopplerClass before = DopplerClass::none;
    for (std::size_t i = 0; i < n; ++i) {
      const DopplerClass now = colours[i];
      const DopplerClass behind = i + 1 < n ? colours[i + 1] : DopplerClass::none;
      if (now == DopplerClass::none && video[i] > 0)
        colours[i] = before != DopplerClass::none ? before : behind;
      before = now;
    }
  }
}

}  // namespace

void lay_colours(const RowResampler& resampler, const ColourRule& rule,
                 std::span<const float> power, std::span<const float> closing,
                 std::span<const std::uint8_t> video, std::span<DopplerClass> colours) {
  std::fill(colours.begin(), colours.end(), DopplerClass::none);
  if (rule.mode == DopplerMode::off) return;
  const auto threshold = static_cast<float>(rule.threshold_mps);
  bool any = false;
  for (std::uint32_t i = 0; i < resampler.reach(); ++i) {
    if (video[i] == 0) continue;
    const RowResampler::Held held = resampler.held_by(i);
    std::size_t strongest = held.begin;
    for (std::size_t k = held.begin + 1; k < held.end; ++k) {
      if (power[k] > power[strongest]) strongest = k;
    }
    const float speed = closing[strongest];
    if (power[strongest] < kLeastColoured) continue;
    if (speed >= threshold) {
      colours[i] = DopplerClass::approaching;
    } else if (speed <= -threshold && rule.mode == DopplerMode::both) {
      colours[i] = DopplerClass::receding;
    }
    any = any || colours[i] != DopplerClass::none;
  }
  if (any) stretch_colours(rule.stretch, video, colours);
}

}  // namespace skerry::echo

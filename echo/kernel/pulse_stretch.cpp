#include "echo/kernel/pulse_stretch.hpp"

#include <algorithm>
#include <cmath>

#include "echo/kernel/isa.hpp"

namespace skerry::echo {
namespace {

// out[i] = a[i] + weight * b[i - shift] where i >= shift, else a[i].
SKERRY_KERNEL_BODY add_shifted_body(const float* a, const float* b, std::size_t shift, float weight,
                                    float* out, std::size_t n) {
  const std::size_t head = shift < n ? shift : n;
  for (std::size_t i = 0; i < head; ++i) out[i] = a[i];
  for (std::size_t i = head; i < n; ++i) out[i] = a[i] + weight * b[i - shift];
}
SKERRY_KERNEL(add_shifted,
              (const float* a, const float* b, std::size_t shift, float weight,
               float* __restrict out, std::size_t n),
              (a, b, shift, weight, out, n))

struct PulseCells {
  std::size_t whole;
  float rest;
};
PulseCells split_pulse(double pulse_cells) {
  const double cells = std::max(1.0, pulse_cells);
  const double whole = std::floor(cells);
  return {static_cast<std::size_t>(whole), static_cast<float>(cells - whole)};
}

}  // namespace

// Box sums of 1, 2, 4 ... cells by doubling; the binary digits of the pulse's length pick the ones
// to add up, and the last fraction comes from the original.
void stretch_pulse(std::span<float> power, double pulse_cells, std::vector<float>& scratch) {
  const PulseCells pulse = split_pulse(pulse_cells);
  if (pulse.whole == 1 && pulse.rest == 0.0f) return;
  const std::size_t n = power.size();
  if (scratch.size() < 5 * n) scratch.resize(5 * n);  // what is grown is cleared
  float* box = scratch.data();
  float* next_box = box + n;
  float* sum = box + 2 * n;
  float* next_sum = box + 3 * n;
  float* original = box + 4 * n;
  std::copy(power.begin(), power.end(), original);
  std::copy(power.begin(), power.end(), box);
  std::fill(sum, sum + n, 0.0f);
  std::size_t covered = 0;
  for (std::size_t width = 1; width <= pulse.whole; width *= 2) {
    if (pulse.whole & width) {
      add_shifted(sum, box, covered, 1.0f, next_sum, n);
      std::swap(sum, next_sum);
      covered += width;
    }
    if (width * 2 <= pulse.whole) {
      add_shifted(box, box, width, 1.0f, next_box, n);
      std::swap(box, next_box);
    }
  }
  if (pulse.rest > 0.0f) {
    add_shifted(sum, original, covered, pulse.rest, next_sum, n);
    std::swap(sum, next_sum);
  }
  std::copy(sum, sum + n, power.begin());
}

void stretch_pulse_reference(std::span<const float> power, double pulse_cells,
                             std::span<double> out) {
  const PulseCells pulse = split_pulse(pulse_cells);
  for (std::size_t i = 0; i < power.size(); ++i) {
    double sum = 0.0;
    for (std::size_t k = 0; k < pulse.whole && k <= i; ++k) sum += power[i - k];
    if (i >= pulse.whole) sum += static_cast<double>(pulse.rest) * power[i - pulse.whole];
    out[i] = sum;
  }
}

}  // namespace skerry::echo

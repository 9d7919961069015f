#include "server/app/load_estimate.hpp"

#include <fmt/format.h>
#include <sched.h>
#include <time.h>

#include <cmath>
#include <limits>
#include <vector>

namespace skerry::server {
namespace {

double process_cpu_s() {
  timespec time{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

std::size_t usable_cores() {
  cpu_set_t set;
  if (::sched_getaffinity(0, sizeof set, &set) != 0) return 1;
  return static_cast<std::size_t>(CPU_COUNT(&set));
}

RadarPace sum_of(const std::vector<RadarPace>& radars) {
  RadarPace sum;
  for (const RadarPace& radar : radars) {
    sum.sectors += radar.sectors;
    sum.skipped += radar.skipped;
  }
  return sum;
}

}  // namespace

double LoadEstimate::needed_cores() const {
  const double used = cpu_s / ran_s;
  if (skipped == 0) return used;
  const std::uint64_t made = sectors - skipped;
  if (made == 0) return std::numeric_limits<double>::infinity();
  return used * static_cast<double>(sectors) / static_cast<double>(made);
}

std::string LoadEstimate::text() const {
  std::string text = fmt::format("in {:.0f} s its radars and its world took {:.2f} of {} cores",
                                 ran_s, cpu_s / ran_s, cores);
  if (skipped > 0) {
    text += fmt::format("; {:.0f} % of the sectors were left out, for all {} cores would be needed",
                        100.0 * static_cast<double>(skipped) / static_cast<double>(sectors),
                        std::isinf(needed_cores())
                            ? "many more"
                            : fmt::format("some {:.0f}", std::ceil(needed_cores())));
  }
  if (!is_too_much()) return text;
  return text + fmt::format(
                    ". Above {:.0f} % sectors are left out: fewer spokes, cells, radars or "
                    "ships, a slower rotation, or more cores, would help",
                    100.0 * kMostShare);
}

LoadEstimate estimate_load(const std::function<std::vector<RadarPace>()>& pace,
                           const std::function<void(std::chrono::milliseconds)>& wait) {
  using Steady = std::chrono::steady_clock;
  wait(kBefore);
  const RadarPace before = sum_of(pace());
  const double cpu_before = process_cpu_s();
  const Steady::time_point begun = Steady::now();
  wait(kTrial);
  LoadEstimate estimate;
  estimate.ran_s = std::chrono::duration<double>(Steady::now() - begun).count();
  estimate.cpu_s = process_cpu_s() - cpu_before;
  const RadarPace after = sum_of(pace());
  estimate.sectors = after.sectors - before.sectors;
  estimate.skipped = after.skipped - before.skipped;
  estimate.cores = usable_cores();
  return estimate;
}

}  // namespace skerry::server

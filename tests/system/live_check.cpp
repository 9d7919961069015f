// live_check: a HALO emulated by one server, taken live by a second one.  Prints how long a spoke
// takes from the radar's datagram to a console of the second server, and what that server takes of
// a core.  Fails if a spoke is lost.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <exception>
#include <vector>

#include "tests/system/receive.hpp"
#include "tests/system/small_scenario.hpp"

namespace skerry::system_test {
namespace {

double quantile(const std::vector<double>& sorted, double share) {
  return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
}

int check(double seconds) {
  TempFolder folder;
  const std::string scenario = folder.write("small.yaml", small_scenario());
  ServerProcess radar(
      {"--scenario", scenario, "--output", "navico_halo:interface_address=127.0.0.73"});
  // Of its own radars none is on the air but for the two that nobody looks at.
  ServerProcess relay({"--scenario", scenario, "--input", "navico_halo:from=127.0.0.73"});
  client::SpokeClient console = subscribed(relay, 0);
  await_status(console, [](const wire::Status& status) {
    return !status.radars(0).settings().standby() && status.radars(0).spokes() > 4096;
  });
  // Frames held while the radar was looked at come first.
  const auto age_ms = [](const Spoke& spoke) {
    const auto now = std::chrono::time_point_cast<Duration>(std::chrono::system_clock::now());
    return in_seconds(now - spoke.header.utc) * 1e3;
  };
  while (age_ms(next_spoke(console)) > 100.0) {
  }
  std::vector<double> ages_ms;
  std::uint64_t lost = 0, last = 0;
  const double cpu = relay.cpu_seconds();
  const auto begin = std::chrono::steady_clock::now();
  std::chrono::duration<double> passed{};
  while (passed.count() < seconds) {
    const Spoke spoke = next_spoke(console);
    if (last > 0) lost += spoke.header.sequence - last - 1;
    last = spoke.header.sequence;
    // The last of a frame has the time at which the frame came.
    if (spoke.header.index % 32 == 31) ages_ms.push_back(age_ms(spoke));
    passed = std::chrono::steady_clock::now() - begin;
  }
  std::sort(ages_ms.begin(), ages_ms.end());
  fmt::print("frame to console: median {:.2f} ms, p99 {:.2f} ms, most {:.2f} ms, of {} frames\n",
             quantile(ages_ms, 0.5), quantile(ages_ms, 0.99), ages_ms.back(), ages_ms.size());
  fmt::print("relay with two simulated radars beside: {:.1f} % of a core\n",
             100.0 * (relay.cpu_seconds() - cpu) / passed.count());
  fmt::print("{} spokes lost\n", lost);
  return lost == 0 ? 0 : 1;
}

}  // namespace
}  // namespace skerry::system_test

int main(int argc, char** argv) {
  CLI::App cli{"The delay that a server adds to a real radar's picture"};
  double seconds = 30.0;
  cli.add_option("--seconds", seconds, "how long (30)")->check(CLI::Range(1.0, 3600.0));
  CLI11_PARSE(cli, argc, argv);
  try {
    return skerry::system_test::check(seconds);
  } catch (const std::exception& error) {
    fmt::print(stderr, "live_check: {}\n", error.what());
    return 2;
  }
}

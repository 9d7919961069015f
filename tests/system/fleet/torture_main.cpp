// fleet_torture SECONDS SEED: the long form of Fleet.KeepsOneLog.  Ends with 1 if anything was
// wrong.
#include <cstdio>
#include <string>

#include "tests/system/fleet/torture.hpp"

int main(int argc, char** argv) {
  skerry::fleet::TorturePlan plan;
  plan.length = std::chrono::seconds(argc > 1 ? std::stoi(argv[1]) : 600);
  plan.seed = argc > 2 ? std::stoull(argv[2]) : 1;
  const auto report = skerry::fleet::torture(plan);
  std::printf("seed %llu: %s", static_cast<unsigned long long>(plan.seed), report.text().c_str());
  return report.contradictions.empty() ? 0 : 1;
}

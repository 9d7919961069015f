// How exact the plotter is: the four scenarios of A.823(19), 500 runs each.
#include <cstdio>
#include <cstdlib>

#include "tests/unit/plotter/standard_scenarios.hpp"

using namespace skerry::server;

int main(int argc, char** argv) {
  const int runs = argc > 1 ? std::atoi(argv[1]) : 500;
  const Tracker::Rule rule{.acquire = Tracker::Acquire::all};
  std::printf("scenario  min   rel.course  rel.speed     CPA    TCPA   course   speed\n");
  std::printf("                       deg         kn      NM     min      deg      kn\n");
  for (std::size_t s = 0; s < kStandardScenarios.size(); ++s) {
    for (const double minutes : {1.0, 3.0}) {
      int lost = 0;
      const auto errors = errors_of_95(kStandardScenarios[s], minutes, runs, lost, rule);
      const auto asked =
          (minutes < 2.0 ? kStandardScenarios[s].after_1_min : kStandardScenarios[s].after_3_min)
              .all();
      std::printf("%zu        %4.0f ", s + 1, minutes);
      for (std::size_t k = 0; k < errors.size(); ++k) {
        std::printf("  %6.2f%s", errors[k],
                    asked[k] == 0.0         ? "   "
                    : errors[k] <= asked[k] ? " ok"
                                            : " NO");
      }
      std::printf("   no track: %d\n", lost);
    }
  }
}

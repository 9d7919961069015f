// radar_error_bench: speed against error of the radar's approximations, each against its reference
// in double.
//
//   radar_error_bench                  all of them
//   radar_error_bench log texture      some: beam log propagation scatterers texture
#include <cstdio>
#include <string_view>
#include <vector>

#include "tests/bench/error/beam_taps_error.hpp"
#include "tests/bench/error/log_error.hpp"
#include "tests/bench/error/propagation_error.hpp"
#include "tests/bench/error/scatterers_error.hpp"
#include "tests/bench/error/texture_error.hpp"

namespace {

struct Study {
  std::string_view name;
  void (*print)(std::FILE*);
};
constexpr Study kStudies[] = {{"beam", skerry::bench::print_beam_taps_error},
                              {"log", skerry::bench::print_log_error},
                              {"propagation", skerry::bench::print_propagation_error},
                              {"scatterers", skerry::bench::print_scatterers_error},
                              {"texture", skerry::bench::print_texture_error}};

}  // namespace

int main(int argc, char** argv) {
  std::vector<const Study*> chosen;
  for (int i = 1; i < argc; ++i) {
    const std::string_view word = argv[i];
    if (word.starts_with("--benchmark")) continue;  // run with the others
    const Study* found = nullptr;
    for (const Study& study : kStudies) {
      if (study.name == word) found = &study;
    }
    if (!found) {
      std::fprintf(stderr,
                   "radar_error_bench: there is no study '%s'; there are beam, log, propagation, "
                   "scatterers and texture\n",
                   argv[i]);
      return 2;
    }
    chosen.push_back(found);
  }
  if (chosen.empty()) {
    for (const Study& study : kStudies) chosen.push_back(&study);
  }
  for (const Study* study : chosen) {
    std::printf("\n");
    study->print(stdout);
  }
}

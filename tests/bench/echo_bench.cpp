// echo_bench: what the echo costs, from kernels to whole spokes, for each instruction set.
//
// Columns: time and CPU of one iteration; ns/cell of it; the floor (see bench_support.hpp),
// ns/cell, measured in the same run; and the ratio of the two, which is what can be compared
// between machines and on a busy one.
#include "tests/bench/bench_support.hpp"

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::AddCustomContext("best instruction set",
                              std::string(skerry::echo::name_of(skerry::echo::best_isa())));
  skerry::bench::register_kernels();
  skerry::bench::register_returns();
  skerry::bench::register_scenes();
  skerry::bench::register_coasts();
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}

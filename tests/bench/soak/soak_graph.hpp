// The graph of a soak: what two servers hold, over time.
#pragma once

#include <string>
#include <vector>

#include "tests/bench/soak/process_figures.hpp"

namespace skerry::bench {

struct SoakSample {
  double minutes = 0.0;
  ProcessFigures live, player;
  std::size_t consoles = 0;
  bool is_ebb = false;  // nobody is connected
};

// A PNG of three panels, memory, descriptors and threads: green the server with radars, amber the
// one that plays; dots are ebbs.  Error: std::runtime_error as write_file().
void write_soak_graph(const std::string& file, const std::vector<SoakSample>& samples);

}  // namespace skerry::bench

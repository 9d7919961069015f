// ProcessFigures: what a process holds, as the kernel counts it.
#pragma once

#include <sys/types.h>

namespace skerry::bench {

struct ProcessFigures {
  double resident_mib = 0.0;  // VmRSS
  double heap_mib = 0.0;      // RssAnon: without mapped files and shared memory
  int descriptors = 0;
  int threads = 0;
};

// All zero if there is no such process.
ProcessFigures figures_of(pid_t pid);

}  // namespace skerry::bench

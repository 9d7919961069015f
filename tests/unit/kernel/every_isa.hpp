// Runs a check once per instruction set this machine has.
#pragma once

#include <gtest/gtest.h>

#include "echo/kernel/isa.hpp"

namespace skerry::echo {

template <typename Body>
void on_every_isa(Body&& body) {
  for (const Isa isa : {Isa::baseline, Isa::avx2, Isa::avx512}) {
    if (isa > best_isa()) continue;
    SCOPED_TRACE(name_of(isa));
    force_isa(isa);
    body();
  }
  force_isa(best_isa());
}

}  // namespace skerry::echo

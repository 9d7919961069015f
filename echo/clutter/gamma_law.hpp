// The texture's law: from a Gaussian to a gamma value of the same rank.
#pragma once

#include "echo/kernel/clutter_row.hpp"

namespace skerry::echo {

// log2 of the unit-mean gamma value of shape nu (cut to 0.1 .. 30) that has the rank of a Gaussian
// one: log2(Q_nu(Phi(x)) / nu), the memoryless transform of Tough and Ward 1999 (SOURCES.md "Sea").
// Error: 0.14 dB; cut at -42 dB below and at rank 1 - 3.4e-6 above; mean 1 within 0.4 %, variance
// 1 / nu within 1.2 %.  Held by GammaLaw.IsTheQuantileWithinItsBound and
// GammaLaw.HasTheMomentsOfTheGamma.
RankLaw gamma_law(double nu);

}  // namespace skerry::echo

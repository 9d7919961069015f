// The judging of one coast.
#pragma once

#include "echo/coast_tool/coast_fit.hpp"
#include "echo/coast_tool/judge_report.hpp"

namespace skerry::echo {

struct JudgeOptions {
  int keep = 6;                                 // every how many-th vertex the methods are shown
  int seeds = 5;                                // of the methods that draw by chance
  double detail_m = 10.0;                       // what curves are refined down to
  double beam_deg = 1.2;                        // of the radar of the pictures
  std::vector<double> scales_nm = {3.0, 0.75};  // of the pictures; empty: none
};

// The conventional method, each corrected one with the style fitted to the thinned coast as `skerry
// coast fit` would (beside it the default style), and each as Ji et al. 2016 print it, with c = 15
// and L = 10 pixels and three iterations.
// A pure function of its arguments.  Error: std::runtime_error and std::invalid_argument as
// ThinnedCoast; a range scale without a place afloat near a shore.
Judgement judge(const CoastChart& chart, const CoastArea& area, const JudgeOptions& options,
                const Telling& tell);

}  // namespace skerry::echo

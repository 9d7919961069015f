// A simulation's picture judged by a real one's.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "echo/picture_tool/picture_report.hpp"

namespace skerry::echo {

struct PictureJudgeOptions {
  std::string capture;
  std::vector<std::string> simulations;  // each a place of its own
  double reach_m = 0.0;                  // of both; 0: the capture's that has most turns
  std::uint32_t radar = 0;               // of the simulations
  double beam_deg = 0.0;                 // 0: of the set that the capture's name tells
  std::uint64_t seed = 1;
  std::size_t turns = 8;  // of each file
};

// Reads both and compares them.  Without calls where too little echoes or the sizes differ: then a
// note says why.
// Error: std::runtime_error as read_picture(); a capture without coast; a simulation whose spokes
// differ in number, or whose cells differ by more than kMostCellDifference: it says how to make
// one.
PictureReport judge_pictures(const PictureJudgeOptions& options, const PictureTelling& tell);
inline constexpr double kMostCellDifference = 0.1;

}  // namespace skerry::echo

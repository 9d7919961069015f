// Findings of the judge of coasts, as tables and figures.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "echo/coast_tool/judge_picture.hpp"

namespace skerry::echo {

// One coast, drawn with each seed.
struct JudgedMethod {
  std::string name;
  std::string how;                 // the parameters in words
  std::vector<CoastShape> shapes;  // by seed
  std::vector<CoastScore> scores;
  std::vector<std::vector<PictureScore>> pictures;  // by range scale, then by seed
};

struct Judgement {
  std::string coast, source;
  int keep = 0, seeds = 0;
  std::size_t edges = 0;
  double spacing_m = 0.0, chord_m = 0.0;  // median edge of the fine and of the thinned coast
  ScoreScales scales;
  JudgedMethod real;                  // the held-back coast: no scores
  std::vector<JudgedMethod> methods;  // the conventional one first
  struct Picture {
    JudgeRadar radar;
    GeoPoint place;
  };
  std::vector<Picture> pictures;
};

// Tables for people: curves, structure, then one of pictures by range scale.
std::string judgement_text(const Judgement& judgement);

// "coast,method,seed,picture_nm,measure,value", one figure a line; picture_nm is empty for curves.
std::string judgement_csv_head();
std::string judgement_csv(const Judgement& judgement);

}  // namespace skerry::echo

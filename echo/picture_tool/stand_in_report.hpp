// A real picture beside ours at places that stand in for its own.
#pragma once

#include <string>
#include <vector>

#include "echo/chart/chart_source.hpp"
#include "echo/picture_tool/captured_radars.hpp"
#include "echo/picture_tool/made_pictures.hpp"
#include "echo/picture_tool/picture_report.hpp"

namespace skerry::echo {

struct StandInOptions {
  std::uint32_t places = 6, turns = 2;
  std::uint64_t seed = 77;
  std::size_t real_turns = 8;
};

// A real picture, and our radar that is like it.
struct RealAndRadar {
  TurnsOfPicture real;
  MadeRadar radar;
  std::vector<std::string> notes;
};
// The row's picture in `file`; our set by the row.  Error: std::runtime_error as read_picture() and
// radar_like().
RealAndRadar real_and_radar(const std::string& file, const CapturedRadar& row,
                            std::size_t most_turns);

// The rows of a file's name; one that takes the reach with most turns where there is none.
std::vector<CapturedRadar> rows_of(const std::string& file);

// Ours at the places.
std::vector<TurnsOfPicture> pictures_of(const MadeRadar& radar, const std::vector<StandIn>& places,
                                        std::uint32_t turns);

// Everything.  Error: std::runtime_error, also where no place is found.
PictureReport stand_in_report(const RealAndRadar& real, const ChartSource& chart,
                              const StandInOptions& options, const PictureTelling& tell);

// "halo20-ranges 3183 m" of a file's name and reach.
std::string short_name(const TurnsOfPicture& picture);

}  // namespace skerry::echo

#include "echo/picture_tool/judge_run.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <stdexcept>

#include "echo/picture_tool/captured_radars.hpp"
#include "echo/picture_tool/stand_in_report.hpp"

namespace skerry::echo {
namespace {

constexpr double kUnknownBeam_deg = 5.0;

double beam_of(const PictureJudgeOptions& options, double reach_m,
               std::vector<std::string>& notes) {
  if (options.beam_deg > 0.0) return options.beam_deg;
  if (const auto row = captured_radar_of(options.capture, reach_m))
    return stand_in_set(row->set, notes).beam_width_deg;
  notes.push_back(
      fmt::format("the capture's name tells no set: the beam is taken as {:g} deg; --beam says "
                  "another",
                  kUnknownBeam_deg));
  return kUnknownBeam_deg;
}

double cell_m(const TurnsOfPicture& picture) { return picture.reach_m / picture.cells; }

void require_alike(const TurnsOfPicture& real, const TurnsOfPicture& made) {
  const bool far = std::fabs(cell_m(made) / cell_m(real) - 1.0) > kMostCellDifference;
  if (made.spokes == real.spokes && !far) return;
  throw std::runtime_error(fmt::format(
      "{}: {} spokes of cells of {:.2f} m do not compare with the capture's {} of {:.2f} m. Record "
      "a radar of {} spokes and {} cells at a range scale that gives such cells, or give --reach",
      made.file, made.spokes, cell_m(made), real.spokes, cell_m(real), real.spokes, real.cells));
}

std::string name_of(const TurnsOfPicture& picture) {
  return fmt::format("{} ({} spokes of {} cells of {:.2f} m)", short_name(picture), picture.spokes,
                     picture.cells, cell_m(picture));
}

}  // namespace

PictureReport judge_pictures(const PictureJudgeOptions& options, const PictureTelling& tell) {
  PictureReport report;
  tell("reading " + options.capture);
  const TurnsOfPicture real =
      read_picture(options.capture, {.reach_m = options.reach_m, .most_turns = options.turns});
  report.real_name = name_of(real);
  const auto note_of = [&](const TurnsOfPicture& picture) {
    for (const std::string& note : picture.notes)
      report.notes.push_back(fmt::format("{}: {}", short_name(picture), note));
  };
  note_of(real);
  report.beam_deg = beam_of(options, real.reach_m, report.notes);

  std::vector<TurnsOfPicture> made;
  for (const std::string& file : options.simulations) {
    tell("reading " + file);
    made.push_back(read_picture(
        file, {.radar = options.radar, .reach_m = options.reach_m, .most_turns = options.turns}));
    require_alike(real, made.back());
    note_of(made.back());
  }
  report.ours_name = name_of(made.front());
  if (made.size() > 1) report.ours_name += fmt::format(" and {} more", made.size() - 1);

  tell("figures of the capture");
  report.real = spread_statistics({&real, 1}, report.beam_deg);
  if (report.real.empty())
    throw std::runtime_error(fmt::format("{}: no coast in it: only {:.2g} % of the cells echo",
                                         options.capture, 100.0 * report.real.mean.occupancy));
  tell("figures of the simulation");
  report.ours = spread_statistics(made, report.beam_deg);
  report.calls = call_all({&real, 1}, made, report.beam_deg, options.seed, tell);
  return report;
}

}  // namespace skerry::echo

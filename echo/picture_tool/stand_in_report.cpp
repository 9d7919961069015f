#include "echo/picture_tool/stand_in_report.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <stdexcept>

#include "protocol/navico/frame.hpp"

namespace skerry::echo {
namespace {

constexpr std::string_view kUnknownSet = "HALO20";

}  // namespace

std::vector<CapturedRadar> rows_of(const std::string& file) {
  const std::string name = std::filesystem::path(file).filename().string();
  std::vector<CapturedRadar> rows;
  for (const CapturedRadar& row : captured_radars()) {
    if (name.starts_with(row.capture)) rows.push_back(row);
  }
  if (rows.empty()) rows.push_back({"", kUnknownSet, 0.0, 1.0});
  return rows;
}

RealAndRadar real_and_radar(const std::string& file, const CapturedRadar& row,
                            std::size_t most_turns) {
  RealAndRadar out;
  out.real = read_picture(file, {.reach_m = row.reach_m, .most_turns = most_turns});
  out.notes = out.real.notes;
  if (row.capture.empty())
    out.notes.push_back(fmt::format("the file's name tells no set: {} is taken", row.set));
  out.radar = radar_like(out.real, stand_in_set(row.set, out.notes), row.reach_over_scale);
  if (row.velocity_track) out.radar.highest = navico::kMostBesideDoppler;
  return out;
}

std::vector<TurnsOfPicture> pictures_of(const MadeRadar& radar, const std::vector<StandIn>& places,
                                        std::uint32_t turns) {
  std::vector<TurnsOfPicture> pictures;
  for (const StandIn& place : places) pictures.push_back(make_picture(radar, place, turns));
  return pictures;
}

std::string short_name(const TurnsOfPicture& picture) {
  const std::string name = std::filesystem::path(picture.file).filename().string();
  return fmt::format("{} {:.0f} m", name.substr(0, name.find('.')), picture.reach_m);
}

PictureReport stand_in_report(const RealAndRadar& real, const ChartSource& chart,
                              const StandInOptions& options, const PictureTelling& tell) {
  const double beam = real.radar.set.beam_width_deg;
  PictureReport report{short_name(real.real), real.radar.set.name, beam, {}, {}, {}, real.notes};
  tell("figures of the real picture");
  report.real = spread_statistics({&real.real, 1}, beam);
  if (report.real.empty())
    throw std::runtime_error(fmt::format("{}: no coast in it: only {:.2g} % of the cells echo",
                                         real.real.file, 100.0 * report.real.mean.occupancy));
  const std::vector<StandIn> places = find_stand_ins(
      chart, real.radar,
      {.count = options.places, .seed = options.seed, .occupancy = report.real.mean.occupancy},
      tell);
  if (places.empty())
    throw std::runtime_error(
        fmt::format("{}: no place of {} has a picture of which 1 to 70 % echoes", report.real_name,
                    chart.describe()));
  if (places.size() < options.places)
    report.notes.push_back(
        fmt::format("ours at {} places of {}: others hardly echo", places.size(), options.places));
  tell("ours");
  const std::vector<TurnsOfPicture> ours = pictures_of(real.radar, places, options.turns);
  report.ours = spread_statistics(ours, beam);
  report.calls = call_all({&real.real, 1}, ours, beam, options.seed, tell);
  return report;
}

}  // namespace skerry::echo

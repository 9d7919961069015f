#include "echo/picture_tool/sheet_command.hpp"

#include <fmt/format.h>

#include <memory>
#include <stdexcept>

#include "echo/chart/gshhg_reader.hpp"
#include "echo/picture_tool/contact_sheet.hpp"
#include "echo/picture_tool/stand_in_report.hpp"
#include "echo/tool_console/console.hpp"
#include "protocol/picture/picture_file.hpp"

namespace skerry::echo {
namespace {

struct SheetAsked {
  std::vector<std::string> captures;
  std::string file = "sheet.png";
  std::uint64_t seed = 77;
};

// One row; false, and said why, where the capture has no picture to compare.
bool add_row(const SheetAsked& asked, const std::string& capture, const CapturedRadar& row,
             const ChartSource& chart, Progress& progress, ContactSheet& sheet) {
  const PictureTelling tell = [&](const std::string& what) {
    progress.show(fmt::format("{}: {}", capture, what));
  };
  try {
    tell("reading");
    const RealAndRadar real = real_and_radar(capture, row, 1);
    const PictureTurn turn = real.real.turn(0, real.radar.set.beam_width_deg);
    const auto places = find_stand_ins(chart, real.radar,
                                       {.count = ContactSheet::kColumns - 1,
                                        .seed = asked.seed,
                                        .occupancy = share_that_echoes({&turn, 1})},
                                       tell);
    sheet.begin_row(fmt::format("{}, {} spokes of {} cells, beside {}", short_name(real.real),
                                real.real.spokes, real.real.cells, real.radar.set.name));
    sheet.add(real.real, "real");
    for (const StandIn& place : places)
      sheet.add(
          make_picture(real.radar, place, 1),
          fmt::format("ours at {:.3f} {:.3f}", place.at.latitude_deg, place.at.longitude_deg));
    progress.clear();
    for (const std::string& note : real.notes) fmt::print(stderr, "note: {}\n", note);
    return true;
  } catch (const std::runtime_error& error) {
    progress.clear();
    report(error.what());
    return false;
  }
}

int run_sheet(const SheetAsked& asked) {
  Progress progress;
  const GshhgReader chart = GshhgReader::open(GshhgReader::find_finest());
  ContactSheet sheet("Real radars' pictures, and ours of other places");
  int rows = 0;
  bool all = true;
  for (const std::string& capture : asked.captures) {
    for (const CapturedRadar& row : rows_of(capture)) {
      const bool added = add_row(asked, capture, row, chart, progress, sheet);
      rows += added ? 1 : 0, all = all && added;
    }
  }
  if (rows == 0) return kExitFailure;
  const RgbaImage image = sheet.take();
  skerry::write_file(asked.file, encode_png(image, {{"Source", chart.describe()}}));
  write_out(
      fmt::format("{}: {} rows, {} x {} pixels\n", asked.file, rows, image.width, image.height));
  return all ? kExitOk : kExitFailure;
}

}  // namespace

Command make_picture_sheet_command(CLI::App& app) {
  const auto asked = std::make_shared<SheetAsked>();
  CLI::App* command = app.add_subcommand(
      "sheet", "Draws real pictures beside ours, on one scale and in one palette");
  command->add_option("captures", asked->captures, "Of real radars: .pcap, .pcap.gz or .mcap")
      ->required();
  command->add_option("-o,--out", asked->file, "PNG file")->capture_default_str();
  command->add_option("--seed", asked->seed, "Of the places")->capture_default_str();
  command->footer(
      "Examples:\n"
      "  skerry picture sheet -o sheet.png halo20-ranges.pcap.gz 3g-trueheading.pcap.gz\n"
      "A row is a capture at one reach: the real picture, and ours of two places on whose coasts "
      "as\n"
      "many cells echo.  Exit code 1 where a capture had no picture; the others are drawn.\n");
  return {command, [asked] { return run_sheet(*asked); }};
}

}  // namespace skerry::echo

#include "echo/picture_tool/table_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <stdexcept>

#include "echo/chart/gshhg_reader.hpp"
#include "echo/picture_tool/stand_in_report.hpp"
#include "echo/tool_console/console.hpp"

namespace skerry::echo {
namespace {

struct TableAsked {
  std::string folder, only;
  bool pairs = false;
  std::size_t features = 0;
  StandInOptions options;
};

// Captures and recordings in the folder, by name.  Error: std::runtime_error where there are none.
std::vector<std::string> files_in(const std::string& folder) {
  std::vector<std::string> files;
  std::error_code failed;
  for (const auto& entry : std::filesystem::directory_iterator(folder, failed)) {
    const std::string name = entry.path().filename().string();
    if (name.ends_with(".pcap") || name.ends_with(".pcap.gz") || name.ends_with(".mcap"))
      files.push_back(entry.path().string());
  }
  if (failed) throw std::runtime_error(fmt::format("{}: {}", folder, failed.message()));
  if (files.empty())
    throw std::runtime_error(
        fmt::format("{}: no capture in it, expected *.pcap, *.pcap.gz or *.mcap", folder));
  std::sort(files.begin(), files.end());
  return files;
}

// Real pictures told from each other.
std::string pairs_text(const std::vector<RealAndRadar>& all, std::uint64_t seed,
                       const PictureTelling& tell) {
  std::string text;
  for (std::size_t a = 0; a < all.size(); ++a) {
    for (std::size_t b = a + 1; b < all.size(); ++b) {
      const std::string name =
          fmt::format("{} | {}", short_name(all[a].real), short_name(all[b].real));
      tell(name);
      const auto patches = [&](const RealAndRadar& each, std::uint32_t place) {
        return patches_of_places({&each.real, 1}, place, each.radar.set.beam_width_deg);
      };
      const Call call = call_apart(name, patches(all[a], 0), patches(all[b], 0), {.seed = seed});
      if (call.mask && call.all)
        text += fmt::format("{}: mask {:.2f} all {:.2f} ({} patches)\n", name, call.mask->auc,
                            call.all->auc, call.mask->patches);
    }
  }
  return text;
}

int run_table(const TableAsked& asked) {
  Progress progress;
  const GshhgReader chart = GshhgReader::open(GshhgReader::find_finest());
  std::vector<RealAndRadar> all;
  std::size_t told = 0;
  write_out(short_report_head());
  for (const std::string& file : files_in(asked.folder)) {
    const std::string name = std::filesystem::path(file).filename().string();
    if (!name.starts_with(asked.only)) continue;
    for (const CapturedRadar& row : rows_of(file)) {
      const PictureTelling tell = [&](const std::string& what) {
        progress.show(fmt::format("{}: {}", name, what));
      };
      tell("reading");
      std::string text;
      try {
        RealAndRadar real = real_and_radar(file, row, asked.options.real_turns);
        text = short_report_text(stand_in_report(real, chart, asked.options, tell), asked.features);
        ++told;
        if (asked.pairs) all.push_back(std::move(real));
      } catch (const std::runtime_error& error) {
        text = fmt::format("{}\n", error.what());
      }
      progress.clear();
      write_out(text);
    }
  }
  const PictureTelling tell = [&](const std::string& what) { progress.show(what); };
  const std::string pairs = pairs_text(all, asked.options.seed, tell);
  progress.clear();
  write_out(pairs);
  if (told > 0) return kExitOk;
  return report("none of the captures could be compared");
}

}  // namespace

Command make_picture_table_command(CLI::App& app) {
  const auto asked = std::make_shared<TableAsked>();
  CLI::App* command =
      app.add_subcommand("table", "Every capture of a folder beside our pictures of like places");
  command
      ->add_option("folder", asked->folder,
                   "With captures (.pcap, .pcap.gz) and recordings (.mcap)")
      ->required();
  command->add_option("--only", asked->only, "Files whose names begin so");
  command->add_flag("--pairs", asked->pairs, "Also every two real pictures against each other");
  command->add_option("--places", asked->options.places, "Places of ours for each capture")
      ->check(CLI::Range(1, 24))
      ->capture_default_str();
  command
      ->add_option("--features", asked->features, "Features shown of each that tell real from ours")
      ->check(CLI::Range(0, static_cast<int>(kPatchFeatures)))
      ->capture_default_str();
  command->add_option("--seed", asked->options.seed, "Of places, folds and trees")
      ->capture_default_str();
  command->footer(
      "Examples:\n"
      "  skerry picture table captures/\n"
      "  skerry picture table captures/ --only halo20 --pairs\n"
      "Our pictures are of places that stand in for the real ones: coasts of GSHHG on which as\n"
      "many cells echo.  The set is the shipped one that a capture's name tells.\n");
  return {command, [asked] { return run_table(*asked); }};
}

}  // namespace skerry::echo

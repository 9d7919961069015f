#include "echo/picture_tool/judge_command.hpp"

#include <memory>

#include "echo/picture_tool/judge_run.hpp"
#include "echo/picture_tool/report_files.hpp"
#include "echo/tool_console/console.hpp"

namespace skerry::echo {
namespace {

struct PictureJudgeAsked {
  PictureJudgeOptions options;
  bool json = false;
  std::size_t features = kFeaturesShown;
  std::string csv;
};

int run_picture_judge(const PictureJudgeAsked& asked) {
  Progress progress;
  const PictureReport report =
      judge_pictures(asked.options, [&](const std::string& what) { progress.show(what); });
  progress.clear();
  if (!asked.csv.empty()) write_file(asked.csv, report_csv(report));
  write_out(asked.json ? report_json(report) : report_text(report, asked.features));
  const bool called = report.calls.real_ours.mask.has_value();
  return called ? kExitOk : kExitFailure;
}

}  // namespace

Command make_picture_judge_command(CLI::App& app) {
  const auto asked = std::make_shared<PictureJudgeAsked>();
  CLI::App* command = app.add_subcommand(
      "judge",
      "Figures of a real picture and a made one, and how surely a classifier tells them "
      "apart");
  command
      ->add_option("capture", asked->options.capture,
                   "Of a real radar: .pcap, .pcap.gz, or a recording, .mcap")
      ->required();
  command
      ->add_option("simulation", asked->options.simulations,
                   "The same; several: other places of the same radar")
      ->required();
  command
      ->add_option("--reach", asked->options.reach_m,
                   "Metres to the last cell, to 2 %.  Default: the reach with most turns")
      ->check(CLI::Range(10.0, 400e3));
  command->add_option("--radar", asked->options.radar, "Index of the radar in the simulation")
      ->capture_default_str();
  command
      ->add_option(
          "--beam", asked->options.beam_deg,
          "Beam width, degrees.  Default: of the set that the capture's name tells, else 5")
      ->check(CLI::Range(0.3, 10.0));
  command->add_option("--turns", asked->options.turns, "Turns taken of each file, at most")
      ->check(CLI::Range(1, 64))
      ->capture_default_str();
  command->add_option("--seed", asked->options.seed, "Of draws and of the trees' labels")
      ->capture_default_str();
  command->add_option("--features", asked->features, "Features shown that tell them apart")
      ->check(CLI::Range(0, static_cast<int>(kPatchFeatures)))
      ->capture_default_str();
  command->add_flag("--json", asked->json, "Print JSON instead of tables");
  command->add_option("--csv", asked->csv, "Write every figure to a file");
  command->footer(
      "Examples:\n"
      "  skerry picture judge halo20-ranges.pcap.gz ours.mcap\n"
      "  skerry picture judge halo.pcap bergen.mcap tacoma.mcap oban.mcap --csv judge.csv\n"
      "  skerry picture judge halo.pcap ours.mcap --reach 3183 --beam 4.9 --json\n"
      "AUC: 0.5 the classifier cannot tell them apart, 1 it always can.  The null must be .45 to\n"
      ".55.  Exit code 1 also where too little echoes for the classifier.\n");
  return {command, [asked] { return run_picture_judge(*asked); }};
}

}  // namespace skerry::echo

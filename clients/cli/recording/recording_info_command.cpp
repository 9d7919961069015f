// skerry recording info.
#include <memory>
#include <optional>

#include "clients/cli/recording/recording_command.hpp"
#include "clients/recording/recording_info.hpp"

namespace skerry::client {
namespace {

struct InfoOptions {
  std::string file;
  bool json = false;
  bool check = false;
};

int run_info(const InfoOptions& options) {
  const auto reader = open_recording(options.file);
  if (!reader) return kExitFailure;
  std::optional<CheckReport> check;
  if (options.check) {
    ProgressBar bar("reading");
    auto checked = check_recording(*reader, bar.function());
    if (!checked) return report(checked.error());
    check = *checked;
  }
  write_out(options.json ? info_json(*reader, check) : info_text(*reader, check));
  const bool damaged = reader->summary().damage || (check && check->chunks_damaged > 0);
  return options.check && damaged ? kExitFailure : kExitOk;
}

}  // namespace

Command make_recording_info_command(CLI::App& recording) {
  auto options = std::make_shared<InfoOptions>();
  CLI::App* command =
      recording.add_subcommand("info", "Shows what is in a recording: radars, items, marks");
  command->add_option("FILE", options->file, "The recording")->required();
  command->add_flag("--json", options->json, "As one JSON object");
  command->add_flag("--check", options->check,
                    "Also read every item; exit code 1 if something is damaged");
  command->footer(
      "Examples:\n"
      "  skerry recording info exercise.mcap\n"
      "  skerry recording info exercise.mcap --json | jq '.marks'\n"
      "  skerry recording info exercise.mcap --check\n");
  return {command, [options] { return run_info(*options); }};
}

}  // namespace skerry::client

// skerry recording repair.
#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <memory>

#include "clients/cli/recording/recording_command.hpp"
#include "protocol/recording/repair.hpp"
#include "protocol/wire/printable_text.hpp"

namespace skerry::client {
namespace {

struct RepairOptions {
  std::string file, output;
  bool force = false;
};

int run_repair(const RepairOptions& options) {
  if (same_file(options.file, options.output)) {
    return report("a file is not repaired in place; give another name with -o");
  }
  // The old file stays until the new one is whole.
  const std::string beside = options.output + fmt::format(".repaired-{}", ::getpid());
  const std::string& to = options.force ? beside : options.output;
  ProgressBar bar("repairing");
  const auto done = recording::repair(options.file, to, bar.function());
  if (!done) return report(done.error());
  if (options.force) std::filesystem::rename(beside, options.output);
  if (done->was_whole) fmt::print(stderr, "skerry: nothing was wrong with it\n");
  write_out(fmt::format("{}: {} items in {} chunks; left out: {} damaged chunks, {} bytes\n",
                        printable(options.output), done->items, done->chunks_kept,
                        done->chunks_damaged, done->bytes_left_out));
  return kExitOk;
}

}  // namespace

Command make_recording_repair_command(CLI::App& recording) {
  auto options = std::make_shared<RepairOptions>();
  CLI::App* command =
      recording.add_subcommand("repair", "Makes a whole recording of a damaged one");
  command->add_option("FILE", options->file, "The damaged recording; it stays as it is")
      ->required();
  add_output(*command, options->output, options->force);
  command->footer(
      "Example:\n"
      "  skerry recording repair broken.mcap -o whole.mcap\n"
      "Whole chunks are copied, damaged ones left out, the index is made anew.\n");
  return {command, [options] { return run_repair(*options); }};
}

}  // namespace skerry::client

// skerry recording: files of recorded spokes.
#include "clients/cli/recording/recording_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <filesystem>
#include <stdexcept>

#include "clients/recording/position.hpp"
#include "protocol/wire/printable_text.hpp"

namespace skerry::client {

void PackingOptions::add_options(CLI::App& command) {
  command.add_option("--compression", compression, "none, lz4 (fast) or zstd (small)")
      ->check(CLI::IsMember({"none", "lz4", "zstd"}))
      ->capture_default_str();
  command.add_flag("--compact", compact, "Pack spokes by their differences: smaller, lossless");
  command.add_option("--zstd-level", zstd_level, "1 (fast) .. 19 (small)")
      ->check(CLI::Range(1, 19))
      ->capture_default_str();
}

recording::WriterOptions PackingOptions::writer_options() const {
  recording::WriterOptions options;
  options.compression = compression == "none"  ? recording::Compression::none
                        : compression == "lz4" ? recording::Compression::lz4
                                               : recording::Compression::zstd;
  options.compact = compact;
  options.zstd_level = zstd_level;
  // A file made of another need not be on the disk within the second: chunks end by their size.
  options.chunk_time = std::chrono::hours(1);
  return options;
}

void PartOptions::add_options(CLI::App& command) {
  command.add_option("--from", from, "Where it begins: 90, 1:30, 0:01:30.5, or a mark's name");
  command.add_option("--to", to, "Where it ends, the same way");
}

Result<Part, std::string> part_of(const PartOptions& options, const recording::Summary& summary) {
  Part part;
  if (!options.from.empty()) {
    const auto from = find_position(options.from, summary);
    if (!from) return Failure{from.error()};
    part.from = *from;
  }
  if (!options.to.empty()) {
    const auto to = find_position(options.to, summary);
    if (!to) return Failure{to.error()};
    part.to = *to;
  }
  if (part.to && *part.to <= part.from.value_or(summary.begin)) {
    return Failure{
        fmt::format("--to {} is not behind {}", printable(options.to),
                    options.from.empty() ? "the beginning" : "--from " + printable(options.from))};
  }
  return part;
}

bool ProgressBar::show(double share) {
  constexpr int kWidth = 30;
  const int done = static_cast<int>(std::clamp(share, 0.0, 1.0) * kWidth);
  progress_.show(fmt::format("{} [{:#<{}}{:{}}] {:.0f} %", what_, "", done, "", kWidth - done,
                             std::clamp(share, 0.0, 1.0) * 100.0));
  return !interrupted();
}

std::optional<recording::RecordingReader> open_recording(const std::string& path) {
  ProgressBar bar("searching " + printable(path));
  auto reader = recording::RecordingReader::open(path, bar.function());
  if (!reader) {
    report(reader.error(), interrupted() ? ""
                                         : "skerry recording import makes recordings of captures "
                                           "(pcap); skerry recording info tells what a file is.");
    return std::nullopt;
  }
  if (const auto& damage = reader->summary().damage) {
    fmt::print(stderr,
               "skerry: {}\nskerry: what can be read is used; skerry recording repair "
               "makes a whole file of it\n",
               printable(damage->to_string()));
  }
  return std::move(*reader);
}

int report(const recording::RecordingError& error, const std::string& advice) {
  if (interrupted()) return report("interrupted; nothing was written");
  return report(printable(error.to_string(), 2000), advice);
}

void add_output(CLI::App& command, std::string& output, bool& force) {
  command.add_option("-o,--output", output, "The new recording")->required();
  command.add_flag("--force", force, "Replace it if it is there");
}

bool same_file(const std::string& a, const std::string& b) {
  std::error_code error;
  return std::filesystem::equivalent(a, b, error);
}

int finish(recording::RecordingWriter& writer, RecordingOutput& output) {
  writer.finish();
  output.commit();
  return kExitOk;
}

Command make_recording_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "recording", "Recorded spokes: look at files, cut, join, import captures, export, repair");
  command->require_subcommand(1);
  command->footer(
      "Examples:\n"
      "  skerry recording info exercise.mcap\n"
      "  skerry recording cut exercise.mcap --from 1:30 --to collision -o part.mcap\n"
      "  skerry recording cat a.mcap b.mcap -o both.mcap\n"
      "  skerry recording import halo.pcapng.gz -o halo.mcap\n"
      "  skerry recording export exercise.mcap --png 3 -o turn.png\n"
      "  skerry recording verify exercise.mcap\n"
      "  skerry recording repair broken.mcap -o whole.mcap\n"
      "Each says more with --help.  Positions are seconds (90), minutes:seconds (1:30),\n"
      "hours:minutes:seconds (0:01:30.5) or the name of a mark.\n");
  const std::array commands = {
      make_recording_info_command(*command),   make_recording_cut_command(*command),
      make_recording_cat_command(*command),    make_recording_export_command(*command),
      make_recording_import_command(*command), make_recording_repair_command(*command),
      make_recording_verify_command(*command)};
  return {command, [commands] {
            for (const Command& each : commands) {
              if (each.app->parsed()) return each.run();
            }
            return kExitUsage;
          }};
}

}  // namespace skerry::client

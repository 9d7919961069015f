// Parts that the subcommands of `skerry recording` share, and the list of them.
#pragma once

#include <optional>
#include <string>

#include "clients/cli/command.hpp"
#include "clients/cli/console.hpp"
#include "clients/recording/recording_output.hpp"
#include "protocol/recording/reader.hpp"
#include "protocol/recording/writer.hpp"

namespace skerry::client {

// `recording` is the command they are subcommands of.
Command make_recording_info_command(CLI::App& recording);
Command make_recording_cut_command(CLI::App& recording);
Command make_recording_cat_command(CLI::App& recording);
Command make_recording_export_command(CLI::App& recording);
Command make_recording_import_command(CLI::App& recording);
Command make_recording_repair_command(CLI::App& recording);
Command make_recording_verify_command(CLI::App& recording);

// How a new recording is packed.
struct PackingOptions {
  std::string compression = "zstd";
  bool compact = false;
  int zstd_level = 3;

  void add_options(CLI::App& command);
  recording::WriterOptions writer_options() const;
};

// A part of a recording, as positions.
struct PartOptions {
  std::string from, to;

  void add_options(CLI::App& command);
};
struct Part {
  std::optional<UtcTime> from, to;
};
// Error: what is wrong with them.
Result<Part, std::string> part_of(const PartOptions& options, const recording::Summary& summary);

// "importing [#####     ] 50 %" on stderr while it lasts; false once Ctrl-C was pressed.
class ProgressBar {
 public:
  explicit ProgressBar(std::string what) : what_(std::move(what)) {}
  bool show(double share);
  void clear() { progress_.clear(); }
  // For those who want a function; the bar outlives it.
  recording::RecordingReader::Progress function() {
    return [this](double share) { return show(share); };
  }

 private:
  std::string what_;
  Progress progress_;
};

// nullopt after an error, which has been reported.  Reports a damaged file on stderr.
std::optional<recording::RecordingReader> open_recording(const std::string& path);

// "FILE: byte N: ..." and what to try; kExitFailure.
int report(const recording::RecordingError& error, const std::string& advice = {});

// -o and --force.
void add_output(CLI::App& command, std::string& output, bool& force);

// Whether both names are of one file that is there.
bool same_file(const std::string& a, const std::string& b);

// Finishes and puts in place; reports what went wrong.  The exit code.
int finish(recording::RecordingWriter& writer, RecordingOutput& output);

}  // namespace skerry::client

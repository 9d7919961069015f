// skerry recording export: pictures, tables, captures, files for other tools.
#include <fmt/format.h>

#include <charconv>
#include <filesystem>
#include <memory>

#include "clients/cli/live/spoke_line.hpp"
#include "clients/cli/recording/recording_command.hpp"
#include "clients/interchange/foxglove_export.hpp"
#include "clients/interchange/ros2_export.hpp"
#include "clients/recording/recorded_turns.hpp"
#include "clients/signals/output_file.hpp"
#include "protocol/captures/exporter.hpp"
#include "protocol/picture/picture_file.hpp"
#include "protocol/wire/printable_text.hpp"

namespace skerry::client {
namespace {

struct ExportOptions {
  std::string file, output;
  std::string png, pcap;  // a turn or "all"; "cat240" or "navico"
  std::string tool;       // "foxglove" or "ros2"
  bool csv = false, cells = false, head_up = false, green = false, force = false;
  std::string model = "halo20";
  std::uint32_t radar = 0, view = 0;
  PartOptions part;
  PpiOptions picture;
};

int refuse_usage(const std::string& text) {
  report(text);
  return kExitUsage;
}

// Nothing: all turns.
std::optional<std::uint64_t> turn_of(const std::string& text) {
  std::uint64_t turn = 0;
  std::from_chars(text.data(), text.data() + text.size(), turn);
  return text == "all" ? std::nullopt : std::optional(turn);
}

std::string turn_or_all(const std::string& text) {
  const bool digits = !text.empty() && text.size() < 10 &&
                      text.find_first_not_of("0123456789") == std::string::npos && text != "0";
  return text == "all" || digits
             ? std::string()
             : fmt::format("'{}' is neither a turn (1 is the first) nor 'all'", printable(text));
}

// "turns.png" -> "turns-0003.png".
std::string numbered(const std::string& file, std::uint64_t number) {
  const std::filesystem::path path(file);
  return (path.parent_path() /
          fmt::format("{}-{:04}{}", path.stem().string(), number, path.extension().string()))
      .string();
}

int exists(const ExportOptions& options, const std::string& path) {
  return report(fmt::format("{} {}; give another name with -o{}", printable(path),
                            same_file(options.file, path) ? "is the recording itself" : "exists",
                            options.force ? "" : ", or --force to replace it"));
}

// Without --force nothing is replaced, and the recording itself never is.
bool may_write(const ExportOptions& options, const std::string& path) {
  std::error_code error;
  if (same_file(options.file, path)) return false;
  return options.force || !std::filesystem::exists(path, error);
}

// The written file takes its place when it is whole; a pipe or device, which no file can replace,
// is written at once.  Errors: as of RecordingOutput and OutputFile.
class ExportFile {
 public:
  ExportFile(const std::string& path, bool replace) {
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    if (std::filesystem::is_other(status)) {
      stream_.emplace(path);
    } else {
      // A link stays one: what it leads to is replaced.
      const bool link = std::filesystem::exists(status) && std::filesystem::is_symlink(path, error);
      file_.emplace(link ? std::filesystem::canonical(path).string() : path, replace);
    }
    held_.reserve(kHeld);
  }
  void write(std::span<const std::uint8_t> bytes) {
    held_.insert(held_.end(), bytes.begin(), bytes.end());
    if (held_.size() >= kHeld) flush();
  }
  void write(std::string_view text) {
    write({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  }
  void close() {
    flush();
    if (stream_) {
      stream_->close();
    } else {
      file_->commit();
    }
  }

 private:
  static constexpr std::size_t kHeld = 256 << 10;
  void flush() {
    if (stream_) {
      stream_->write(held_);
    } else if (!file_->sink()(held_)) {
      file_->commit();  // throws what is wrong
    }
    held_.clear();
  }

  std::optional<OutputFile> stream_;
  std::optional<RecordingOutput> file_;  // one of them
  Bytes held_;
};

PpiOptions picture_of(const ExportOptions& options) {
  PpiOptions picture = options.picture;
  picture.orientation = options.head_up ? Orientation::head_up : Orientation::north_up;
  picture.palette = options.green ? Palette::green : Palette::amber;
  return picture;
}

void write_turn(const ExportOptions& options, const RecordedTurn& turn, const std::string& path) {
  ExportFile file(path, options.force);
  file.write(encode_png(draw_ppi(turn.scan, picture_of(options), turn.labels),
                        describe(turn.scan, turn.labels.radar)));
  file.close();
}

void warn(ProgressBar& bar, const std::string& text) {
  if (text.empty()) return;
  bar.clear();
  fmt::print(stderr, "skerry: {}\n", text);
}

int export_pngs(const ExportOptions& options, const recording::RecordingReader& reader,
                const RecordedPart& part) {
  const auto wanted = turn_of(options.png);
  const std::string file = options.output.empty() ? "turn.png" : options.output;
  ProgressBar bar(wanted ? "looking for the turn" : "drawing");
  RecordedTurns turns(reader, part, bar.function());
  std::uint64_t written = 0, seen = 0;
  while (auto turn = turns.next()) {
    seen = turn->number;
    if (wanted && turn->number != *wanted) continue;
    const std::string path = wanted ? file : numbered(file, turn->number);
    if (!may_write(options, path)) return exists(options, path);
    write_turn(options, *turn, path);
    ++written;
    if (wanted) {
      warn(bar, turns.not_read().text());
      write_out(fmt::format("{}: turn {}, {} of {} spokes\n", printable(path), turn->number,
                            turn->scan.received, turn->scan.geometry.spokes_per_turn));
      return kExitOk;
    }
  }
  if (interrupted()) return report(fmt::format("interrupted after {} pictures", written));
  warn(bar, turns.not_read().text());
  if (seen == 0) {
    return report({reader.summary().file, 0, no_spokes_text(reader.summary(), part)});
  }
  if (wanted) return report(fmt::format("there is no turn {}; the last one is {}", *wanted, seen));
  write_out(fmt::format("{} to {}: {} turns\n", printable(numbered(file, 1)),
                        printable(numbered(file, seen)), written));
  return kExitOk;
}

int export_csv(const ExportOptions& options, const recording::RecordingReader& reader,
               const RecordedPart& part) {
  const LineFormat format = options.cells ? LineFormat::hex : LineFormat::csv;
  if (!options.output.empty() && !may_write(options, options.output)) {
    return exists(options, options.output);
  }
  std::optional<ExportFile> file;
  if (!options.output.empty()) file.emplace(options.output, options.force);
  const auto write = [&](const std::string& text) { file ? file->write(text) : write_out(text); };
  ProgressBar bar("writing");
  write(heading_line(format));
  const auto done = each_spoke(
      reader, part, [&](Spoke spoke) { write(format_line(line_of(std::move(spoke)), format)); },
      bar.function());
  if (!done) return report(done.error());
  warn(bar, done->not_read.text());
  if (!file) return kExitOk;
  file->close();
  write_out(fmt::format("{}: {} spokes\n", printable(options.output), done->spokes));
  return kExitOk;
}

int export_pcap(const ExportOptions& options, const recording::RecordingReader& reader,
                const RecordedPart& part) {
  const std::string path = options.output.empty() ? options.pcap + ".pcap" : options.output;
  if (!may_write(options, path)) return exists(options, path);
  captures::ExportOptions what;
  what.format =
      options.pcap == "navico" ? captures::ExportFormat::navico : captures::ExportFormat::cat240;
  what.model = options.model == "4g"     ? navico::Model::g4
               : options.model == "halo" ? navico::Model::halo
                                         : navico::Model::halo20;
  what.radar = part.radar;
  what.view = part.view;
  what.from = part.from;
  what.to = part.to;
  ExportFile file(path, options.force);
  pcap::PcapWriter out([&](std::span<const std::uint8_t> bytes) { file.write(bytes); });
  ProgressBar bar("writing");
  const auto done = captures::export_capture(reader, what, out, bar.function());
  if (!done) return report(done.error());
  file.close();
  if (done->spokes_cut > 0) {
    warn(bar, fmt::format("{} spokes reach further than such a radar can say: cells were cut off",
                          done->spokes_cut));
  }
  warn(bar, NotRead{done->spokes_refused, done->chunks_damaged}.text());
  write_out(fmt::format("{}: {} spokes in {} datagrams\n", printable(path), done->spokes,
                        done->datagrams));
  return kExitOk;
}

int export_for_tool(const ExportOptions& options, const recording::RecordingReader& reader,
                    const RecordedPart& part) {
  const std::string path = options.output.empty() ? options.tool + ".mcap" : options.output;
  if (!may_write(options, path)) return exists(options, path);
  ExportFile file(path, options.force);
  const auto sink = [&](std::span<const std::uint8_t> bytes) {
    file.write(bytes);
    return true;
  };
  ProgressBar bar("writing");
  std::string written;
  NotRead not_read;
  if (options.tool == "foxglove") {
    const auto done = write_foxglove(reader, part, picture_of(options), sink, bar.function());
    if (!done) return report(done.error());
    not_read = done->not_read;
    written = fmt::format("{} pictures, {} positions, tracks of ships {} times", done->pictures,
                          done->fixes, done->tracks);
  } else {
    const auto done = write_ros2(reader, part, sink, bar.function());
    if (!done) return report(done.error());
    not_read = done->not_read;
    written = fmt::format("{} spokes in {} sectors, {} positions, {} headings", done->spokes,
                          done->sectors, done->fixes, done->headings);
  }
  file.close();
  warn(bar, not_read.text());
  write_out(fmt::format("{}: {}\n", printable(path), written));
  return kExitOk;
}

int run_export(const ExportOptions& options) {
  const int kinds =
      !options.png.empty() + options.csv + !options.pcap.empty() + !options.tool.empty();
  if (kinds != 1) return refuse_usage("give exactly one of --png, --csv, --pcap and --for");
  const auto reader = open_recording(options.file);
  if (!reader) return kExitFailure;
  const auto bounds = part_of(options.part, reader->summary());
  if (!bounds) return report(bounds.error());
  const RecordedPart part{options.radar, options.view, bounds->from, bounds->to};
  if (!options.png.empty()) return export_pngs(options, *reader, part);
  if (!options.tool.empty()) return export_for_tool(options, *reader, part);
  return options.csv ? export_csv(options, *reader, part) : export_pcap(options, *reader, part);
}

}  // namespace

Command make_recording_export_command(CLI::App& recording) {
  auto options = std::make_shared<ExportOptions>();
  CLI::App* command = recording.add_subcommand(
      "export", "Writes pictures, tables or captures of a recording, or files for other tools");
  command->add_option("FILE", options->file, "The recording")->required();
  command
      ->add_option("--png", options->png,
                   "A turn as a picture: its number from --from on, 1 "
                   "is the first; or 'all'")
      ->check(CLI::Validator(turn_or_all, "TURN|all"));
  command->add_flag("--csv", options->csv, "A line per spoke");
  command->add_flag("--cells", options->cells, "With --csv: the cells too, in hexadecimal digits");
  command->add_option("--pcap", options->pcap, "A capture of that protocol: cat240 or navico")
      ->check(CLI::IsMember({"cat240", "navico"}));
  command->add_option("--model", options->model, "With --pcap navico: halo20, halo or 4g")
      ->check(CLI::IsMember({"halo20", "halo", "4g"}))
      ->capture_default_str();
  command
      ->add_option("--for", options->tool,
                   "An MCAP file with the schemas of other tools: foxglove (a picture each turn, "
                   "positions, tracks) or ros2 (spokes as RadarSector, positions, headings)")
      ->check(CLI::IsMember({"foxglove", "ros2"}));
  command->add_option("--radar", options->radar, "Index of the radar")->capture_default_str();
  command->add_option("--view", options->view, "Index of the view")->capture_default_str();
  options->part.add_options(*command);
  command->add_option("-o,--output", options->output,
                      "The file; default: turn.png, standard output, the protocol's name .pcap, or "
                      "the tool's name .mcap");
  command->add_flag("--force", options->force, "Replace it if it is there");
  command->add_option("--size", options->picture.size, "Width and height of pictures in pixels")
      ->check(CLI::Range(kMinPictureSize, kMaxPictureSize))
      ->capture_default_str();
  command->add_flag("--head-up", options->head_up, "The bow at the top instead of north");
  command->add_flag("--green", options->green, "Green echoes instead of yellow ones");
  command->footer(
      "Examples:\n"
      "  skerry recording export exercise.mcap --png 3 -o turn.png\n"
      "  skerry recording export exercise.mcap --png all --from 1:30 --to 2:00 -o turns.png\n"
      "  skerry recording export exercise.mcap --csv --radar 1 -o spokes.csv\n"
      "  skerry recording export exercise.mcap --pcap cat240 -o video.pcap\n"
      "  skerry recording export exercise.mcap --pcap navico --model 4g -o radar.pcap\n"
      "  skerry recording export exercise.mcap --for foxglove -o look.mcap\n"
      "  skerry recording export exercise.mcap --for ros2 -o bag.mcap\n");
  return {command, [options] { return run_export(*options); }};
}

}  // namespace skerry::client

// skerry recording import.
#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "clients/cli/recording/recording_command.hpp"
#include "protocol/captures/importer.hpp"
#include "protocol/wire/printable_text.hpp"

namespace skerry::client {
namespace {

struct ImportOptions {
  std::string file, output;
  PackingOptions packing;
  bool force = false;
};

// "captures/halo.pcapng.gz" -> "halo.mcap", in the working folder.
std::string output_name(const std::string& file) {
  std::string name = std::filesystem::path(file).filename().string();
  for (const std::string_view ending : {".gz", ".pcap", ".pcapng", ".cap"}) {
    if (name.size() > ending.size() && name.ends_with(ending)) {
      name.erase(name.size() - ending.size());
    }
  }
  return name + ".mcap";
}

std::string radar_text(std::size_t number, const captures::ImportedRadar& radar) {
  const captures::FittedCounts& counts = radar.counts;
  std::string out = fmt::format(
      "  radar {}: {}, {} spokes of {} cells in {} ranges{}\n", number,
      printable(radar.picture.name), counts.spokes, radar.picture.cells, counts.at_reach_dm.size(),
      radar.picture.rpm > 0.0 ? fmt::format(", {:.1f} rpm", radar.picture.rpm) : "");
  const auto note = [&](std::uint64_t count, std::string_view what) {
    if (count > 0) out += fmt::format("    {} {}\n", count, what);
  };
  note(counts.missing, "spokes are missing from the capture");
  note(counts.range_unknown, "spokes told no range: they have that of their neighbours");
  note(counts.padded, "spokes had fewer than 128 cells: empty ones follow");
  note(counts.thinned, "spokes had more than 4096 cells: the peaks were kept");
  note(counts.refused, "spokes were left out: a reach below 14.5 m or above 192 NM");
  note(radar.picture.refused, "datagrams could not be read: " + printable(radar.picture.refusal));
  if (counts.magnetic) out += "    its headings are magnetic\n";
  return out;
}

int run_import(const ImportOptions& options) {
  const std::string path = options.output.empty() ? output_name(options.file) : options.output;
  if (same_file(options.file, path)) {
    return report("the recording would replace its capture; give another name with -o");
  }
  RecordingOutput output(path, options.force);
  recording::RecordingWriter writer(output.sink(), options.packing.writer_options());
  ProgressBar bar("importing");
  const auto done = captures::import_capture_file(options.file, writer, bar.function());
  if (!done) {
    return report(done.error(), "Captures are pcap or pcapng, packed by gzip or not.");
  }
  finish(writer, output);
  if (done->damage) {
    fmt::print(stderr, "skerry: {}; what is before it was imported\n",
               printable(done->damage->to_string(), 2000));
  }
  if (done->left_out > 0) {
    fmt::print(stderr, "skerry: {} datagrams of more than {} radars were left out\n",
               done->left_out, captures::kMaxPictures);
  }
  std::string text = fmt::format("{}: {:.1f} MB\n", printable(output.path()),
                                 static_cast<double>(output.bytes()) / 1e6);
  for (std::size_t i = 0; i < done->radars.size(); ++i) text += radar_text(i, done->radars[i]);
  write_out(text);
  return kExitOk;
}

}  // namespace

Command make_recording_import_command(CLI::App& recording) {
  auto options = std::make_shared<ImportOptions>();
  CLI::App* command =
      recording.add_subcommand("import", "Makes a recording of a capture of a real radar");
  command->add_option("CAPTURE", options->file, "pcap or pcapng, packed by gzip or not")
      ->required();
  command->add_option("-o,--output", options->output,
                      "The recording; default: the capture's name with .mcap, here");
  command->add_flag("--force", options->force, "Replace it if it is there");
  options->packing.add_options(*command);
  command->footer(
      "Examples:\n"
      "  skerry recording import halo.pcapng.gz\n"
      "  skerry recording import quantum.pcap -o quantum.mcap && skerry play quantum.mcap\n"
      "Read are Navico (BR24, 3G, 4G, HALO), Garmin xHD, Raymarine Quantum and E-120, and ASTERIX\n"
      "CAT240, with own ship from NMEA 0183 where it is in the capture.\n");
  return {command, [options] { return run_import(*options); }};
}

}  // namespace skerry::client

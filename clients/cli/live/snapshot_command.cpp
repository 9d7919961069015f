// skerry snapshot: one turn of a radar as a picture.
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <variant>

#include "clients/cli/command.hpp"
#include "clients/cli/console.hpp"
#include "protocol/picture/picture_file.hpp"
#include "protocol/picture/ppi_picture.hpp"
#include "protocol/video/scan.hpp"

namespace skerry::client {
namespace {

// A turn with spokes missing or with two range scales is not what was asked for; after so many
// whole turns it is better than nothing.
constexpr int kAttempts = 3;

struct SnapshotOptions {
  ServerPlace place;
  ViewChoice choice;
  PpiOptions picture;
  bool head_up = false;
  bool green = false;
  std::optional<std::uint32_t> scan;
  std::string file = "skerry.png";
  std::string raw_file;
};

// A scan and what its labels need, or why there is none.
struct Snapshot {
  Scan scan;
  PpiLabels labels;
};

class Photographer {
 public:
  Photographer(SpokeClient& client, const SnapshotOptions& options)
      : client_(client), options_(options) {}

  // nullopt after an error, which has been reported.
  std::optional<Snapshot> run() {
    auto last_spoke = Clock::now();
    while (!interrupted()) {
      auto event = client_.receive(kLookAround);
      if (!event) {
        report(event.error());
        return std::nullopt;
      }
      if (*event) {
        if (std::holds_alternative<Spoke>(**event)) last_spoke = Clock::now();
        if (auto scan = take(**event)) return Snapshot{std::move(*scan), std::move(labels_)};
        if (failed_) return std::nullopt;
      } else {
        progress_.show(progress_text());
      }
      if (Clock::now() - last_spoke > options_.place.timeout()) {
        report(
            fmt::format("no spokes of radar {} from {} for {:g} s", options_.choice.radar,
                        client_.name(), options_.place.timeout_s),
            "skerry status shows whether the radar is turning; is skerryd running? Start it with "
            "server/run.");
        return std::nullopt;
      }
    }
    report("interrupted before the turn was whole; nothing was written");
    return std::nullopt;
  }

 private:
  std::optional<Scan> take(ClientEvent& event) {
    if (auto* settings = std::get_if<wire::Settings>(&event)) labels_.settings = *settings;
    if (auto* ship = std::get_if<wire::OwnShip>(&event)) labels_.own_ship = *ship;
    auto* spoke = std::get_if<Spoke>(&event);
    if (!spoke) return std::nullopt;
    if (!first_) {
      first_ = spoke->header;
      if (is_past(spoke->header)) return std::nullopt;
    }
    if (spoke->header.index % 64 == 0) progress_.show(progress_text());
    auto finished = assembler_.feed(std::move(*spoke));
    return finished && is_wanted(*finished) ? std::move(finished) : std::nullopt;
  }

  bool is_past(const SpokeHeader& header) {
    if (!options_.scan || header.scan < *options_.scan ||
        (header.scan == *options_.scan && header.index == 0)) {
      return false;
    }
    report(fmt::format("scan {} is past: radar {} of {} is in scan {}", *options_.scan,
                       options_.choice.radar, client_.name(), header.scan),
           fmt::format("Ask for a later one, such as --scan {}.", header.scan + 2));
    failed_ = true;
    return true;
  }

  bool is_wanted(const Scan& scan) {
    if (options_.scan) {
      if (scan.number < *options_.scan) return false;
      if (scan.number == *options_.scan) return true;
      report(fmt::format("scan {} was lost on the way from {}", *options_.scan, client_.name()));
      failed_ = true;
      return false;
    }
    if (scan.is_complete() && scan.has_one_range_scale()) return true;
    const bool whole_turn = scan.number != first_->scan || first_->index == 0;
    return whole_turn && ++attempts_ >= kAttempts;
  }

  std::string progress_text() const {
    const Scan& scan = assembler_.unfinished();
    const Spoke* newest = scan.newest();
    if (!newest) return fmt::format("waiting for {}", client_.name());
    const auto percent = 100 * (newest->header.index + 1) / scan.geometry.spokes_per_turn;
    if (options_.scan && scan.number < *options_.scan) {
      return fmt::format("scan {}, waiting for scan {}", scan.number, *options_.scan);
    }
    if (!options_.scan && scan.number == first_->scan && first_->index != 0) {
      return fmt::format("scan {}, {} %, waiting for the next", scan.number, percent);
    }
    return fmt::format("scan {}, {} %", scan.number, percent);
  }

  SpokeClient& client_;
  const SnapshotOptions& options_;
  ScanAssembler assembler_;
  PpiLabels labels_;
  std::optional<SpokeHeader> first_;
  int attempts_ = 0;
  bool failed_ = false;
  Progress progress_;
};

std::string radar_name(const wire::Hello& hello, std::uint32_t radar) {
  for (const auto& info : hello.radars()) {
    if (info.radar() == radar) return info.name();
  }
  return {};
}

void write_pictures(const Snapshot& snapshot, const SnapshotOptions& options) {
  PpiOptions picture = options.picture;
  picture.orientation = options.head_up ? Orientation::head_up : Orientation::north_up;
  picture.palette = options.green ? Palette::green : Palette::amber;
  const RgbaImage image = draw_ppi(snapshot.scan, picture, snapshot.labels);
  write_file(options.file, encode_png(image, describe(snapshot.scan, snapshot.labels.radar)));
  if (!options.raw_file.empty()) write_file(options.raw_file, encode_pgm(snapshot.scan));
}

int run_snapshot(const SnapshotOptions& options) {
  for (const std::string& file : {options.file, options.raw_file}) {
    const auto folder = std::filesystem::path(file).parent_path();
    if (!folder.empty() && !std::filesystem::is_directory(folder)) {
      return report(fmt::format("cannot write {}: there is no folder {}", file, folder.string()));
    }
  }
  auto client = options.place.connect();
  if (!client) return report(client.error());
  const auto subscribed =
      client->subscribe(options.choice.radar, options.choice.view, options.place.timeout());
  if (!subscribed) return report(subscribed.error());
  auto snapshot = Photographer(*client, options).run();
  if (!snapshot) return kExitFailure;
  snapshot->labels.radar = radar_name(client->hello(), options.choice.radar);
  write_pictures(*snapshot, options);
  const Scan& scan = snapshot->scan;
  if (scan.missing() > 0) {
    fmt::print(stderr, "skerry: {} of the {} spokes were lost; they are grey\n", scan.missing(),
               scan.geometry.spokes_per_turn);
  }
  if (!scan.has_one_range_scale()) {
    fmt::print(stderr, "skerry: the range scale changed during the turn\n");
  }
  write_out(fmt::format("{}: radar {}, scan {}, {} spokes of {} cells\n", options.file, scan.radar,
                        scan.number, scan.received, scan.geometry.cells));
  return kExitOk;
}

}  // namespace

Command make_snapshot_command(CLI::App& app) {
  auto options = std::make_shared<SnapshotOptions>();
  CLI::App* command = app.add_subcommand("snapshot", "Writes one whole turn of a radar as a PNG");
  options->place.add_options(*command);
  command->add_option("--radar", options->choice.radar, "Index of the radar")
      ->capture_default_str();
  command->add_option("--view", options->choice.view, "Index of the view")->capture_default_str();
  command->add_option("--size", options->picture.size, "Width and height in pixels")
      ->check(CLI::Range(kMinPictureSize, kMaxPictureSize))
      ->capture_default_str();
  command->add_flag("--head-up", options->head_up, "The bow at the top instead of north");
  command->add_flag("--green", options->green, "Green echoes instead of yellow ones");
  command->add_flag("!--no-rings", options->picture.range_rings, "Without range rings");
  command->add_flag("!--no-heading-line", options->picture.heading_line, "Without heading line");
  command->add_flag("!--no-labels", options->picture.labels, "Without text");
  command->add_option("--scan", options->scan,
                      "Exactly this scan, which must not have begun; default: the next whole one");
  command->add_option("-o,--output", options->file, "The PNG file")->capture_default_str();
  command->add_option("--raw", options->raw_file,
                      "Also the bare cells as PGM: a row per spoke from the bow clockwise, a pixel "
                      "per cell from the ship outwards");
  command->footer(
      "Examples:\n"
      "  skerry snapshot -o radar.png\n"
      "  skerry snapshot --radar 1 --head-up --size 2048 -o bridge.png\n"
      "  skerry snapshot --raw cells.pgm\n"
      "A turn takes 1 to 5 s; from the middle of one, up to two are needed.\n");
  return {command, [options] { return run_snapshot(*options); }};
}

}  // namespace skerry::client

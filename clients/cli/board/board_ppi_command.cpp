// skerry board ppi: one turn of a board's sweeps as a radar picture.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <variant>

#include "clients/cli/board/board_command.hpp"
#include "clients/cli/board/board_turn.hpp"
#include "clients/cli/board/board_words.hpp"
#include "clients/cli/console.hpp"
#include "protocol/picture/picture_file.hpp"
#include "protocol/picture/ppi_picture.hpp"

namespace skerry::client {
namespace {

struct BoardPpiOptions {
  BoardPlace place;
  PpiOptions picture;
  std::string channel = "A";
  std::optional<double> range_nm;
  std::optional<std::uint32_t> spokes;
  bool head_up = false, green = false;
  std::string file = "board.png";
};

// The own ship's heading and position, and the range scale, of the radar's ordinary video: a board
// knows nothing of the world.
class ShipWatch {
 public:
  explicit ShipWatch(SpokeClient client) : client_(std::move(client)) {}

  // Waits until all is known.  Error: of the client; timed_out.
  ClientResult<Done> begin(std::uint32_t radar, Duration timeout) {
    if (auto subscribed = client_.subscribe(radar, 0, timeout); !subscribed) return subscribed;
    const auto end = std::chrono::steady_clock::now() + timeout;
    while (!own_ship_ || !settings_) {
      if (std::chrono::steady_clock::now() > end) {
        return Failure{ClientError{ClientErrorKind::timed_out,
                                   client_.name() + " did not say where the own ship is in time"}};
      }
      if (auto taken = take(kLookAround); !taken) return Failure{taken.error()};
    }
    return Done{};
  }

  // Takes what has come.
  ClientResult<Done> refresh() {
    for (;;) {
      auto taken = take({});
      if (!taken) return Failure{taken.error()};
      if (!*taken) return Done{};
    }
  }

  TrueBearing heading() const { return heading_; }
  GeoPoint position() const { return position_; }
  double range_nm() const { return settings_->range_nm(); }
  const wire::OwnShip& own_ship() const { return *own_ship_; }

 private:
  ClientResult<bool> take(Duration timeout) {
    auto event = client_.receive(timeout);
    if (!event) return Failure{event.error()};
    if (!*event) return false;
    if (auto* ship = std::get_if<wire::OwnShip>(&**event)) {
      own_ship_ = *ship;
      if (std::isfinite(ship->heading_deg())) {
        heading_ = TrueBearing::from(degrees(ship->heading_deg()));
      }
      position_ = {ship->latitude_deg(), ship->longitude_deg()};
    }
    if (auto* settings = std::get_if<wire::Settings>(&**event)) settings_ = *settings;
    if (auto* spoke = std::get_if<Spoke>(&**event)) {
      heading_ = spoke->header.heading;
      position_ = spoke->header.own_ship;
    }
    return true;
  }

  SpokeClient client_;
  TrueBearing heading_;
  GeoPoint position_;
  std::optional<wire::OwnShip> own_ship_;
  std::optional<wire::Settings> settings_;
};

struct Turn {
  Scan scan;
  std::uint32_t faults = 0;  // of all its sweeps
};

// nullopt after an error, which has been reported.
std::optional<Turn> take_turn(BoardClient& client, ShipWatch& ship, const BoardPpiOptions& options,
                              RangeScale range) {
  const std::size_t channel = options.channel == "B" ? 1 : 0;
  PatientReader reader(client, options.place, "sweeps of channel " + options.channel);
  std::optional<TurnAssembler> assembler;
  std::uint32_t spokes = 0;
  Progress progress;
  while (auto record = reader.next()) {
    auto* const sweep = std::get_if<board::Sweep>(&record->record);
    if (!sweep || sweep->samples[channel].empty()) continue;
    reader.came();
    if (auto known = ship.refresh(); !known) {
      report(known.error());
      return std::nullopt;
    }
    if (!assembler) {
      spokes =
          options.spokes.value_or(spokes_that_fit(sweep->meta, client.radar().spokes_per_turn()));
      assembler.emplace(
          ScanGeometry{.spokes_per_turn = spokes,
                       .cells = std::clamp(client.radar().cells(), ScanGeometry::kMinCells,
                                           ScanGeometry::kMaxCells),
                       .bits = 8},
          range, channel);
    }
    if (auto scan = assembler->feed(*sweep, ship.heading(), ship.position())) {
      return Turn{std::move(*scan), assembler->faults()};
    }
    progress.show(assembler->received() == 0
                      ? "waiting for the bow"
                      : fmt::format("{} %", 100 * assembler->received() / spokes));
  }
  return std::nullopt;
}

// Whether the channel has a radar; if not, it has been reported: its sweeps would never come.
bool channel_is_on(BoardClient& client, const BoardPpiOptions& options) {
  const std::uint32_t channel = options.channel == "B" ? 1 : 0;
  const auto source =
      client.access({{.address = board::channel_address(board::Reg::source_a, channel)}},
                    options.place.timeout());
  if (!source) {
    report_board(source.error());
    return false;
  }
  if (source->front().value != 0) return true;
  report(fmt::format("channel {0} is off: SOURCE_{0} is 0", options.channel),
         fmt::format("skerry board set SOURCE_{}={}", options.channel, options.place.radar + 1));
  return false;
}

int run_board_ppi(const BoardPpiOptions& options) {
  const auto folder = std::filesystem::path(options.file).parent_path();
  if (!folder.empty() && !std::filesystem::is_directory(folder)) {
    return report(
        fmt::format("cannot write {}: there is no folder {}", options.file, folder.string()));
  }
  auto spoke_client = options.place.server.connect();
  if (!spoke_client) return report(spoke_client.error());
  ShipWatch ship(std::move(spoke_client).value());
  if (auto begun = ship.begin(options.place.radar, options.place.timeout()); !begun) {
    return report(begun.error());
  }
  const auto range = RangeScale::find(options.range_nm.value_or(ship.range_nm()));
  if (!range) {
    report(fmt::format("{:g} NM is no range scale", options.range_nm.value_or(ship.range_nm())),
           "There are 0.125, 0.25, 0.5, 0.75, 1.5, 3, 6, 12, 24, 48, 72 and 96 NM.");
    return kExitUsage;
  }
  auto client = options.place.connect();
  if (!client) return report_board(client.error());
  if (!channel_is_on(*client, options)) return kExitFailure;
  if (auto begun = options.place.start(*client, BoardStreamKind::records); !begun) {
    return report_board(begun.error());
  }
  const auto turn = take_turn(*client, ship, options, *range);
  if (!turn) return kExitFailure;
  const Scan& scan = turn->scan;

  PpiOptions picture = options.picture;
  picture.orientation = options.head_up ? Orientation::head_up : Orientation::north_up;
  picture.palette = options.green ? Palette::green : Palette::amber;
  PpiLabels labels;
  labels.radar = fmt::format("{} BOARD {}", client->radar().name(), options.channel);
  labels.own_ship = ship.own_ship();
  labels.formed_of_pulses = true;
  labels.warning = fault_label(turn->faults);
  write_file(options.file,
             encode_png(draw_ppi(scan, picture, labels), describe(scan, labels.radar)));
  if (scan.missing() > 0) {
    fmt::print(stderr, "skerry: no pulse in {} spokes of {}; they are grey\n", scan.missing(),
               scan.geometry.spokes_per_turn);
  }
  if (client->records_lost() > 0) {
    fmt::print(stderr, "skerry: {} records were lost\n", client->records_lost());
  }
  write_out(fmt::format("{}: board of radar {}, channel {}, turn {}, {} spokes\n", options.file,
                        scan.radar, options.channel, scan.number, scan.received));
  if (turn->faults != 0) write_out(labels.warning + "\n");
  return kExitOk;
}

}  // namespace

Command make_board_ppi_command(CLI::App& board) {
  auto options = std::make_shared<BoardPpiOptions>();
  CLI::App* command =
      board.add_subcommand("ppi", "Writes one turn of sweeps, formed to spokes, as a PNG");
  options->place.add_options(*command);
  options->place.add_stream_option(*command);
  command->add_option("--channel", options->channel, "A or B")
      ->check(CLI::IsMember({"A", "B"}))
      ->capture_default_str();
  command->add_option("--range", options->range_nm, "Range scale, NM; default: the radar's own");
  command
      ->add_option("--spokes", options->spokes,
                   "Spokes of a turn; default: as the radar has, or fewer if its pulses are")
      ->check(CLI::Range(ScanGeometry::kMinSpokes, ScanGeometry::kMaxSpokes));
  command->add_option("--size", options->picture.size, "Width and height in pixels")
      ->check(CLI::Range(kMinPictureSize, kMaxPictureSize))
      ->capture_default_str();
  command->add_flag("--head-up", options->head_up, "The bow at the top instead of north");
  command->add_flag("--green", options->green, "Green echoes instead of yellow ones");
  command->add_option("-o,--output", options->file, "The PNG file")->capture_default_str();
  command->footer(
      "The pulses of a spoke are averaged, the largest code of the converter is drawn brightest.\n"
      "Examples:\n"
      "  skerry board ppi -o board.png\n"
      "  skerry board ppi --range 6 --stream shm -o board.png\n"
      "  skerry snapshot -o radar.png                     (the same radar's own video)\n");
  return {command, [options] { return run_board_ppi(*options); }};
}

}  // namespace skerry::client

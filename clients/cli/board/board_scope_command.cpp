// skerry board scope: one sweep in the terminal, or as a picture.
#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>

#include "clients/cli/board/board_command.hpp"
#include "clients/cli/board/board_scope.hpp"
#include "clients/cli/board/board_words.hpp"
#include "clients/cli/console.hpp"
#include "clients/cli/number_within.hpp"
#include "protocol/picture/picture_file.hpp"
#include "protocol/quantity/length.hpp"

namespace skerry::client {
namespace {

struct ScopeOptions {
  BoardPlace place;
  std::optional<double> azimuth_deg, from_nm, to_nm;
  std::optional<int> columns, rows;
  PictureSize size;
  std::string file;
};

// A sweep and the edges around its trigger.
struct Captured {
  board::Sweep sweep;
  std::vector<board::Edge> edges;
};

// Whether the antenna passed `wanted` between two sweeps.
bool passed(double wanted_deg, double before_deg, double now_deg) {
  const double turned = std::fmod(now_deg - before_deg + 360.0, 360.0);
  return turned < 180.0 && std::fmod(wanted_deg - before_deg + 360.0, 360.0) <= turned;
}

class Capture {
 public:
  Capture(BoardClient& client, const ScopeOptions& options)
      : reader_(client, options.place, "sweeps"),
        options_(options),
        signals_until_(std::chrono::steady_clock::now() + options.place.timeout()) {}

  // nullopt after an error, which has been reported.
  std::optional<Captured> run() {
    while (!sweep_ || !signals_complete()) {
      auto record = reader_.next();
      if (!record) return std::nullopt;
      if (auto* sweep = std::get_if<board::Sweep>(&record->record)) take(*sweep);
      if (auto* edges = std::get_if<board::Edges>(&record->record)) take(*edges);
    }
    return Captured{std::move(*sweep_), std::move(edges_)};
  }

 private:
  void take(board::Sweep& sweep) {
    reader_.came();
    if (sweep_) return;
    const double azimuth = azimuth_deg(sweep.meta);
    const bool wanted = (!options_.azimuth_deg ||
                         (azimuth_ && passed(*options_.azimuth_deg, *azimuth_, azimuth))) &&
                        signals_begun(sweep.meta);
    if (!wanted) progress_.show(fmt::format("azimuth {:.1f} deg", azimuth));
    azimuth_ = azimuth;
    if (wanted) sweep_ = std::move(sweep);
  }

  // Keeps the edges of the last few milliseconds: the sweep that will be shown is not known yet.
  void take(const board::Edges& edges) {
    if (!sweep_ && edges_.size() > 2 * board::kMaxEdges) {
      edges_.erase(edges_.begin(), edges_.begin() + board::kMaxEdges);
    }
    if (!edges_from_ || edges.from_tick != edges_to_) edges_from_ = edges.from_tick;
    edges_.insert(edges_.end(), edges.edges.begin(), edges.edges.end());
    edges_to_ = edges.to_tick;
  }

  // The text needs none; the picture needs those on both sides of the trigger, but they are
  // not waited for longer than for a sweep.
  bool signals_do_without() const {
    return options_.file.empty() || std::chrono::steady_clock::now() > signals_until_;
  }
  bool signals_begun(const board::SweepMeta& meta) const {
    return signals_do_without() ||
           (edges_from_ && meta.trigger_tick >= *edges_from_ + signal_span(meta));
  }
  bool signals_complete() const {
    return signals_do_without() ||
           edges_to_ >= sweep_->meta.trigger_tick + signal_span(sweep_->meta);
  }

  PatientReader reader_;
  const ScopeOptions& options_;
  std::chrono::steady_clock::time_point signals_until_;
  std::optional<board::Sweep> sweep_;
  std::optional<double> azimuth_;
  std::vector<board::Edge> edges_;
  std::optional<std::uint64_t> edges_from_;
  std::uint64_t edges_to_ = 0;
  Progress progress_;
};

TextSize terminal_size(const ScopeOptions& options) {
  TextSize size;
  winsize window{};
  if (::ioctl(STDOUT_FILENO, TIOCGWINSZ, &window) == 0 && window.ws_col > 0 && window.ws_row > 0) {
    size = {window.ws_col, window.ws_row - 1};  // the prompt comes below
  }
  return {options.columns.value_or(size.columns), options.rows.value_or(size.rows)};
}

int run_scope(const ScopeOptions& options) {
  const auto folder = std::filesystem::path(options.file).parent_path();
  if (!folder.empty() && !std::filesystem::is_directory(folder)) {
    return report(
        fmt::format("cannot write {}: there is no folder {}", options.file, folder.string()));
  }
  auto client = options.place.connect_stream(BoardStreamKind::records);
  if (!client) return report_board(client.error());
  const auto captured = Capture(*client, options).run();
  if (!captured) return kExitFailure;
  const board::Sweep& sweep = captured->sweep;
  ScopeWindow window = whole_window(sweep.meta);
  if (options.from_nm) window.from_m = nautical_miles(*options.from_nm).in_metres();
  if (options.to_nm) window.to_m = nautical_miles(*options.to_nm).in_metres();
  if (!(window.to_m > window.from_m)) {
    report(fmt::format("nothing lies between {:g} and {:g} NM",
                       metres(window.from_m).in_nautical_miles(),
                       metres(window.to_m).in_nautical_miles()),
           "--from must be less than --to and than the end of the sweep.");
    return kExitUsage;
  }
  if (options.file.empty()) {
    write_out(draw_scope_text(sweep, window, terminal_size(options)));
    return kExitOk;
  }
  PngText text;
  for (const std::string& line : scope_lines(sweep.meta)) text.emplace_back("Comment", line);
  const RgbaImage image = draw_scope_picture(sweep, captured->edges, window, options.size);
  write_file(options.file, encode_png(image, text));
  write_out(fmt::format("{}: {}\n", options.file, scope_lines(sweep.meta).front()));
  return kExitOk;
}

}  // namespace

Command make_board_scope_command(CLI::App& board) {
  auto options = std::make_shared<ScopeOptions>();
  CLI::App* command = board.add_subcommand("scope", "Shows one sweep, here or as a PNG");
  options->place.add_options(*command);
  options->place.add_stream_option(*command);
  command
      ->add_option("--azimuth", options->azimuth_deg,
                   "The first sweep past this azimuth, degrees from the ARP; default: the next one")
      ->check(number_within(0.0, 360.0));
  command->add_option("--from", options->from_nm, "Nearest range shown, NM; default: 0")
      ->check(number_within(0.0, 1000.0));
  command->add_option("--to", options->to_nm, "Farthest range shown, NM; default: all")
      ->check(number_within(0.0, 1000.0));
  command->add_option("--columns", options->columns, "Width in characters; default: the terminal's")
      ->check(CLI::Range(kMinTextSize.columns, kMaxTextSize.columns));
  command->add_option("--rows", options->rows, "Height in lines; default: the terminal's")
      ->check(CLI::Range(kMinTextSize.rows, kMaxTextSize.rows));
  command->add_option("-o,--output", options->file,
                      "A PNG file instead, with the digital signals around the trigger");
  command->add_option("--width", options->size.width, "Of the PNG, pixels")
      ->check(CLI::Range(kMinScopePicture.width, kMaxScopePicture.width))
      ->capture_default_str();
  command->add_option("--height", options->size.height, "Of the PNG, pixels")
      ->check(CLI::Range(kMinScopePicture.height, kMaxScopePicture.height))
      ->capture_default_str();
  command->footer(
      "Each column shows the lowest and the highest code of its samples.\n"
      "Examples:\n"
      "  skerry board scope\n"
      "  skerry board scope --azimuth 90 --to 3\n"
      "  skerry board scope -o sweep.png --stream shm\n");
  return {command, [options] { return run_scope(*options); }};
}

}  // namespace skerry::client

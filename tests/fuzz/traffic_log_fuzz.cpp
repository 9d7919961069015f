// Readers of AIS logs: of sentences and of tables, down to the scenario that is made of them.
#include <string_view>

#include "server/traffic_logs/csv_log.hpp"
#include "server/traffic_logs/line_splitter.hpp"
#include "server/traffic_logs/nmea_log.hpp"
#include "server/traffic_logs/traffic_fragment.hpp"
#include "server/world/scenario.hpp"
#include "tests/fuzz/fuzz_require.hpp"

namespace {

using namespace skerry;

// What is left of a log is one that a scenario reads, whatever stood in it.
void check_book(server::TrackBook& book, double tolerance_m) {
  const auto ships = book.finish();
  for (const auto& ship : ships) {
    std::int64_t reached_ms = 0;
    for (const auto& piece : ship.pieces) {
      fuzz::require(piece.fixes.size() >= 2, "a piece has a begin and an end");
      fuzz::require(piece.fixes.size() <= server::TrackBook::kMostFixes, "a piece is bounded");
      fuzz::require(piece.worst_m <= tolerance_m, "no fix is off by more than the tolerance");
      fuzz::require(piece.fixes.front().utc_ms >= reached_ms, "pieces follow on each other");
      for (std::size_t i = 1; i < piece.fixes.size(); ++i) {
        fuzz::require(piece.fixes[i].utc_ms > piece.fixes[i - 1].utc_ms, "times grow");
      }
      reached_ms = piece.fixes.back().utc_ms;
    }
  }
  // Logs of more than 69 days need --from and --until: the exercise is not longer.
  const auto made = server::traffic_fragment(ships, {}, {}, "fuzz");
  if (made.targets == 0 || made.length_min > 99'000.0) return;
  const auto scenario = server::parse_scenario(
      "name: a\nown_ships: [{name: \" own\", position: {lat: 0, lon: 0}, radars: [{}]}]\n" +
          made.yaml,
      "fuzz.yaml");
  fuzz::require(static_cast<std::size_t>(scenario.targets_size()) == made.targets,
                "every piece is a target");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  constexpr double kTolerance_m = 30.0;
  server::TrackBook book(server::TrackRules{.tolerance_m = kTolerance_m});
  server::NmeaLog log(book);
  server::LineSplitter lines(server::NmeaLog::kLongestLine);
  std::uint64_t count = 0;
  const auto take = [&](std::string_view line) {
    ++count;
    log.take(line);
    // With the checksum put right: otherwise few lines would be read any further.
    const std::size_t begin = line.find('!');
    if (begin == std::string_view::npos) return;
    const std::string between(line.substr(begin + 1, line.find('*', begin) - begin - 1));
    ++count;
    log.take(std::string(line.substr(0, begin)) + "!" + between + "*" +
             nmea::checksum_text(between));
  };
  lines.feed(text, take, [&] { ++count; });
  lines.finish(take);
  log.finish();
  fuzz::require(log.sentences() + book.left_out().all() <= 4 * count + 64 * 10,
                "what is counted is bounded by the lines");
  check_book(book, kTolerance_m);

  const std::string_view header = text.substr(0, text.find('\n'));
  if (!server::CsvLog::is_header(header)) return 0;
  server::TrackBook table_book(server::TrackRules{.tolerance_m = kTolerance_m});
  auto table = server::CsvLog::open(header, table_book);
  if (!table) {
    fuzz::require(!table.error().empty(), "a refusal says why");
    return 0;
  }
  server::LineSplitter rows(server::CsvLog::kLongestRow);
  const auto take_row = [&](std::string_view row) { table->take(row); };
  rows.feed(text.substr(header.size()), take_row, [] {});
  rows.finish(take_row);
  check_book(table_book, kTolerance_m);
  return 0;
}

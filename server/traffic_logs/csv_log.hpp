// CsvLog: a table of AIS positions, row by row, into tracks.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/quantity/result.hpp"
#include "server/traffic_logs/track_book.hpp"

namespace skerry::server {

// Columns go by the names in the first row, in any order, whatever case and signs between words;
// those without a known name are passed over.  The names of the Danish Maritime Authority and of
// MarineCadastre (both of its headers) are among them: README.md has them all.
// Fields end at ',', ';' or a tab, whichever the first row has most of, and may be quoted.
// Thread: one at a time.
class CsvLog {
 public:
  static constexpr std::size_t kLongestRow = 16'384;

  // `header`: the first row.  Error: which column is missing; expected are mmsi, time, lat, lon.
  static Result<CsvLog, std::string> open(std::string_view header, TrackBook& book);
  // Whether a text's first row may be a header: it names an mmsi.
  static bool is_header(std::string_view row);

  void take(std::string_view row);

  std::uint64_t rows() const { return rows_; }  // with a fix of a ship or who she is

 private:
  enum Column : std::uint8_t {
    mmsi,
    time,
    latitude,
    longitude,
    course,
    heading,
    name,
    type,
    length,
    beam,
    ais_class,
    to_bow,
    to_stern,
    to_port,
    to_starboard,
    kColumns
  };
  CsvLog(TrackBook& book, char separator) : book_(&book), separator_(separator) {}
  std::string_view field(Column column) const;
  std::optional<double> number(Column column) const;
  double size_of(Column whole, Column one, Column other) const;

  TrackBook* book_;
  char separator_;
  std::array<std::optional<std::size_t>, kColumns> places_ = {};
  std::vector<std::string> fields_;  // of the row that is being read
  std::uint64_t rows_ = 0;
};

}  // namespace skerry::server

// PieceReader: what comes next of a recording, in pieces that are played at one moment.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "protocol/recording/reader.hpp"
#include "protocol/video/spoke.hpp"
#include "server/playback/recorded_radars.hpp"

namespace skerry::server {

// A spoke of nobody else's, which may be changed until it is shared.
using OwnSpokePtr = std::shared_ptr<Spoke>;

// Consecutive spokes of a radar and view, or one item of another kind.
struct Piece {
  UtcTime time{};          // when it is due: that of the item, or of the last spoke
  recording::Topic topic;  // with the playback's number of the radar, the recording's of the view
  std::vector<OwnSpokePtr> spokes;  // of Kind::spoke; the same numbers
  std::vector<UtcTime> times;       // when each of them is due: their own, unless the file differs
  std::vector<std::uint8_t> bytes;  // of the others
};

// Spokes that cannot be read are left out and counted, damaged parts of the file passed over.
// Memory: the cursor's, and kMostSpokes of each view.
// Thread: one at a time.
class PieceReader {
 public:
  static constexpr std::size_t kMostSpokes = 16;

  PieceReader(const recording::RecordingReader& reader, const RecordedRadars& radars);

  // Continues with the first item at `time` or later.
  void seek(UtcTime time);
  // The most recorded time in a piece.
  void set_span(Duration span) { span_ = span; }
  // The next piece that is due before `until`; nothing at the end, or if there is none.
  std::optional<Piece> next(std::optional<UtcTime> until = std::nullopt);

  // Describes the parts that could not be read so far; faults() counts them.
  std::string problem() const;
  std::uint64_t faults() const { return unreadable_ + cursor_.chunks_damaged(); }

 private:
  using ViewKey = std::pair<std::uint32_t, std::uint32_t>;  // radar, view

  // An item that can be read, or its spoke; as in a piece.
  struct Read {
    UtcTime time{};
    recording::Topic topic;
    OwnSpokePtr spoke;
    std::vector<std::uint8_t> bytes;
  };
  std::optional<Read> read();
  void make_ready(Piece& gathered);
  void make_all_ready();

  std::map<std::uint32_t, std::uint32_t> played_;  // radars, by recorded number
  recording::ItemCursor cursor_;
  Duration span_ = std::chrono::milliseconds(40);
  std::deque<Piece> ready_;
  std::map<ViewKey, Piece> pending_;  // spokes of less than a sector
  std::optional<Read> held_;          // read, but not yet taken in
  std::uint64_t unreadable_ = 0;
  std::string first_unreadable_;
  wire::Spoke message_;
};

}  // namespace skerry::server

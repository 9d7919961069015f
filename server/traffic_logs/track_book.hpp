// TrackBook: the tracks of the ships in a log, thinned while it is read.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "server/traffic_logs/heard_ship.hpp"
#include "server/traffic_logs/left_out.hpp"
#include "server/traffic_logs/thinned_track.hpp"

namespace skerry::server {

struct TrackRules {
  struct Area {
    GeoPoint centre;
    double radius_m = 0.0;
  };
  std::optional<UtcTime> from = {}, until = {};
  std::optional<Area> area = {};
  double tolerance_m = 30.0;                // of every fix used
  Duration gap = std::chrono::minutes(15);  // a longer one ends a track
};

// What a ship sailed without a gap: two fixes or more.
struct LoggedPiece {
  std::vector<LogFix> fixes;
  std::optional<double> heading_deg = {};  // at the first fix; else her course
  std::uint64_t heard = 0;                 // fixes that it is made of
  double worst_m = 0.0;                    // that one of them is off
};

struct LoggedShip {
  HeardIdentity identity;
  std::vector<LoggedPiece> pieces;  // in the order of time
  std::uint64_t heard = 0;          // fixes in them
};

// Fixes of one ship must come in the order of time; those of different ships need not.  Three in
// turn that agree with each other and are before the track being made, in a time of which none is
// finished, begin a track anew: so one fix dated ahead does not cost the rest of the log.  What is
// not used is counted.  Memory grows with the ships (kBlock fixes of each wait) and with the fixes
// that are kept, not with the log.  Thread: one at a time.
class TrackBook {
 public:
  static constexpr std::size_t kBlock = 256;  // fixes thinned together
  static constexpr std::size_t kMostShips = 50'000;
  static constexpr std::size_t kMostFixes = 1000;  // of a piece, as a scenario allows waypoints
  static constexpr double kMostSpeed_kn = 60.0;    // with more a fix is a jump
  // Strays that agree with each other are the ship: a track begins anew with the last of them.
  static constexpr unsigned kStraysThatAgree = 3;

  explicit TrackBook(const TrackRules& rules) : rules_(rules) {}

  void take(const HeardFix& fix);
  void take(const HeardIdentity& identity);
  // Whether the ship has been told of already.
  bool knows(std::uint32_t mmsi) const { return ships_.contains(mmsi); }

  LeftOutCounts& left_out() { return left_out_; }
  const LeftOutCounts& left_out() const { return left_out_; }
  std::uint64_t fixes() const { return used_; }  // used so far, single ones too

  // The ships that have sailed, by MMSI.  Once; what comes later is not theirs.
  std::vector<LoggedShip> finish();

 private:
  // Fixes in turn that do not fit the track.
  struct Doubted {
    LogFix last;
    unsigned count = 0;  // that agree with each other
    // Whether so many do, with this one, that they are right.
    bool agree_with(const LogFix& fix);
  };
  struct Ship {
    HeardIdentity identity;
    std::vector<LoggedPiece> pieces;  // in the order of time, none within another's
    LoggedPiece piece;                // being made
    std::vector<LogFix> block;        // begins with the piece's last fix, once it has one
    std::optional<LogFix> last;       // used
    Doubted strays;                   // too far away
    Doubted backs;                    // before the piece being made

    bool has_finished(std::int64_t utc_ms) const;
    // Whether a finished piece begins after the last fix and not after that time.
    bool has_begun_since_last(std::int64_t utc_ms) const;
    void finish(LoggedPiece done);
  };
  Ship* ship_of(std::uint32_t mmsi);
  void begin_piece(Ship& ship, const LogFix& fix, const HeardFix& heard);
  void take_earlier(Ship& ship, const LogFix& fix, const HeardFix& heard);
  void thin_block(Ship& ship);
  void end_piece(Ship& ship);

  TrackRules rules_;
  std::map<std::uint32_t, Ship> ships_;
  LeftOutCounts left_out_;
  std::uint64_t used_ = 0;
};

}  // namespace skerry::server

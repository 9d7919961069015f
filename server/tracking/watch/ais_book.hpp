// AisBook: what AIS has told, and where those targets are by now.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>

#include "server/plotter/tracks/ground_plane.hpp"
#include "server/tracking/watch/approach_guard.hpp"
#include "server/tracking/watch/target_watch.hpp"
#include "server/tracking/watch/zones.hpp"

namespace skerry::server {

struct AisRecord {
  AisContact contact;       // as last told; the name fit to be shown
  double interval_s = 0.0;  // between its reports, lately; 0: there was one
  bool is_activated = false;
  bool is_lost = false;    // it was activated, and is not told of any more
  bool is_listed = false;  // near enough, and fresh or told of as lost
  bool is_known = false;   // from before the last update
  ZoneTable::Mask zones = 0;
  ApproachGuard guard;
  std::uint32_t target = 0;  // that it is taken to be; 0: none

  // By now, as it was going; from own ship, and over ground in the plane around her.
  double age_s = 0.0;
  PlanePoint from_own_ship;
  std::optional<PlanePoint> motion_mps;
  std::optional<PlottedApproach> approach;
};

// Fresh are targets whose last report is no older than three of their usual intervals, kLeastFresh
// at least and kMostFresh at most; those that are slower than kSlow, or of which there is but one
// report, kMostFresh: at anchor they report every three minutes (from memory, not verified).
class AisBook {
 public:
  static constexpr std::size_t kMostListed = 240, kMostKnown = 4000;
  static constexpr double kReach_m = 48.0 * 1852.0;
  static constexpr double kIntervals = 3.0, kLeastFresh_s = 60.0, kMostFresh_s = 360.0;
  static constexpr double kSlow_mps = 3.0 * 1852.0 / 3600.0;

  // What is not of this Earth, or of another hour, is left out.
  void take(std::span<const AisContact> contacts, UtcTime now);
  // Of own ship at the plane's anchor.  The nearest kMostListed are listed: of fresh ones, and of
  // those that were listed until now.
  void place(const GroundPlane& plane, const std::optional<PlanePoint>& own_over_ground_mps,
             UtcTime now);

  static bool is_fresh(const AisRecord& record);
  std::map<std::uint32_t, AisRecord>& records() { return records_; }
  // nullptr: no such target is listed.
  AisRecord* find(std::uint32_t mmsi);
  const AisRecord* find(std::uint32_t mmsi) const;
  std::uint32_t left_out() const { return left_out_; }
  void clear() { *this = {}; }

 private:
  static void place(AisRecord& record, const GroundPlane& plane,
                    const std::optional<PlanePoint>& own_over_ground_mps, UtcTime now);
  void forget_old_ones();
  void leave_out_far_ones();

  std::map<std::uint32_t, AisRecord> records_;  // by MMSI
  std::uint32_t left_out_ = 0;
};

}  // namespace skerry::server

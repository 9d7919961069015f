// What a baseline has told, written down scan by scan.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "echo/chart/local_plane.hpp"
#include "server/plotter/judge/scans_jsonl.hpp"
#include "server/plotter/judge/truth_and_told.hpp"

namespace skerry::server {

class ToldBook {
 public:
  explicit ToldBook(const echo::LocalPlane& plane) : plane_(plane) {}

  void tell(std::size_t number, double utc_s, ToldStatus status, PlanePoint place,
            std::optional<PlanePoint> velocity_mps);
  Told told(std::string name);

 private:
  const echo::LocalPlane& plane_;
  std::map<std::size_t, ToldTrack> tracks_;
};

// The plane about where own ship began.
echo::LocalPlane plane_of(const std::vector<DetectionScan>& scans);
// The scan's plots on that plane.
std::vector<PlanePoint> places_of(const DetectionScan& scan, const echo::LocalPlane& plane);

}  // namespace skerry::server

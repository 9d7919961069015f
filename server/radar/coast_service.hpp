// CoastService: keeps the coast around every radar ready, off the radar threads.
#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "echo/chart/chart_source.hpp"
#include "echo/scene/coast_picture.hpp"
#include "echo/scene/polar_index.hpp"
#include "echo/scene/structure_index.hpp"
#include "server/core/latest.hpp"

namespace skerry::server {

// What a radar wants to see: the coast around a place, as fine as it can tell apart.
struct CoastWish {
  GeoPoint own_ship;
  double speed_mps = 0.0;
  echo::RadarResolution resolution;
};

// The coast around an own ship and the index by which a place on it is looked up.  The picture is
// good for as far as its slack says, the index for a shorter way; neither changes what the other
// shows.
struct CoastInSight {
  echo::CoastPicturePtr picture;
  std::shared_ptr<const echo::PolarIndex> index;
  std::shared_ptr<const echo::StructureIndex> structure_index;  // null: nothing is built there
  PlanePoint index_centre;
  double index_slack_m = 0.0;
};
using CoastInSightPtr = std::shared_ptr<const CoastInSight>;

// How far an own ship may sail before the index is made anew: a longer way costs each look-up more,
// a shorter one than a few seconds' makes the coast thread late.
double index_slack_for(double range_m, double speed_mps);

// The index of what is built on a picture's coast, or null.
std::shared_ptr<const echo::StructureIndex> structures_in_sight(const echo::CoastPicture& picture,
                                                                PlanePoint own_ship,
                                                                double slack_m);

// Loads chart windows, refines the coast and indexes it on a thread of its own ("coast"), one wish
// per slot outstanding: a newer wish replaces one not yet begun.  The radar goes on with what it
// has.
class CoastService {
 public:
  // With a slot for each of `radars`.
  // Error: std::invalid_argument as echo::require_valid() for the styles of `rules`.
  CoastService(std::unique_ptr<const echo::ChartSource> chart, std::size_t radars,
               const echo::CoastRules& rules);
  ~CoastService();
  CoastService(const CoastService&) = delete;
  CoastService& operator=(const CoastService&) = delete;

  // A further slot, for echoes besides the radars'.  It lasts as long as the service and costs
  // nothing until something is asked for it.  Thread: any.
  std::size_t add_slot();

  // Makes the first picture of a radar on the caller's thread, before start().
  // Error: std::runtime_error if the chart cannot be read.
  void prepare_now(std::size_t radar, const CoastWish& wish);
  void start();

  // Thread: the one that looks at the slot.  Never waits for the work.  Wishes of slots of a lower
  // number, the radars' first of all, are served first.
  void ask(std::size_t slot, const CoastWish& wish);
  CoastInSightPtr latest(std::size_t slot) const { return find(slot).in_sight.get(); }

 private:
  struct Slot {
    std::optional<CoastWish> wish;                  // guarded by mutex_
    std::unique_ptr<echo::CoastPreparer> preparer;  // the service's thread
    echo::RadarResolution made_for;                 // the service's thread
    Latest<CoastInSight> in_sight;
  };
  Slot& find(std::size_t slot) const;
  void serve(Slot& slot, const CoastWish& wish);
  void work(const std::stop_token& stop);

  std::unique_ptr<const echo::ChartSource> chart_;
  echo::CoastRules rules_;
  mutable std::mutex mutex_;
  std::vector<std::unique_ptr<Slot>> slots_;  // guarded by mutex_; each stays where it is
  std::condition_variable_any wished_;
  std::jthread thread_;
};

}  // namespace skerry::server

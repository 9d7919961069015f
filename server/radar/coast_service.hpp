// CoastService: keeps the coast around every radar ready, off the radar threads.
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "server/core/latest.hpp"
#include "server/radar/picture_maker.hpp"

namespace skerry::server {

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
  // Ends the thread when it has done what it is at.  Looks and surveys that wait are called with
  // nothing, from the caller's thread; so are those asked for later, at once.  Not to be started
  // again.
  void stop();

  // Thread: the one that looks at the slot.  Never waits for the work.  Wishes of slots of a lower
  // number, the radars' first of all, are served first.
  void ask(std::size_t slot, const CoastWish& wish);
  // The chart itself, for the simulation; `done` is called once, from the service's thread, or with
  // nothing at once if kMaxSurveys wait already.  Served after wishes.  A chart that cannot be
  // read: nothing too.
  static constexpr std::size_t kMaxSurveys = 8;
  using SurveyDone = std::function<void(std::optional<echo::CoastChart>)>;
  void survey(GeoPoint centre, Length radius, SurveyDone done);
  // Looks at the chart itself, for clients; `look` is called once, from the service's thread, or
  // with null at once if kMaxLooks wait already.  Served after wishes and surveys, so that clients
  // who keep asking keep nothing from them.  What it throws is logged.  One that is called with
  // null must not ask again from within.
  static constexpr std::size_t kMaxLooks = 8;
  using Look = std::function<void(const echo::ChartSource*)>;
  void look(Look look);
  CoastInSightPtr latest(std::size_t slot) const { return find(slot).in_sight.get(); }

 private:
  struct Slot {
    Slot(const echo::ChartSource& chart, const echo::CoastRules& rules) : maker(chart, rules) {}
    std::optional<CoastWish> wish;  // guarded by mutex_
    PictureMaker maker;             // this and the next two: the service's thread
    echo::RadarResolution made_for;
    PictureOrigin origin;
    Latest<CoastInSight> in_sight;
  };
  Slot& find(std::size_t slot) const;
  void queue(std::deque<Look>& waiting, std::size_t most, Look look);
  static void call(const Look& look, const echo::ChartSource* chart);
  static void serve(Slot& slot, const CoastWish& wish);
  void work(const std::stop_token& stop);

  std::unique_ptr<const echo::ChartSource> chart_;
  echo::CoastRules rules_;
  mutable std::mutex mutex_;
  std::vector<std::unique_ptr<Slot>> slots_;  // guarded by mutex_; each stays where it is
  std::deque<Look> surveys_, looks_;          // guarded by mutex_
  bool stopped_ = false;                      // guarded by mutex_
  std::condition_variable_any wished_;
  std::jthread thread_;
};

}  // namespace skerry::server

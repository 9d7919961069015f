// RadarUnit: one antenna, its thread and its views.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <limits>
#include <string>
#include <thread>
#include <vector>

#include "server/core/latest.hpp"
#include "server/radar/airwaves.hpp"
#include "server/radar/coast_keeper.hpp"
#include "server/radar/input_sink.hpp"
#include "server/radar/radar_view.hpp"
#include "server/radar/sector_maker.hpp"
#include "server/radar/tables_ahead.hpp"
#include "server/world/timeline.hpp"

namespace skerry::server {

// When scenario time 0 was, on the clocks outside.
struct Epoch {
  std::chrono::steady_clock::time_point steady;
  UtcTime utc;
  // Radars are taken up then: sectors that end before are not theirs to make, and not counted.
  ScenarioTime taken_up = {};
};

struct RadarCounters {
  std::uint64_t sectors = 0;          // that the antenna has passed, in standby too
  std::uint64_t spokes = 0;           // published
  std::uint64_t spokes_late = 0;      // in sectors published more than a sector after their end
  std::uint64_t sectors_skipped = 0;  // never made: the radar was more than kGiveUp late
  double lateness_max_ms = 0.0;       // of a sector, after its end
  double render_ns_per_cell = 0.0;    // mean of the last 64 sectors
  std::uint32_t scan = 0;
  std::uint32_t coast_edges = 0;
};

// Turns the antenna by absolute deadlines: the sector of spokes n .. n+15 is made when the antenna
// has passed it and is published at once.  A radar that falls behind by kGiveUp leaves sectors out
// and counts them; it never hurries and never drifts.
//
// Rotation rate, antenna height, alignment and blanked sectors may change at any time, and act from
// a sector's begin on.  Spokes are counted on, whatever the rate.
//
// All views show what is on the air: view 0's range scale is the radar's, others show at most as
// far.  In standby the antenna's clock goes on, and nothing is made nor sent.
class RadarUnit {
 public:
  static constexpr std::uint32_t kSectorSpokes = SectorMaker::kSectorSpokes;
  static constexpr std::chrono::milliseconds kGiveUp{500};

  // The references must outlive the unit.  `workers` threads help with each sector (0: none).
  // `inputs` is told what each sector was made of; may be null.
  RadarUnit(const RadarConfig& config, Timeline& timeline, CoastService& coast, Airwaves& airwaves,
            std::size_t workers, InputSink* inputs = nullptr);
  ~RadarUnit() { stop(); }

  // Once in a unit's life.  Of an epoch that is taken up late, turns and the shared view's
  // spokes are numbered as if the antenna had turned since time 0 as it does now.  Cost: some 50 ns
  // for each sector until then.
  void start(const Epoch& epoch);
  // Spokes are stamped by it from the next sector on.  Thread: any.
  void set_utc(const UtcClock& clock) { utc_.set(clock); }
  // Scenario time 0 is so much later than the epoch said: the clock of hosts that share an exercise
  // is followed.  Later, and radars wait; sooner, and they leave out what they are late for.
  // Thread: any.
  void shift_epoch(Duration by) { shift_.store(by.count()); }
  // Spokes are made until then; after it the antenna turns on, and counts, without them: another
  // host makes them.  At first for ever.  Who takes over makes no sector that ended before, nor
  // within kTakeOver: the other has made it, by a clock that may be so much ahead.  Thread: one at
  // a time.
  static constexpr std::chrono::milliseconds kTakeOver{50};
  void make_spokes_until(std::chrono::steady_clock::time_point end);
  // Before start(): makes what the first sector needs and would make late.  Cost: 60 ms or so for
  // the first radar of a set, less for others like it.
  void warm_up();
  void stop();

  const RadarConfig& config() const { return config_; }
  // Thread: any.
  RadarViewList& views() { return views_; }
  const RadarViewList& views() const { return views_; }
  echo::RadarControls radar_controls() const { return *radar_controls_.get(); }
  void set_radar_controls(const echo::RadarControls& controls) { radar_controls_.set(controls); }
  // The set as its controls have it: rotation and antenna height.
  echo::RadarSet set_on_air() const;
  // The range scale of the present controls.
  RangeScale range_on_air() const { return views_.get()->front()->controls.get()->range_scale; }
  const echo::Pulse& pulse_on_air() const {
    return config_.set.pulse_for(range_on_air(), radar_controls().pulse);
  }
  RadarCounters counters() const;

  // The coast that the unit asks for on that range scale at that place (SectorMaker::wish).
  CoastWish wish(const ShipState& own_ship, RangeScale range) const;

 private:
  void run(const std::stop_token& stop, const Epoch& epoch);
  // Gathers the inputs of the sector that begins with spoke `first`.  False if the world is too far
  // behind to be shown.
  bool gather(std::uint64_t first);
  // The views and their controls.
  void look_at_views();
  // What goes on the air in this sector: the range scale asked for as soon as its coast is there
  // and its tables are made, until then `shown`.
  RangeScale range_to_show(RangeScale shown);
  // True if there is something to be published.
  bool make_sector(std::uint64_t first);
  // Of a sector that ended then.
  bool is_made_here(std::chrono::steady_clock::time_point now,
                    std::chrono::steady_clock::time_point end) const;
  // A sector that another host makes, of which the others' receivers hear here, too.
  void leave_to_another_host(std::uint64_t first);
  void publish(std::uint64_t first, const Epoch& epoch,
               std::chrono::steady_clock::time_point begun);
  void skip(std::uint64_t first);

  RadarConfig config_;
  Timeline& timeline_;
  CoastKeeper coast_keeper_;
  Airwaves& airwaves_;
  InputSink* inputs_;
  SectorMaker maker_;
  TablesAhead tables_ahead_;
  RadarViewList views_;
  Latest<echo::RadarControls> radar_controls_;
  Latest<UtcClock> utc_;
  // The present sector's.  Thread: the unit's.
  std::shared_ptr<const RadarViews> shown_;  // as in given_.views
  SectorInputs given_;
  std::vector<ViewSector> made_;
  double mean_ns_ = 0.0;  // per cell

  std::atomic<std::int64_t> shift_{0};
  // Of the steady clock: sectors that end after the one are made before the other.
  std::atomic<std::int64_t> made_from_{std::numeric_limits<std::int64_t>::min()},
      made_until_{std::numeric_limits<std::int64_t>::max()};
  std::atomic<std::uint64_t> sectors_{0}, spokes_{0}, spokes_late_{0}, sectors_skipped_{0};
  std::atomic<std::int64_t> lateness_max_ns_{0};
  std::atomic<double> render_ns_per_cell_{0.0};
  std::atomic<std::uint32_t> scan_{0}, coast_edges_{0};
  std::jthread thread_;
};

}  // namespace skerry::server

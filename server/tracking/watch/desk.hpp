// TargetWatch::Desk: all that is watched, as of the last update.
#pragma once

#include <deque>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "server/tracking/watch/ais_book.hpp"
#include "server/tracking/watch/alert_list.hpp"
#include "server/tracking/watch/approach_guard.hpp"
#include "server/tracking/watch/motion_frame.hpp"
#include "server/tracking/watch/past_places.hpp"
#include "server/tracking/watch/target_watch.hpp"
#include "server/tracking/watch/told_target.hpp"
#include "server/tracking/watch/zones.hpp"

namespace skerry::server {

class TargetWatch::Desk {
 public:
  Desk(std::uint32_t radar, std::uint32_t view);

  wire::Reply order(const wire::TargetOrder& order, Plotter& plotter);
  void update(const OwnSensors& own, std::span<const AisContact> ais, Plotter& plotter);
  const wire::TargetList& list() const { return list_; }
  const wire::TargetRules& rules() const { return rules_; }

 private:
  static constexpr Duration kNoVideo = std::chrono::seconds(5);     // since the antenna went on
  static constexpr Duration kFrozenFor = std::chrono::seconds(60);  // then dropped
  static constexpr Duration kLongestStep = std::chrono::minutes(3);
  static constexpr const char* kReference = "reference target";  // a lost input's name
  static constexpr std::size_t kMostLost = 50;
  static constexpr double kReachLeast_m = 150.0, kReachShare = 0.03;  // of the range

  struct Watched {
    PlottedTrack track;
    bool is_dropped = false;  // frozen for too long; the plotter may still have it
    bool is_known = false;    // from before the last update
    ZoneTable::Mask zones = 0;
    ApproachGuard guard;
    bool is_dangerous = false;  // by the guard, or by that of the AIS target it is
    PastPlaces past;
    std::optional<PlottedApproach> approach;  // absent: its motion is not known
    std::uint32_t mmsi = 0;                   // that it is taken to be; 0: none
  };
  struct Lost {
    PlottedTrack track;
    UtcTime seen{};
    std::uint32_t mmsi = 0;
    std::string name;
  };
  struct TrialRun {
    wire::TrialOrder order;
    UtcTime begins{};
  };

  // desk_orders.cpp
  std::optional<wire::Reply> refusal_of(const wire::TargetOrder& order,
                                        const Plotter& plotter) const;
  std::optional<wire::Reply> refusal_of_values(const wire::TargetOrder& order) const;
  std::optional<wire::Reply> refusal_of_zones(const wire::TargetOrder& order) const;
  std::optional<wire::Reply> refusal_of_cancel(const wire::TargetOrder& order,
                                               const Plotter& plotter) const;
  std::optional<wire::Reply> refusal_of_reference(const wire::TargetOrder& order) const;
  std::optional<wire::Reply> refusal_of_ais(const wire::TargetOrder& order) const;
  std::optional<wire::Reply> refusal_of_alerts(const wire::TargetOrder& order) const;
  std::optional<wire::Reply> refusal_of_acquisition(const wire::TargetOrder& order) const;
  std::optional<wire::Reply> refusal_of_trial(const wire::TargetOrder& order) const;
  wire::Reply acquire(const wire::TargetOrder::Acquire& where, Plotter& plotter) const;
  void change_rules(const wire::TargetOrder& order, Plotter& plotter);
  // All but the one just acquired may be cancelled.
  void change_targets(const wire::TargetOrder& order, std::uint32_t acquired, Plotter& plotter);
  void cancel(std::uint32_t number, Plotter& plotter);
  void set_reference(std::uint32_t number);

  // desk.cpp
  void end_what_hangs_on_time();
  void watch_inputs();
  void watch_input(const std::string& name, bool is_there, bool is_needed, const std::string& text);
  void take_tracks(Plotter& plotter);
  void take_lost(const std::vector<PlottedTrack>& lost, bool all_anew);
  bool is_worth_a_warning(const Watched& watched) const;
  void put_aside(const Watched& watched);
  void forget_acknowledged_ones();
  void freeze_or_thaw(bool is_video);
  void keep_past();

  // desk_ais.cpp
  void watch_ais(std::span<const AisContact> ais);
  void tell_lost_ais();
  void pair_with_ais();
  void set_partner(Watched& watched, std::uint32_t mmsi);

  // desk_alerts.cpp
  void watch_zones();
  void watch_approaches();
  void watch_capacity(std::uint64_t left_out);
  void set_alert(bool is_on, AlertKind kind, const AlertSubject& subject, const std::string& text);

  // desk_list.cpp
  void tell(Plotter& plotter);
  void tell_target(const Watched& watched);
  void tell_motion(const Watched& watched, wire::Target& target) const;
  void tell_lost_targets();
  void tell_test_targets();
  void tell_ais();
  void tell_trial();
  void tell_own_ship();
  std::string problem() const;

  bool has_motion(const Watched& watched) const;
  ApproachLimits limits() const;
  const Watched* find_watched(std::uint32_t number) const;
  MotionFrame frame_now() const;
  static AlertSubject subject_of_target(std::uint32_t number) { return {number, 0, {}}; }
  static AlertSubject subject_of(const Watched& watched) {
    return subject_of_target(watched.track.number);
  }
  static AlertSubject subject_of(const AisRecord& record) { return {0, record.contact.mmsi, {}}; }
  std::string name_of(const Watched& watched) const;

  wire::TargetRules rules_;
  ZoneTable zones_;
  AlertList alerts_;
  AisBook ais_;
  std::map<std::uint32_t, Watched> targets_;  // by number
  std::deque<Lost> lost_;
  std::uint32_t reference_ = 0;
  std::optional<TrialRun> trial_;
  bool test_targets_ = false;
  std::optional<UtcTime> test_targets_since_;  // absent: the next update begins them
  std::map<std::string, bool> inputs_;         // that were there once

  bool has_time_ = false;
  UtcTime now_{};
  OwnSensors own_;
  std::optional<GroundPlane> plane_;  // around own ship; absent: her place is not known
  MotionFrame frame_;
  ScenarioTime pass_{};            // of the antenna, the last one
  std::optional<UtcTime> passed_;  // the update that saw it
  bool is_video_ = true;
  std::optional<UtcTime> frozen_since_, thawed_;
  std::uint64_t resets_ = 0, left_out_ = 0;
  std::optional<UtcTime> left_one_out_;
  bool is_near_capacity_ = false;

  wire::TargetList list_;
};

}  // namespace skerry::server

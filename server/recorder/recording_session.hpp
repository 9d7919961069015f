// RecordingSession: one recording, from its start to its stop.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "server/core/exercise_inputs.hpp"
#include "server/core/radar_host.hpp"
#include "server/recorder/checkpoints.hpp"
#include "server/recorder/new_marks.hpp"
#include "server/recorder/series_writer.hpp"
#include "server/recorder/stream_clock.hpp"
#include "server/recorder/target_news.hpp"
#include "server/recorder/view_readers.hpp"

namespace skerry::server {

// Takes spokes from the rings, asks the host for what else there is to know, and writes all of it.
// Thread: the recorder's.
class RecordingSession {
 public:
  using Steady = std::chrono::steady_clock::time_point;
  struct Plan {
    std::string name;                   // of the file; empty: date and time
    std::vector<std::uint32_t> radars;  // that the host has
    bool inputs_only = false;           // of a host with an exercise()
    bool all_views = false;             // not with inputs_only
    std::string origin;                 // who asked
  };

  // `config`, `host` and `disk` must outlive it.  `wake` is called on the radars' threads.
  RecordingSession(RadarHost& host, const RecorderConfig& config, DiskWriter& disk, Plan plan,
                   const std::function<void()>& wake, Steady now);

  // Takes what is there; call it at least twenty times a second.  True: more waits.
  bool step(Steady now);
  void mark(const std::string& name, Steady now);
  void log(int level, const std::string& text, Steady now);
  void control_changed(const std::string& text, Steady now);
  void audit(const recording::AuditEntry& entry, Steady now);
  void stop(const std::string& origin, Steady now);

  // All but `folder` and `free_bytes`.
  wire::RecorderState state(Steady now) const;

 private:
  SeriesWriter::Additions additions();
  void begin_file();
  // The time of an item that has none of its own: now; at the begin of a file, before all that
  // follows.
  UtcTime item_time() const;
  void look_at_views();
  bool take_spokes();
  // Takes the spokes of at most so many sectors from the reader's ring; true if more may wait.
  bool take_spokes(RingReader& reader, int sectors);
  void take_sector(RingReader& reader, const EncodedSector& sector);
  void add_inputs();
  void add_changes(bool all);
  // Adds nothing for a view that has just been closed: its settings are no longer known.
  void add_settings(RingReader& reader, UtcTime time);
  void add_ships();
  void add_own_ships();
  void add_targets();
  void add_exercise(const wire::ExerciseState& exercise);
  void add_event(recording::Event::Kind kind, std::string text, const RingReader* of = nullptr,
                 std::uint64_t count = 0);
  void add_step(Duration by);
  void add(const recording::Topic& topic, UtcTime time,
           const google::protobuf::MessageLite& message);
  void keep_rate(Steady now);

  RadarHost& host_;
  DiskWriter& disk_;
  const Plan plan_;
  const Steady begun_;
  Steady now_;
  const std::optional<ScenarioZero> zero_;  // ExerciseInputs::zero() at the begin
  StreamClock clock_;
  ViewReaders readers_;
  SeriesWriter writer_;
  Checkpoints checkpoints_;
  NewMarks exercise_marks_;
  TargetNews target_news_;
  std::uint64_t settings_version_ = 0, world_version_ = 0;
  bool state_is_lost_ = false;
  bool file_begins_ = false;
  Steady ships_told_{};
  // Numbers of inputs: the first not yet given, not in any chunk that ended, and not in the file
  // for certain.
  std::size_t inputs_next_ = 0, inputs_in_chunks_ = 0, inputs_in_file_ = 0;
  std::uint64_t lost_in_rings_ = 0;
  std::uint64_t spokes_hashed_ = 0;  // of inputs alone
  std::uint32_t marks_ = 0;
  std::string bytes_;
  std::deque<std::pair<Steady, std::uint64_t>> written_;  // of late
};

}  // namespace skerry::server

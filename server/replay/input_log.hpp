// InputLog: keeps what an exercise is given, from its first moment on.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "protocol/recording/inputs.pb.h"
#include "server/core/exercise_inputs.hpp"
#include "server/core/latest.hpp"
#include "server/core/traffic.hpp"
#include "server/radar/input_sink.hpp"

namespace skerry::server {

// Only changes are kept.  At most kMaxBytes of them, which no exercise reaches; beyond, one input
// says that they are incomplete, and no more come.
// Thread: any; those of InputSink, for each radar its own.
class InputLog final : public InputSink, public ExerciseInputs {
 public:
  static constexpr std::size_t kMaxBytes = 64 << 20;

  InputLog(std::size_t radars, std::vector<ExerciseDocument> documents);

  // Held while the world is given something and the log is told of it: a radar may show it before
  // the log has it, and reached() must not say so in between.
  std::unique_lock<std::mutex> giving() { return std::unique_lock(giving_); }

  // Before any sector.
  void began(UtcTime epoch, const std::string& server);
  // `tick`: the first it holds for.
  void ordered(std::uint64_t tick, std::size_t own_ship, std::optional<double> course_deg,
               std::optional<double> speed_kn);
  void ordered(std::uint64_t tick, std::size_t own_ship, const wire::ConOrder& con);
  void driven(std::uint64_t tick, std::size_t own_ship, const OwnShipFix& fix, ScenarioTime now);
  void changed(std::uint64_t tick, const wire::WorldChange& change, Duration now);
  void exercised(std::uint64_t tick, const wire::ExerciseOrder& order, const std::string& by);

  void warmed_up(std::uint32_t radar, const SectorInputs& inputs) override;
  void took(std::uint32_t radar, std::uint64_t first, const SectorInputs& inputs,
            bool emits) override;
  void skipped(std::uint32_t radar, std::uint64_t first,
               const echo::RadarControls& controls) override;

  std::vector<std::string> since(std::size_t from) const override;
  std::vector<std::string> reached() const override;
  std::optional<ScenarioZero> zero() const override;
  // The clock in force from now on.
  void follows(const UtcClock& clock) { utc_.set(clock); }
  std::vector<ExerciseDocument> documents() const override { return documents_; }

 private:
  // The inputs of a radar's last sector.
  struct Last {
    std::optional<echo::RadarControls> radar;
    std::vector<ViewInForce> views;
    std::optional<RangeScale> on_air;
    std::optional<PictureOrigin> coast;
    std::optional<std::uint64_t> emissions;
    std::uint64_t numbered_from = 0;
    UtcClock utc;
    std::uint64_t skipped_first = 0;  // of the skipped sectors that are not yet in the log
    std::uint64_t skipped_sectors = 0;
    std::atomic<std::uint64_t> reached{0};  // 1 + first spoke of the last sector; 0: none
  };
  // Adds the members of `inputs` that differ; true if any does.
  static bool tell_differences(Last& last, const SectorInputs& inputs,
                               recording::Input::Taken& taken);
  void end_skipping(Last& last, std::uint32_t radar);
  void add(const recording::Input& input);

  const std::vector<ExerciseDocument> documents_;
  std::vector<std::unique_ptr<Last>> last_;
  mutable std::mutex giving_;  // before mutex_
  mutable std::mutex mutex_;
  std::vector<std::string> inputs_;
  std::size_t bytes_ = 0;
  UtcTime epoch_{};  // before utc_
  Latest<UtcClock> utc_;
  bool full_ = false;
};

}  // namespace skerry::server

// BoardCore: what a board does in a step, between taking its orders and publishing its state.
#pragma once

#include "protocol/board/spoke_former.hpp"
#include "server/board/azimuth_counter.hpp"
#include "server/board/azimuth_generator.hpp"
#include "server/board/board.hpp"
#include "server/board/record_writer.hpp"
#include "server/board/register_file.hpp"
#include "server/board/sweep_fifo.hpp"
#include "server/board/sweep_maker.hpp"
#include "server/board/trigger_generator.hpp"

namespace skerry::server {

// Thread: the board's.
class BoardCore {
 public:
  BoardCore(const BoardSetup& setup, RegisterFile& registers, SweepFifo& fifo);

  void advance(ScenarioTime now, UtcTime utc_zero, bool sweeps_wanted, BoardBatch& out);

 private:
  void apply(const BoardSettings& settings);
  void inject(const BoardOrders& orders);
  // All pulses before `to`, or until the batch is full.  quiet: counted, but neither sweeps nor
  // records are made.
  void run(Tick to, bool quiet);
  // Whole turns at once, as long as nothing but good turns is to come before `to`.
  void skip_good_turns(Tick to);
  std::uint64_t skip_triggers(Tick to);
  void on_azimuth_pulse(bool quiet);
  void on_trigger(bool quiet);
  void check_stall(Tick until, bool quiet);
  void capture(Tick tick, Azimuth azimuth);
  void put(const board::Sweep& sweep);
  void emit(Tick tick, std::uint32_t event, std::uint32_t faults, std::uint32_t value, bool quiet);
  // Faults that came and went since the last call, as events.
  void report_faults(Tick tick, bool quiet);
  std::uint32_t faults() const;
  bool streams() const { return wanted_ && (control_ & board::control::run) != 0; }
  bool fills_fifo() const {
    constexpr auto both = board::control::run | board::control::fifo;
    return (control_ & both) == both;
  }
  bool has_channels() const {
    return settings_.channels[0].is_on() || settings_.channels[1].is_on();
  }
  std::uint64_t samples_of_sweep() const {
    const auto& channels = sweep_.meta.channels;
    return std::uint64_t{channels[0].samples} + channels[1].samples;
  }
  void publish(Tick now);

  const BoardSetup setup_;
  RegisterFile& registers_;
  SweepFifo& fifo_;
  BoardSettings settings_;
  TriggerGenerator triggers_;
  AzimuthGenerator azimuth_;
  AzimuthCounter counter_;
  SweepMaker maker_;
  RecordWriter writer_;
  std::optional<board::SpokeFormer> former_;
  board::SpokeFormer::Spoke take_spoke_;
  board::Sweep sweep_;
  BoardBatch* batch_ = nullptr;

  bool started_ = false;
  ScenarioTime now_{};
  Tick tick_ = 0;  // pulses before it are done
  UtcTime utc_zero_{};
  bool wanted_ = false, radiates_ = true;
  std::uint32_t control_ = 0, event_enable_ = 0;
  bool armed_ = false, prepared_ = false;
  std::uint64_t arm_number_ = 0, fifo_epoch_ = 0;  // of the orders
  bool config_fault_ = false, overrun_ = false, late_ = false;
  // Faults as last seen; as last recorded; raised in this step; events of this step.
  std::uint32_t seen_faults_ = 0, reported_faults_ = 0, faults_seen_ = 0, events_seen_ = 0;
  TriggerLatch latched_;
  std::uint64_t sweeps_ = 0, sweeps_late_ = 0;
};

}  // namespace skerry::server

// RegisterFile: the registers of a board, between those who write and read them and its thread.
#pragma once

#include <array>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "protocol/board/digdar_page.hpp"
#include "protocol/board/registers.hpp"
#include "server/board/azimuth_counter.hpp"
#include "server/board/azimuth_generator.hpp"
#include "server/board/board_settings.hpp"
#include "server/board/register_access.hpp"
#include "server/board/sweep_fifo.hpp"

namespace skerry::server {

// What a board's thread takes from its registers before a step; in force for all of it.
struct BoardOrders {
  std::optional<BoardSettings> settings;  // where others are in force than before
  std::uint32_t control = 0;
  std::uint32_t event_enable = 0;
  bool reset = false;
  std::uint64_t arm_number = 0;  // 0: not armed; otherwise which arming it is
  std::uint64_t fifo_epoch = 0;
  bool config_fault = false;
  bool config_is_new = false;  // its reason is another than before
  // How many are to be injected from now on, stall in ms, where that was written.
  std::optional<std::uint32_t> missing_acp, extra_acp, missing_arp, stall_ms;
};

// The counts up to a trigger, and the trigger's place.
struct TriggerLatch {
  PulseCounts counts;
  std::uint32_t ticks_since_acp = 0;
  std::uint64_t utc_ns = 0;
};

// What it gives back after a step.
struct BoardState {
  Tick clocks = 0;
  std::uint64_t utc_ns = 0;
  PulseCounts counts;
  TriggerLatch latched;
  std::uint32_t faults = 0;       // as they are now, without `config`
  std::uint32_t faults_seen = 0;  // raised in the step
  std::uint32_t events_seen = 0;
  bool radiating = true;
  std::uint64_t sweeps = 0, sweeps_late = 0, records = 0;
  std::uint32_t missing_acp = 0, extra_acp = 0, missing_arp = 0, stall_ms = 0;  // still to come
};

// A write is checked at once.  After each batch the settings are judged together: where they
// contradict each other the fault `config` is set with its reason, and those that were in force
// before stay so; where they do not, they are in force from the board's next step on.
// One mutex, never held longer than a batch of accesses: nobody waits for a sweep.
// Thread: any; take_orders(), captured() and publish() are the board's.
class RegisterFile {
 public:
  struct Constants {
    std::uint32_t radar = 0;
    echo::RadarSet set;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> initial;
    std::function<bool(std::uint32_t radar)> has_radar;
  };
  using Value = RegisterValue;
  using Operation = RegisterOperation;

  // Settings that contradict each other from the start leave the map's own in force.
  RegisterFile(Constants constants, SweepFifo& fifo);

  std::vector<Value> access(const std::vector<Operation>& operations);
  Value read(std::uint32_t address) const;
  bool captures() const;

  // on_air: what pulse code 0 stands for now.
  BoardOrders take_orders(const echo::Pulse& on_air);
  // The armed sweeps have been captured.  False if another arming or a reset came after the orders
  // were taken: the capture does not count then.
  bool captured(std::uint64_t arm_number);
  void publish(const BoardState& state);
  // The state after the last step, with the fault `config`.
  BoardState state() const;
  std::string fault_reason() const;

 private:
  static constexpr std::uint32_t kWords = 0x100;  // of the board's own map

  board::RegisterError write(std::uint32_t address, std::uint32_t value);
  board::RegisterError write_digdar(const board::DigdarRegister& row, std::uint32_t value);
  void command(std::uint32_t bits);
  void judge();

  Value read_locked(std::uint32_t address) const;
  std::uint32_t stored(board::Reg reg) const { return words_[board::address_of(reg) / 4]; }
  std::uint32_t& stored(board::Reg reg) { return words_[board::address_of(reg) / 4]; }
  std::uint32_t value_of(std::uint32_t address) const;
  std::uint32_t digdar_value(const board::DigdarRegister& row) const;
  std::uint32_t digdar_pulses(std::uint32_t offset, const PulseCounts& counts) const;
  std::uint32_t faults() const;
  std::uint32_t status() const;

  const Constants constants_;
  SweepFifo& fifo_;

  mutable std::mutex mutex_;
  std::array<std::uint32_t, kWords> words_{};
  std::array<std::uint32_t, board::kDigdarBytes / 4> digdar_words_{};
  echo::Pulse on_air_;
  bool changed_ = false;  // since they were judged
  BoardSettings in_force_;
  bool settings_taken_ = false;
  std::string reason_;
  bool reason_is_new_ = false;  // since orders were taken

  bool reset_ = false, armed_ = false, captured_ = false;
  std::uint64_t arm_number_ = 0;  // the latest
  std::uint32_t faults_latched_ = 0, events_ = 0;
  // Written, and not yet taken.
  std::optional<std::uint32_t> missing_acp_, extra_acp_, missing_arp_, stall_ms_;
  BoardState state_;
};

}  // namespace skerry::server

#include "server/board/register_file.hpp"

#include <algorithm>

namespace skerry::server {
namespace {

using board::Access;
using board::Reg;
using board::RegisterError;

constexpr std::uint32_t kStays = board::control::run | board::control::fifo;

constexpr std::uint32_t low(std::uint64_t value) { return static_cast<std::uint32_t>(value); }
constexpr std::uint32_t high(std::uint64_t value) {
  return static_cast<std::uint32_t>(value >> 32);
}

bool is_source(std::uint32_t address) {
  return address == board::channel_address(Reg::source_a, 0) ||
         address == board::channel_address(Reg::source_a, 1);
}

}  // namespace

RegisterFile::RegisterFile(Constants constants, SweepFifo& fifo)
    : constants_(std::move(constants)), fifo_(fifo) {
  for (const board::RegisterInfo& info : board::all_registers()) {
    words_[info.address / 4] = static_cast<std::uint32_t>(info.reset);
  }
  // The board's own radar in A.
  stored(Reg::source_a) = constants_.radar + 1;
  for (const board::RegisterInfo& info : board::digdar_infos()) {
    digdar_words_[(info.address - board::kDigdarPage) / 4] = static_cast<std::uint32_t>(info.reset);
  }
  on_air_ = constants_.set.pulses.front();
  in_force_ = settings_of([&](std::uint32_t address) { return words_[address / 4]; },
                          constants_.set, on_air_);
  changed_ = true;
  judge();
  for (const auto& [address, value] : constants_.initial) write(address, value);
  judge();
  // The transmission is not known yet; the first step latches the faults.
  faults_latched_ = 0;
}

std::vector<RegisterFile::Value> RegisterFile::access(const std::vector<Operation>& operations) {
  std::vector<Value> values(operations.size());
  const std::lock_guard lock(mutex_);
  for (std::size_t i = 0; i < operations.size(); ++i) {
    const Operation& operation = operations[i];
    if (operation.writes) {
      values[i] = {write(operation.address, operation.value), operation.value};
    } else {
      values[i] = read_locked(operation.address);
    }
  }
  judge();
  return values;
}

RegisterFile::Value RegisterFile::read(std::uint32_t address) const {
  const std::lock_guard lock(mutex_);
  return read_locked(address);
}

RegisterError RegisterFile::write(std::uint32_t address, std::uint32_t value) {
  const RegisterError error = board::check_write(address, value);
  if (error != RegisterError::ok) return error;
  if (const board::DigdarRegister* row = board::find_digdar(address)) {
    return write_digdar(*row, value);
  }
  if (is_source(address) && value != 0 && constants_.has_radar &&
      !constants_.has_radar(value - 1)) {
    return RegisterError::out_of_range;
  }
  switch (static_cast<Reg>(address)) {
    case Reg::control:
      stored(Reg::control) = value & kStays;
      command(value);
      return RegisterError::ok;
    case Reg::faults_latched:
      faults_latched_ &= ~value;
      return RegisterError::ok;
    case Reg::events:
      events_ &= ~value;
      return RegisterError::ok;
    case Reg::inject_missing_acp:
      missing_acp_ = value;
      return RegisterError::ok;
    case Reg::inject_extra_acp:
      extra_acp_ = value;
      return RegisterError::ok;
    case Reg::inject_missing_arp:
      missing_arp_ = value;
      return RegisterError::ok;
    case Reg::inject_stall_ms:
      stall_ms_ = value;
      return RegisterError::ok;
    default:
      words_[address / 4] = value;
      changed_ = true;
      return RegisterError::ok;
  }
}

void RegisterFile::command(std::uint32_t bits) {
  if ((bits & board::control::reset) != 0) {
    reset_ = true;
    armed_ = captured_ = false;
    faults_latched_ = events_ = 0;
    missing_acp_ = extra_acp_ = missing_arp_ = stall_ms_ = std::nullopt;
    const BoardState before = state_;
    state_ = {};
    state_.clocks = before.clocks;
    state_.utc_ns = before.utc_ns;
    state_.radiating = before.radiating;
    fifo_.reset();
  }
  if ((bits & board::control::arm) != 0) {
    armed_ = true;
    ++arm_number_;
    captured_ = false;
  }
}

void RegisterFile::judge() {
  if (!changed_) return;
  changed_ = false;
  const BoardSettings wanted = settings_of(
      [&](std::uint32_t address) { return words_[address / 4]; }, constants_.set, on_air_);
  const std::string before = std::exchange(reason_, contradiction_in(wanted, constants_.set));
  if (!reason_.empty()) {
    if (reason_ != before) {
      faults_latched_ |= board::fault::config;
      reason_is_new_ = true;
    }
    return;
  }
  if (wanted == in_force_) return;
  in_force_ = wanted;
  settings_taken_ = false;
  fifo_.set_depth(wanted.fifo_depth);
  fifo_.set_channels(wanted.channels[0].is_on(), wanted.channels[1].is_on());
}

BoardOrders RegisterFile::take_orders(const echo::Pulse& on_air) {
  const std::lock_guard lock(mutex_);
  if (!(on_air == on_air_)) {
    on_air_ = on_air;
    changed_ = true;
    judge();
  }
  BoardOrders orders;
  if (!settings_taken_) orders.settings = in_force_;
  settings_taken_ = true;
  orders.control = stored(Reg::control);
  orders.event_enable = stored(Reg::event_enable);
  orders.reset = std::exchange(reset_, false);
  orders.arm_number = armed_ ? arm_number_ : 0;
  orders.fifo_epoch = fifo_.epoch();
  orders.config_fault = !reason_.empty();
  orders.config_is_new = std::exchange(reason_is_new_, false) && orders.config_fault;
  orders.missing_acp = std::exchange(missing_acp_, std::nullopt);
  orders.extra_acp = std::exchange(extra_acp_, std::nullopt);
  orders.missing_arp = std::exchange(missing_arp_, std::nullopt);
  orders.stall_ms = std::exchange(stall_ms_, std::nullopt);
  // Until the step is done they are still to come.
  state_.missing_acp = orders.missing_acp.value_or(state_.missing_acp);
  state_.extra_acp = orders.extra_acp.value_or(state_.extra_acp);
  state_.missing_arp = orders.missing_arp.value_or(state_.missing_arp);
  state_.stall_ms = orders.stall_ms.value_or(state_.stall_ms);
  return orders;
}

bool RegisterFile::captured(std::uint64_t arm_number) {
  const std::lock_guard lock(mutex_);
  if (!armed_ || arm_number != arm_number_) return false;
  armed_ = false;
  captured_ = true;
  digdar_words_[static_cast<std::uint32_t>(board::Digdar::trig_source) / 4] = 0;
  return true;
}

void RegisterFile::publish(const BoardState& state) {
  const std::lock_guard lock(mutex_);
  if (reset_) {
    // The next step resets the counts; they already read as reset.
    state_.clocks = state.clocks;
    state_.utc_ns = state.utc_ns;
    return;
  }
  state_ = state;
  faults_latched_ |= state.faults_seen;
  events_ |= state.events_seen;
}

BoardState RegisterFile::state() const {
  const std::lock_guard lock(mutex_);
  BoardState state = state_;
  state.faults = faults();
  return state;
}

std::string RegisterFile::fault_reason() const {
  const std::lock_guard lock(mutex_);
  return reason_;
}

bool RegisterFile::captures() const {
  const std::lock_guard lock(mutex_);
  return armed_ || (stored(Reg::control) & kStays) == kStays;
}

std::uint32_t RegisterFile::faults() const {
  return state_.faults | (reason_.empty() ? 0 : board::fault::config);
}

std::uint32_t RegisterFile::status() const {
  std::uint32_t bits = 0;
  if ((stored(Reg::control) & board::control::run) != 0) bits |= board::status::running;
  if (armed_) bits |= board::status::armed;
  if (captured_) bits |= board::status::captured;
  if (state_.radiating) bits |= board::status::radiating;
  if (faults() != 0) bits |= board::status::fault;
  return bits;
}

RegisterFile::Value RegisterFile::read_locked(std::uint32_t address) const {
  if (address % 4 != 0) return {RegisterError::misaligned, 0};
  if (board::find_register(address) == nullptr) return {RegisterError::unknown_register, 0};
  if (const board::DigdarRegister* row = board::find_digdar(address)) {
    return {RegisterError::ok, digdar_value(*row)};
  }
  return {RegisterError::ok, value_of(address)};
}

std::uint32_t RegisterFile::value_of(std::uint32_t address) const {
  const std::uint32_t reason = board::address_of(Reg::fault_reason);
  if (address >= reason && address < reason + board::kFaultReasonBytes) {
    return board::fault_reason_word(reason_, (address - reason) / 4);
  }
  const PulseCounts& counts = state_.counts;
  const PulseCounts& latched = state_.latched.counts;
  switch (static_cast<Reg>(address)) {
    case Reg::radar:
      return constants_.radar;
    case Reg::pulse_codes:
      return static_cast<std::uint32_t>(constants_.set.pulses.size());
    case Reg::status:
      return status();
    case Reg::faults:
      return faults();
    case Reg::faults_latched:
      return faults_latched_;
    case Reg::events:
      return events_;
    case Reg::clocks_low:
      return low(state_.clocks);
    case Reg::clocks_high:
      return high(state_.clocks);
    case Reg::utc_ns_low:
      return low(state_.utc_ns);
    case Reg::utc_ns_high:
      return high(state_.utc_ns);
    case Reg::inject_missing_acp:
      return missing_acp_.value_or(state_.missing_acp);
    case Reg::inject_extra_acp:
      return extra_acp_.value_or(state_.extra_acp);
    case Reg::inject_missing_arp:
      return missing_arp_.value_or(state_.missing_arp);
    case Reg::inject_stall_ms:
      return stall_ms_.value_or(state_.stall_ms);
    case Reg::fifo_level:
      return fifo_.counters().level;
    case Reg::overruns_a:
      return fifo_.counters().overruns[0];
    case Reg::overruns_b:
      return fifo_.counters().overruns[1];
    case Reg::underruns_a:
      return fifo_.counters().underruns[0];
    case Reg::underruns_b:
      return fifo_.counters().underruns[1];
    case Reg::sweeps_late:
      return low(state_.sweeps_late);
    case Reg::trigger_count_low:
      return low(counts.triggers);
    case Reg::trigger_count_high:
      return high(counts.triggers);
    case Reg::acp_count:
      return counts.acps_since_arp;
    case Reg::arp_count:
      return counts.arps;
    case Reg::acp_per_arp:
      return counts.acps_per_arp;
    case Reg::latched_trigger_count_low:
      return low(latched.triggers);
    case Reg::latched_trigger_count_high:
      return high(latched.triggers);
    case Reg::latched_clock_low:
      return low(latched.trigger_tick);
    case Reg::latched_clock_high:
      return high(latched.trigger_tick);
    case Reg::latched_acp_count:
      return latched.acps_since_arp;
    case Reg::latched_ticks_since_acp:
      return state_.latched.ticks_since_acp;
    case Reg::latched_acp_period:
      return latched.acp_period();
    case Reg::latched_arp_count:
      return latched.arps;
    case Reg::latched_utc_ns_low:
      return low(state_.latched.utc_ns);
    case Reg::latched_utc_ns_high:
      return high(state_.latched.utc_ns);
    default:
      return words_[address / 4];
  }
}

}  // namespace skerry::server

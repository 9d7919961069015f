#include "server/board/board_core.hpp"

#include <algorithm>

#include "echo/kernel/hash.hpp"

namespace skerry::server {
namespace {

// Places among the hashes of what comes by chance on a board.
constexpr std::uint64_t kJitterSeed = 0x6A69747465720000, kGustSeed = 0x6775737400000000;

TriggerSettings trigger_settings(const BoardSettings& s, std::uint32_t radar) {
  return {s.clock_hz, s.prf_millihertz, s.jitter_ppm, s.stagger_ppm,
          echo::mixed(kJitterSeed, radar)};
}

RotationSettings rotation_settings(const BoardSettings& s, std::uint32_t radar) {
  return {s.clock_hz, s.milli_rpm,    s.acp_per_turn, s.arp_error,
          s.wow_ppm,  s.wow_per_turn, s.gust_ppm,     echo::mixed(kGustSeed, radar)};
}

Encoder encoder_of(const BoardSettings& s) {
  const Wide ticks = static_cast<Wide>(s.clock_hz) * 60'000;
  return {s.acp_per_turn, static_cast<Tick>(ticks / s.milli_rpm / s.acp_per_turn)};
}

std::uint64_t in_ns(UtcTime zero, ScenarioTime time) {
  const Duration utc = zero.time_since_epoch() + time.time_since_epoch();
  return utc.count() < 0 ? 0 : static_cast<std::uint64_t>(utc.count());
}

}  // namespace

BoardCore::BoardCore(const BoardSetup& setup, RegisterFile& registers, SweepFifo& fifo)
    : setup_(setup),
      registers_(registers),
      fifo_(fifo),
      triggers_(TriggerSettings{}),
      azimuth_(RotationSettings{}),
      counter_(encoder_of(settings_)),
      maker_(setup.radar, setup.echoes),
      writer_(setup.radar) {
  take_spoke_ = [this](const board::Sweep& spoke) { put(spoke); };
}

void BoardCore::apply(const BoardSettings& settings) {
  const BoardSettings old = settings_;
  settings_ = settings;
  const TriggerSettings trigger = trigger_settings(settings, setup_.radar);
  const RotationSettings rotation = rotation_settings(settings, setup_.radar);
  if (started_) {
    const Tick before = tick_;
    tick_ = tick_at(now_, settings.clock_hz);
    const bool new_clock = settings.clock_hz != old.clock_hz;
    if (!(rotation == azimuth_.settings())) {
      azimuth_.set(rotation, before, tick_);
      counter_.restart(encoder_of(settings), before, tick_, new_clock);
    }
    triggers_.set(trigger, tick_);
    if (new_clock) latched_ = {};
    if (former_) former_->finish(take_spoke_);
  } else {
    triggers_ = TriggerGenerator(trigger);
    azimuth_ = AzimuthGenerator(rotation);
    counter_ = AzimuthCounter(encoder_of(settings));
  }
  former_.reset();
  if (settings.spokes_per_turn != 0) former_.emplace(settings.spokes_per_turn);
  maker_.set(settings);
  prepared_ = false;

  board::SweepMeta& meta = sweep_.meta;
  meta = {};
  meta.radar = setup_.radar;
  meta.sample_clock_hz = settings.clock_hz;
  meta.acp_per_turn = settings.acp_per_turn;
  meta.delay_ticks = settings.delay_ticks;
  meta.pulse_ns = static_cast<std::uint32_t>(settings.pulse.length_s * 1e9 + 0.5);
  meta.prf_millihertz = settings.prf_millihertz;
  for (std::size_t c = 0; c < 2; ++c) {
    meta.channels[c] =
        settings.channels[c].is_on() ? settings.channels[c].format : board::ChannelFormat{};
    sweep_.samples[c].resize(meta.channels[c].samples);
  }
}

void BoardCore::inject(const BoardOrders& orders) {
  AzimuthOrders wanted{orders.missing_acp, orders.extra_acp, orders.missing_arp};
  if (orders.stall_ms) {
    wanted.stall = static_cast<Tick>(std::uint64_t{*orders.stall_ms} * settings_.clock_hz / 1000);
  }
  azimuth_.inject(wanted, tick_);
}

void BoardCore::advance(ScenarioTime now, UtcTime utc_zero, bool sweeps_wanted, BoardBatch& out) {
  batch_ = &out;
  utc_zero_ = utc_zero;
  wanted_ = sweeps_wanted;
  faults_seen_ = events_seen_ = 0;
  prepared_ = false;

  BoardSetup::OnAir air{setup_.set.pulses.front(), true};
  if (setup_.on_air) air = setup_.on_air();
  radiates_ = air.radiates;
  const BoardOrders orders = registers_.take_orders(air.pulse);
  control_ = orders.control;
  event_enable_ = orders.event_enable;
  arm_number_ = orders.arm_number;
  armed_ = arm_number_ != 0;
  fifo_epoch_ = orders.fifo_epoch;
  config_fault_ = orders.config_fault;
  if (orders.config_is_new) {
    // Another reason is another fault, to be raised again.
    seen_faults_ &= ~board::fault::config;
    reported_faults_ &= ~board::fault::config;
  }

  if (orders.reset && former_) former_.emplace(settings_.spokes_per_turn);
  writer_.begin(out, tick_, orders.settings ? orders.settings->clock_hz : settings_.clock_hz);
  if (orders.settings) {
    apply(*orders.settings);
    writer_.restart_edges(tick_);
    if (started_) emit(tick_, board::event::configured, 0, 0, false);
  }
  if (orders.reset) {
    counter_.reset(tick_);
    azimuth_.forget_faults();
    latched_ = {};
    sweeps_ = sweeps_late_ = 0;
    overrun_ = late_ = false;
    emit(tick_, board::event::reset, 0, 0, false);
  }
  inject(orders);
  if (overrun_ && fifo_.has_room(samples_of_sweep())) overrun_ = false;
  started_ = true;

  const Tick to = std::max(tick_at(now, settings_.clock_hz), tick_);
  const Tick live = std::max(std::min(now > ScenarioTime{} + Board::kMostBehind
                                          ? tick_at(now - Board::kMostBehind, settings_.clock_hz)
                                          : 0,
                                      to),
                             tick_);
  const std::uint64_t late_before = sweeps_late_;
  if (live > tick_) {
    run(live, true);
    writer_.restart_edges(live);
  }
  late_ = sweeps_late_ > late_before;
  report_faults(tick_, false);
  if (former_ && !streams() && !fills_fifo()) former_.emplace(settings_.spokes_per_turn);
  run(to, false);
  now_ = std::max(batch_->is_complete ? now : first_time_in(tick_, settings_.clock_hz), now_);
  writer_.finish(tick_);
  publish(tick_);
  batch_ = nullptr;
}

void BoardCore::run(Tick to, bool quiet) {
  Tick last = tick_;
  for (;;) {
    const AzimuthGenerator::Pulse& pulse = azimuth_.next();
    const bool azimuth_first = pulse.tick <= triggers_.next();
    const Tick tick = azimuth_first ? pulse.tick : triggers_.next();
    check_stall(std::min(tick, to), quiet);
    if (tick >= to) break;
    if (!quiet && tick > last && batch_->records.size() >= BoardBatch::kMostBytes) {
      // All of a tick stays together.
      batch_->is_complete = false;
      tick_ = tick;
      return;
    }
    last = tick;
    if (azimuth_first) {
      const bool turn_ends = pulse.line == AzimuthLine::arp;
      on_azimuth_pulse(quiet);
      if (quiet && turn_ends) skip_good_turns(to);
    } else {
      on_trigger(quiet);
    }
  }
  tick_ = to;
}

void BoardCore::check_stall(Tick until, bool quiet) {
  const Tick tick = counter_.stall_tick();
  if (tick >= until) return;
  counter_.on_stall();
  report_faults(tick, quiet);
}

void BoardCore::on_azimuth_pulse(bool quiet) {
  const AzimuthGenerator::Pulse pulse = azimuth_.next();
  azimuth_.pop();
  if (!pulse.sent) return;
  if (!quiet) writer_.edge(pulse.tick, line_of(pulse.line));
  switch (pulse.line) {
    case AzimuthLine::acp:
      counter_.on_acp(pulse.tick);
      report_faults(pulse.tick, quiet);
      break;
    case AzimuthLine::arp:
      counter_.on_arp(pulse.tick);
      emit(pulse.tick, board::event::arp, 0, counter_.counts().arps, quiet);
      report_faults(pulse.tick, quiet);
      break;
    case AzimuthLine::heading:
      emit(pulse.tick, board::event::heading, 0, counter_.counts().arps, quiet);
      break;
  }
}

void BoardCore::on_trigger(bool quiet) {
  const Tick tick = triggers_.next();
  triggers_.pop();
  const bool captures = has_channels() && (streams() || fills_fifo() || armed_);
  Azimuth azimuth;
  if (captures || settings_.blanking != board::BlankingMode::off) azimuth = azimuth_.at(tick);
  if (settings_.blanking == board::BlankingMode::trigger && settings_.blanks(azimuth)) return;
  counter_.on_trigger(tick);
  if (!quiet) writer_.edge(tick, board::Line::trigger);
  if ((control_ & board::control::run) != 0 || (captures && !quiet)) {
    latched_.counts = counter_.counts();
    latched_.ticks_since_acp = latched_.counts.ticks_since_acp(tick);
    latched_.utc_ns = in_ns(utc_zero_, time_of(tick, settings_.clock_hz));
  }
  if (!captures) return;
  if (!quiet) {
    capture(tick, azimuth);
  } else if (streams() || fills_fifo()) {
    ++sweeps_late_;
  }
}

void BoardCore::capture(Tick tick, Azimuth azimuth) {
  const bool for_fifo_alone = !streams() && !armed_ && !former_;
  if (for_fifo_alone && fifo_.refuses(sweep_.meta, fifo_epoch_)) {
    overrun_ = true;
    report_faults(tick, false);
    return;
  }
  if (!prepared_) {
    maker_.prepare();
    prepared_ = true;
  }
  const PulseCounts& counts = counter_.counts();
  board::SweepMeta& meta = sweep_.meta;
  meta.trigger_count = counts.triggers;
  meta.trigger_tick = tick;
  meta.acp_count = counts.acps_since_arp;
  meta.ticks_since_acp = counts.ticks_since_acp(tick);
  meta.acp_period = counts.acp_period();
  meta.turn_ticks = counts.turn_ticks;
  meta.arp_ticks = counts.ticks_from_acp_to_arp;
  meta.arp_count = counts.arps;
  meta.utc_ns = latched_.utc_ns;
  meta.faults = faults();
  const bool blanked =
      settings_.blanking == board::BlankingMode::video && settings_.blanks(azimuth);
  maker_.make(azimuth, time_of(tick, settings_.clock_hz), blanked, sweep_);
  ++sweeps_;
  ++batch_->sweeps;

  if (streams() || fills_fifo()) {
    if (former_) {
      former_->add(sweep_, take_spoke_);
    } else {
      put(sweep_);
    }
  }
  if (armed_) {
    armed_ = false;
    // Who finds the sweep in the FIFO finds its latches in the registers.
    publish(tick);
    if (!registers_.captured(arm_number_)) return;
    // A FIFO that is filled anyway has it already.
    if (!fills_fifo() || former_) overrun_ = !fifo_.put(sweep_, fifo_epoch_);
    emit(tick, board::event::captured, 0, static_cast<std::uint32_t>(counts.triggers), false);
    report_faults(tick, false);
  }
}

void BoardCore::put(const board::Sweep& sweep) {
  if (streams()) writer_.sweep(sweep);
  if (fills_fifo()) {
    overrun_ = !fifo_.put(sweep, fifo_epoch_);
    report_faults(sweep.meta.trigger_tick, false);
  }
}

std::uint32_t BoardCore::faults() const {
  std::uint32_t bits = counter_.faults();
  if (config_fault_) bits |= board::fault::config;
  if (overrun_) bits |= board::fault::overrun;
  if (late_) bits |= board::fault::late;
  return bits;
}

void BoardCore::emit(Tick tick, std::uint32_t event, std::uint32_t faults, std::uint32_t value,
                     bool quiet) {
  events_seen_ |= event;
  if (!quiet && (event_enable_ & event) != 0) writer_.event(tick, event, faults, value);
}

void BoardCore::report_faults(Tick tick, bool quiet) {
  const std::uint32_t now = faults();
  faults_seen_ |= now & ~seen_faults_;
  if ((now & ~seen_faults_) != 0) events_seen_ |= board::event::fault_raised;
  if ((seen_faults_ & ~now) != 0) events_seen_ |= board::event::fault_cleared;
  seen_faults_ = now;
  if (quiet || now == reported_faults_) return;
  const std::uint32_t raised = now & ~reported_faults_, cleared = reported_faults_ & ~now;
  reported_faults_ = now;
  batch_->fault_changes.push_back({raised, cleared});
  const std::uint32_t acps = counter_.counts().acps_per_arp;
  if (raised != 0) emit(tick, board::event::fault_raised, raised, acps, false);
  if (cleared != 0) emit(tick, board::event::fault_cleared, cleared, acps, false);
}

void BoardCore::publish(Tick now) {
  BoardState state;
  state.clocks = now;
  state.utc_ns = in_ns(utc_zero_, time_of(now, settings_.clock_hz));
  state.counts = counter_.counts();
  state.latched = latched_;
  state.faults = faults() & ~board::fault::config;
  state.faults_seen = faults_seen_;
  state.events_seen = events_seen_;
  state.radiating = radiates_;
  state.sweeps = sweeps_;
  state.sweeps_late = sweeps_late_;
  state.records = writer_.records();
  const AzimuthFaults left = azimuth_.left(now);
  state.missing_acp = left.missing_acp;
  state.extra_acp = left.extra_acp;
  state.missing_arp = left.missing_arp;
  const std::uint64_t hz = settings_.clock_hz;
  state.stall_ms = static_cast<std::uint32_t>((left.stall * 1000 + hz - 1) / hz);
  registers_.publish(state);
  faults_seen_ = events_seen_ = 0;
}

}  // namespace skerry::server

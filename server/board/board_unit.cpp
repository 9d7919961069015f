#include "server/board/board_unit.hpp"

#include <fmt/format.h>
#include <pthread.h>
#include <spdlog/spdlog.h>
#include <time.h>

#include <algorithm>
#include <stdexcept>
#include <utility>
#include <vector>

#include "protocol/board/registers.hpp"
#include "protocol/wire/frame.hpp"
#include "server/board/record_frames.hpp"

namespace skerry::server {
namespace {

// Octets of a frame of FIFO sweeps besides the sweeps.
constexpr std::size_t kFrameRoom = 256;

constexpr double kMeanSweeps = 1000.0;  // over which the cost of a sweep is averaged
constexpr std::chrono::milliseconds kRateWindow{500};

double thread_cpu_s() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace

void FaultLog::look_at(const BoardBatch& batch, const std::function<std::string()>& reason,
                       std::chrono::steady_clock::time_point now) {
  room_ =
      std::min<std::chrono::steady_clock::duration>(room_ + (now - last_), kMostLines * kLineTime);
  last_ = now;
  if (left_out_ > 0 && take_room()) tell_left_out();
  for (const auto& [raised, cleared] : batch.fault_changes) {
    for (const bool is_raised : {true, false}) {
      const std::uint32_t faults = is_raised ? raised : cleared;
      if (faults == 0) continue;
      if (take_room()) {
        tell(is_raised, faults, reason);
      } else {
        ++left_out_;
      }
    }
  }
}

bool FaultLog::take_room() {
  if (room_ < kLineTime) return false;
  room_ -= kLineTime;
  return true;
}

void FaultLog::tell_left_out() {
  spdlog::warn("board of {}: {} more faults raised or cleared", name_, left_out_);
  left_out_ = 0;
}

void FaultLog::tell(bool is_raised, std::uint32_t faults,
                    const std::function<std::string()>& reason) {
  const std::string names = board::fault_names(faults);
  if (!is_raised) {
    spdlog::info("board of {}: fault cleared: {}", name_, names);
    return;
  }
  // Empty where the settings have been put right meanwhile.
  std::string why = (faults & board::fault::config) != 0 ? reason() : "";
  if (!why.empty()) why.insert(0, ": ");
  spdlog::warn("board of {}: fault raised: {}{}", name_, names, why);
}

BoardUnit::BoardUnit(BoardSetup setup, std::string name)
    : radar_(setup.radar), board_(std::move(setup)), log_(std::move(name)) {}

void BoardUnit::set_shared_ring(std::string ring_name, std::size_t ring_bytes) {
  ring_name_ = std::move(ring_name);
  ring_bytes_ = ring_bytes;
}

void BoardUnit::start(Clock::time_point zero, UtcTime utc_zero) {
  zero_ = zero;
  set_utc({{}, utc_zero});
  thread_ = std::jthread([this](const std::stop_token& stop) {
    pthread_setname_np(pthread_self(), fmt::format("board-{}", radar_).c_str());
    run(stop);
  });
}

void BoardUnit::stop() {
  thread_.request_stop();
  if (thread_.joinable()) thread_.join();
  const std::lock_guard lock(ring_mutex_);
  shared_ring_.reset();
  ring_name_.clear();
}

bool BoardUnit::sweeps_wanted() const {
  return records_.has_readers() || leases_->load(std::memory_order_relaxed) > 0 ||
         board_.captures();
}

bool BoardUnit::looked_at() const {
  const Clock::time_point last{Clock::duration(last_access_.load(std::memory_order_relaxed))};
  return signals_.has_readers() || Clock::now() - last < kInterest;
}

void BoardUnit::poke() {
  last_access_.store(Clock::now().time_since_epoch().count(), std::memory_order_relaxed);
  {
    const std::lock_guard lock(mutex_);
    is_poked_ = true;
  }
  poked_.notify_one();
}

void BoardUnit::run(const std::stop_token& stop) {
  Clock::time_point next = Clock::now();
  while (!stop.stop_requested()) {
    step();
    const bool busy = sweeps_wanted() || looked_at();
    next = std::max(next + (busy ? kStep : kIdleStep), Clock::now());
    std::unique_lock lock(mutex_);
    // While busy the next step is near enough for everybody.
    poked_.wait_until(lock, stop, next, [&] { return is_poked_ && !busy; });
    if (std::exchange(is_poked_, false) && !busy) next = Clock::now();
  }
}

void BoardUnit::step() {
  const Clock::time_point now = Clock::now();
  while (!step_once(now)) {
  }
}

bool BoardUnit::step_once(Clock::time_point now) {
  const double cpu_before = thread_cpu_s();
  const ScenarioTime time(std::max(Duration{}, Duration(now - zero_)));
  board_.advance(time, utc_.get()->at(time) - time.time_since_epoch(), sweeps_wanted(), batch_);
  const double cpu_s = thread_cpu_s() - cpu_before;
  // Before anybody can react to a fault and so change its reason.
  log_.look_at(
      batch_, [this] { return board_.counters().fault_reason; }, now);
  hand_out();
  measure(now, cpu_s);
  return batch_.is_complete;
}

void BoardUnit::hand_out() {
  const bool lent = leases_->load(std::memory_order_relaxed) > 0;
  const std::shared_ptr<SharedRing> shared = lent ? shared_ring() : nullptr;
  for_each_block(batch_.records, batch_.record_ends, batch_.first_record, kBlockBytes,
                 [&](const RecordBlock& block) {
                   if (shared) {
                     shared->writer().write(block.bytes, block.first_sequence, block.count());
                   }
                   records_.publish(block.count(), [&] { return records_frame(radar_, block); });
                 });
  for_each_block(batch_.signals, batch_.signal_ends, batch_.first_signal, kBlockBytes,
                 [&](const RecordBlock& block) {
                   signals_.publish(block.count(), [&] { return records_frame(radar_, block); });
                 });
}

void BoardUnit::measure(Clock::time_point now, double cpu_s) {
  if (batch_.sweeps > 0) {
    const double share = std::min(1.0, batch_.sweeps / kMeanSweeps);
    const double mean = sweep_us_.load(std::memory_order_relaxed);
    sweep_us_.store(mean + share * (1e6 * cpu_s / batch_.sweeps - mean), std::memory_order_relaxed);
  }
  window_bytes_ += batch_.records.size();
  const Clock::duration window = now - window_begun_;
  if (window < kRateWindow) return;
  bytes_per_second_.store(
      static_cast<double>(window_bytes_) / std::chrono::duration<double>(window).count(),
      std::memory_order_relaxed);
  window_begun_ = now;
  window_bytes_ = 0;
}

wire::BoardReply BoardUnit::access(const wire::BoardAccess& access) {
  std::vector<Board::Operation> operations;
  for (const wire::BoardOperation& said : access.operations()) {
    operations.push_back({said.address(), said.has_write(), said.write()});
  }
  wire::BoardReply reply;
  reply.set_radar(radar_);
  for (const Board::Value& value : board_.access(operations)) {
    wire::BoardResult* const result = reply.add_results();
    result->set_error(static_cast<wire::BoardError>(value.error));
    result->set_value(value.value);
  }
  poke();
  return reply;
}

wire::BoardRecords BoardUnit::read_fifo(std::uint32_t count) {
  Bytes bytes;
  std::uint64_t first_sequence = 0;
  wire::BoardRecords records;
  records.set_radar(radar_);
  records.set_count(board_.take_fifo(count, kMaxServerFrame - kFrameRoom, bytes, first_sequence));
  records.set_first_sequence(first_sequence);
  records.mutable_records()->assign(bytes.begin(), bytes.end());
  poke();
  return records;
}

std::shared_ptr<SharedRing> BoardUnit::shared_ring() const {
  const std::lock_guard lock(ring_mutex_);
  return shared_ring_;
}

Result<BoardRingLease, std::string> BoardUnit::open_ring() {
  const std::lock_guard lock(ring_mutex_);
  if (ring_name_.empty()) return Failure{std::string("this board has no shared memory")};
  if (!shared_ring_) {
    auto made = SharedRing::create(ring_name_, ring_bytes_);
    if (!made) return Failure{made.error()};
    shared_ring_ = std::make_shared<SharedRing>(std::move(made).value());
    spdlog::info("board of radar {}: shared memory {}, {} bytes", radar_, ring_name_,
                 shared_ring_->size());
  }
  BoardRingLease given;
  given.reply.set_radar(radar_);
  given.reply.set_ring_name(shared_ring_->name());
  given.reply.set_ring_bytes(shared_ring_->size());
  leases_->fetch_add(1);
  given.lease =
      std::shared_ptr<void>(leases_.get(), [leases = leases_](void*) { leases->fetch_sub(1); });
  poke();
  return given;
}

FormatRing& BoardUnit::ring(const std::string& format) {
  if (format != kRecordsFormat && format != kSignalsFormat) {
    throw std::out_of_range("a board has no format '" + format + "'");
  }
  // Who asks is about to read.
  poke();
  return format == kRecordsFormat ? records_ : signals_;
}

wire::BoardState BoardUnit::state() const {
  const BoardCounters counters = board_.counters();
  wire::BoardState state;
  state.set_triggers(counters.triggers);
  state.set_sweeps(counters.sweeps);
  state.set_sweeps_late(counters.sweeps_late);
  state.set_records(counters.records);
  state.set_faults(counters.faults);
  state.set_fault_reason(counters.fault_reason);
  state.set_sweep_us(sweep_us_.load(std::memory_order_relaxed));
  if (const auto ring = shared_ring()) state.set_ring_name(ring->name());
  return state;
}

}  // namespace skerry::server

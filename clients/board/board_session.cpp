#include "clients/board/board_session.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "clients/board/board_reading.hpp"
#include "clients/board/call.hpp"
#include "protocol/wire/printable_text.hpp"

namespace skerry::client::capi {
namespace {

using Clock = std::chrono::steady_clock;

// Sweeps kept while an event is waited for: the stream has them, its events and its edges in
// batches, so that sweeps after the event may come before it.
constexpr std::size_t kMostKept = 256;
// How often the FIFO is looked at while it is empty.
constexpr std::chrono::milliseconds kLookAtFifo{2};

std::int32_t code_of_refusal(board::RegisterError error) {
  switch (error) {
    case board::RegisterError::ok:
      return SKB_OK;
    case board::RegisterError::unknown_register:
      return SKB_ERROR_UNKNOWN_REGISTER;
    case board::RegisterError::read_only:
      return SKB_ERROR_READ_ONLY;
    case board::RegisterError::out_of_range:
      return SKB_ERROR_OUT_OF_RANGE;
    case board::RegisterError::misaligned:
      return SKB_ERROR_MISALIGNED;
  }
  return SKB_ERROR_INTERNAL;
}

[[noreturn]] void refuse_access(const BoardClient::Operation& operation,
                                board::RegisterError error) {
  throw CallError(code_of_refusal(error),
                  board::refusal_text(operation.address, operation.write.value_or(0), error));
}

// 0 where a record does not say it.
std::uint32_t clock_of(const board::Record& record) {
  if (const auto* sweep = std::get_if<board::Sweep>(&record)) return sweep->meta.sample_clock_hz;
  if (const auto* edges = std::get_if<board::Edges>(&record)) return edges->sample_clock_hz;
  return 0;
}

}  // namespace

std::vector<std::uint32_t> BoardSession::access(
    const std::vector<BoardClient::Operation>& operations) {
  const auto results = value_of(client_.access(operations, timeout_));
  std::vector<std::uint32_t> values;
  for (std::size_t i = 0; i < results.size(); ++i) {
    if (results[i].error != board::RegisterError::ok) {
      refuse_access(operations[i], results[i].error);
    }
    values.push_back(results[i].value);
  }
  return values;
}

std::string BoardSession::fault_reason() {
  return fault_reason_text(value_of(client_.access(fault_reason_reads(), timeout_)));
}

void BoardSession::start() {
  if (shared_) {
    value_of(client_.map_ring(timeout_));
  } else {
    value_of(client_.stream(BoardStreamKind::records, timeout_));
  }
  streaming_ = true;
  waiting_.clear();
  clock_hz_ = 0;
  first_tick_ = last_arp_tick_ = 0;
}

// All ticks begin anew with another sample clock.
void BoardSession::follow_clock(const board::Record& record) {
  const std::uint32_t clock_hz = clock_of(record);
  if (clock_hz == 0 || clock_hz == clock_hz_) return;
  if (clock_hz_ != 0) {
    waiting_.clear();
    first_tick_ = last_arp_tick_ = 0;
  }
  clock_hz_ = clock_hz;
}

std::optional<board::DecodedRecord> BoardSession::next_record(Duration timeout) {
  if (!streaming_) start();
  auto record = value_of(client_.next(timeout));
  if (record) follow_clock(record->record);
  return record;
}

void BoardSession::keep(std::uint64_t sequence, board::Sweep sweep) {
  if (sweep.meta.trigger_tick < first_tick_) return;
  waiting_.push_back({sequence, std::move(sweep)});
  if (waiting_.size() > kMostKept) waiting_.pop_front();
}

const BoardSession::Arrived& BoardSession::next_sweep(Duration timeout) {
  const auto end = Clock::now() + timeout;
  while (waiting_.empty()) {
    auto record = next_record(end - Clock::now());
    if (record) {
      if (auto* sweep = std::get_if<board::Sweep>(&record->record)) {
        keep(record->sequence, std::move(*sweep));
      }
    }
    if (waiting_.empty() && (!record || Clock::now() >= end)) {
      throw CallError(SKB_ERROR_TIMEOUT,
                      "no sweep came in time; is the board running, does the radar transmit, and "
                      "do its settings fit each other (CONTROL, STATUS, FAULTS)?");
    }
  }
  return waiting_.front();
}

const BoardSession::Arrived& BoardSession::next_of_fifo(Duration timeout) {
  const auto end = Clock::now() + timeout;
  const std::vector<BoardClient::Operation> level = {
      {.address = board::address_of(board::Reg::fifo_level)}};
  while (!of_fifo_) {
    if (access(level).front() > 0) {
      auto sweeps = value_of(client_.read_fifo(1, timeout_));
      if (!sweeps.empty()) {
        of_fifo_ = Arrived{0, std::move(sweeps.front())};
        break;
      }
    }
    if (Clock::now() >= end) {
      throw CallError(SKB_ERROR_TIMEOUT,
                      "no sweep came into the FIFO in time; was the board armed (skb_arm), and "
                      "does the radar transmit?");
    }
    std::this_thread::sleep_for(std::min<Duration>(kLookAtFifo, end - Clock::now()));
  }
  return *of_fifo_;
}

std::optional<board::Event> BoardSession::event_in(const board::Record& record,
                                                   std::uint32_t mask) {
  if (const auto* event = std::get_if<board::Event>(&record)) {
    if ((event->event & mask) == 0) return std::nullopt;
    if (event->event == board::event::arp && event->tick <= last_arp_tick_) return std::nullopt;
    return *event;
  }
  const auto* edges = std::get_if<board::Edges>(&record);
  if (!edges || (mask & board::event::arp) == 0) return std::nullopt;
  for (const board::Edge& edge : edges->edges) {
    if (edge.line != board::Line::arp || edge.tick <= last_arp_tick_) continue;
    return board::Event{.radar = edges->radar, .tick = edge.tick, .event = board::event::arp};
  }
  return std::nullopt;
}

board::Event BoardSession::wait(std::uint32_t mask, Duration timeout) {
  const auto end = Clock::now() + timeout;
  for (;;) {
    auto record = next_record(end - Clock::now());
    if (record) {
      if (auto* sweep = std::get_if<board::Sweep>(&record->record)) {
        keep(record->sequence, std::move(*sweep));
      } else if (const auto event = event_in(record->record, mask)) {
        first_tick_ = event->tick;
        if (event->event == board::event::arp) last_arp_tick_ = event->tick;
        std::erase_if(waiting_, [&](const Arrived& arrived) {
          return arrived.sweep.meta.trigger_tick < first_tick_;
        });
        return *event;
      }
    }
    if (!record || Clock::now() >= end) {
      throw CallError(SKB_ERROR_TIMEOUT, "no such event came in time");
    }
  }
}

std::string BoardSession::description() const {
  return fmt::format("radar {} ({}) of {}, {}", client_.radar().radar(),
                     printable(client_.radar().name(), 80), client_.name(),
                     printable(client_.hello().server(), 80));
}

}  // namespace skerry::client::capi

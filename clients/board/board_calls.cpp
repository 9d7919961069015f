// The calls of skerry_board.h.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstring>
#include <string>

#include "clients/board/board_place.hpp"
#include "clients/board/board_reading.hpp"
#include "clients/board/board_session.hpp"
#include "clients/board/call.hpp"
#include "protocol/board/digdar_page.hpp"
#include "protocol/wire/printable_text.hpp"

namespace {

using namespace skerry::client;
using namespace skerry::client::capi;
namespace board = skerry::board;
using skerry::Duration;

// Layouts of version 1.0, which never change.
static_assert(sizeof(skb_channel) == 48 && sizeof(skb_sweep) == 200 && sizeof(skb_event) == 24);

// TRIG_SOURCE of the digitiser's page, without which its COMMAND arms nothing: the next trigger.
constexpr std::uint32_t kDigitiserTrigger = 2;
constexpr std::size_t kLongestName = 64, kLongestPlace = 512, kLongestToken = 512;

Duration duration_of(std::uint32_t timeout_ms) {
  require_range("timeout_ms", timeout_ms, 0, SKB_LONGEST_TIMEOUT_MS);
  return std::chrono::milliseconds(timeout_ms);
}

// Error: ARGUMENT for NULL and for texts without an end.
std::string text_of(const char* name, const char* text, std::size_t longest) {
  require_pointer(name, text);
  const std::size_t size = strnlen(text, longest + 1);
  if (size > longest) {
    throw CallError(SKB_ERROR_ARGUMENT,
                    fmt::format("{} is longer than {} characters", name, longest));
  }
  return {text, size};
}

struct NamedRegister {
  const board::RegisterInfo* info = nullptr;
  bool is_wide = false;  // its high half follows
};

NamedRegister find_named(const char* name) {
  const std::string text = text_of("name", name, kLongestName);
  if (const board::RegisterInfo* const info = board::find_register(std::string_view(text))) {
    return {info, false};
  }
  if (const board::RegisterInfo* const low = board::find_register(text + "_LOW")) {
    return {low, true};
  }
  throw CallError(SKB_ERROR_UNKNOWN_REGISTER, fmt::format("the board has no register '{}'",
                                                          skerry::printable(text, kLongestName)));
}

// Whether the value may be sent as 32 bits at all; what may not be written is for the board to say.
bool is_allowed(const board::RegisterInfo& info, std::int64_t value) {
  if (info.access != board::Access::read_write) return value >= 0 && value <= UINT32_MAX;
  return (value >= info.min && value <= info.max) || (info.or_zero && value == 0);
}

skb_channel channel_of(const board::SweepMeta& meta, std::size_t index) {
  const board::ChannelFormat& format = meta.channels[index];
  skb_channel channel{};
  if (format.samples == 0) return channel;
  channel.samples = format.samples;
  channel.decimation = format.decimation;
  channel.mode = static_cast<std::uint32_t>(format.mode);
  channel.bits = format.bits;
  channel.largest_code = board::largest_code(format);
  channel.detector = static_cast<std::uint32_t>(format.detector);
  channel.inverted = format.inverted ? 1 : 0;
  channel.first_range_m = board::sample_range_m(meta, index, 0);
  channel.range_step_m = board::sample_range_m(meta, index, 1) - channel.first_range_m;
  return channel;
}

skb_sweep sweep_of(const BoardSession::Arrived& arrived) {
  const board::SweepMeta& meta = arrived.sweep.meta;
  skb_sweep sweep{};
  sweep.sequence = arrived.sequence;
  sweep.trigger_count = meta.trigger_count;
  sweep.trigger_tick = meta.trigger_tick;
  sweep.utc_ns = meta.utc_ns;
  sweep.azimuth_turns = board::azimuth_turns(meta);
  sweep.radar = meta.radar;
  sweep.sample_clock_hz = meta.sample_clock_hz;
  sweep.acp_count = meta.acp_count;
  sweep.ticks_since_acp = meta.ticks_since_acp;
  sweep.acp_period = meta.acp_period;
  sweep.acp_per_turn = meta.acp_per_turn;
  sweep.arp_ticks = meta.arp_ticks;
  sweep.arp_count = meta.arp_count;
  sweep.delay_ticks = meta.delay_ticks;
  sweep.pulse_ns = meta.pulse_ns;
  sweep.prf_millihertz = meta.prf_millihertz;
  sweep.faults = meta.faults;
  sweep.pulses = meta.pulses;
  sweep.spoke = meta.spoke;
  sweep.spokes_per_turn = meta.spokes_per_turn;
  sweep.turn_ticks = meta.turn_ticks;
  for (std::size_t i = 0; i < 2; ++i) sweep.channel[i] = channel_of(meta, i);
  return sweep;
}

// A caller's room for the samples of a channel.
struct Room {
  const char* name;
  std::uint16_t* samples;
  std::size_t capacity;
};

void require_room(const Room& room) {
  if (!room.samples && room.capacity > 0) {
    throw CallError(SKB_ERROR_ARGUMENT,
                    fmt::format("{} is NULL with capacity {}", room.name, room.capacity));
  }
}

// Error: SIZE; the sweep's metadata are copied first.
void copy_sweep(const BoardSession::Arrived& arrived, skb_sweep* out, std::size_t size,
                const std::array<Room, 2>& rooms) {
  const skb_sweep sweep = sweep_of(arrived);
  copy_struct("sweep", &sweep, sizeof sweep, out, size, sizeof(skb_sweep));
  for (std::size_t i = 0; i < 2; ++i) {
    const auto& samples = arrived.sweep.samples[i];
    if (rooms[i].samples && rooms[i].capacity < samples.size()) {
      throw CallError(SKB_ERROR_SIZE, fmt::format("{} has room for {} of {} samples", rooms[i].name,
                                                  rooms[i].capacity, samples.size()));
    }
  }
  for (std::size_t i = 0; i < 2; ++i) {
    if (!rooms[i].samples) continue;
    std::copy(arrived.sweep.samples[i].begin(), arrived.sweep.samples[i].end(), rooms[i].samples);
  }
}

// Whether a sweep could be copied at all, before one is waited for.
void require_sweep_buffers(const skb_sweep* sweep, std::size_t size,
                           const std::array<Room, 2>& rooms) {
  require_pointer("sweep", sweep);
  if (size < sizeof(skb_sweep)) {
    throw CallError(SKB_ERROR_SIZE, fmt::format("sweep_size is {}; expected sizeof(skb_sweep), {}",
                                                size, sizeof(skb_sweep)));
  }
  for (const Room& room : rooms) require_room(room);
}

std::int32_t wait_for(skb_board* ticket, std::uint32_t events, std::uint32_t timeout_ms,
                      skb_event* event, std::size_t event_size) {
  return guarded([&] {
    const Duration timeout = duration_of(timeout_ms);
    require_range("events", events, 1, 2 * SKB_EVENT_RESET - 1);
    if (!event && event_size > 0) {
      throw CallError(SKB_ERROR_ARGUMENT,
                      fmt::format("event is NULL with event_size {}", event_size));
    }
    if (event && event_size < sizeof(skb_event)) {
      throw CallError(SKB_ERROR_SIZE,
                      fmt::format("event_size is {}; expected sizeof(skb_event), {}", event_size,
                                  sizeof(skb_event)));
    }
    const Held held(ticket);
    const board::Event came = held->wait(events, timeout);
    if (!event) return;
    const skb_event known{came.tick, came.event, came.faults, came.value, came.radar};
    copy_struct("event", &known, sizeof known, event, event_size, sizeof(skb_event));
  });
}

}  // namespace

extern "C" {

uint32_t skb_version(void) {
  return SKB_VERSION_MAJOR << 16 | SKB_VERSION_MINOR << 8 | SKB_VERSION_PATCH;
}

const char* skb_version_text(void) { return SKERRY_BOARD_VERSION_TEXT; }

const char* skb_last_error(void) { return last_error(); }

const char* skb_result_name(int32_t result) {
  static constexpr std::array kNames = {
      "OK",           "ARGUMENT",   "HANDLE",           "BUSY",
      "SIZE",         "TIMEOUT",    "UNREACHABLE",      "CLOSED",
      "REJECTED",     "PROTOCOL",   "UNKNOWN_REGISTER", "READ_ONLY",
      "OUT_OF_RANGE", "MISALIGNED", "MEMORY",           "INTERNAL"};
  static_assert(kNames.size() == SKB_ERROR_INTERNAL + 1);
  const auto index = static_cast<std::size_t>(result);
  return result >= 0 && index < kNames.size() ? kNames[index] : "UNKNOWN";
}

int32_t skb_open(const char* place, const char* token, uint32_t timeout_ms, skb_board** board) {
  return guarded([&] {
    require_pointer("board", board);
    *board = nullptr;
    const auto where = parse_board_place(text_of("place", place, kLongestPlace));
    if (!where) throw CallError(SKB_ERROR_ARGUMENT, where.error());
    require_range("timeout_ms", timeout_ms, 1, SKB_LONGEST_TIMEOUT_MS);
    const Duration timeout = std::chrono::milliseconds(timeout_ms);
    const std::string secret = token ? text_of("token", token, kLongestToken) : std::string();
    auto client =
        value_of(BoardClient::connect(where->host, where->port, where->radar, timeout, secret));
    if (where->shared_memory) value_of(client.map_ring(timeout));
    *board = BoardTable::global().add(
        std::make_shared<BoardSession>(std::move(client), where->shared_memory, timeout));
  });
}

int32_t skb_close(skb_board* board) {
  return guarded([&] { BoardTable::global().remove(board); });
}

int32_t skb_describe(skb_board* board, char* text, size_t capacity, size_t* size) {
  return guarded([&] { copy_text(Held(board)->description(), text, capacity, size); });
}

int32_t skb_read_register(skb_board* board, uint32_t address, uint32_t* value) {
  return skb_read_registers(board, &address, value, 1);
}

int32_t skb_write_register(skb_board* board, uint32_t address, uint32_t value) {
  return guarded([&] { Held(board)->access({{.address = address, .write = value}}); });
}

int32_t skb_read_register64(skb_board* board, uint32_t address, uint64_t* value) {
  return guarded([&] {
    require_pointer("value", value);
    require_range("address", address, 0, UINT32_MAX - 4);
    const auto halves = Held(board)->access({{.address = address}, {.address = address + 4}});
    *value = std::uint64_t{halves[1]} << 32 | halves[0];
  });
}

int32_t skb_read_registers(skb_board* board, const uint32_t* addresses, uint32_t* values,
                           size_t count) {
  return guarded([&] {
    require_pointer("addresses", addresses);
    require_pointer("values", values);
    require_range("count", count, 1, BoardClient::kMaxOperations);
    std::vector<BoardClient::Operation> reads;
    for (std::size_t i = 0; i < count; ++i) reads.push_back({.address = addresses[i]});
    const auto read = Held(board)->access(reads);
    std::copy(read.begin(), read.end(), values);
  });
}

int32_t skb_read_named(skb_board* board, const char* name, int64_t* value) {
  return guarded([&] {
    require_pointer("value", value);
    const NamedRegister found = find_named(name);
    std::vector<BoardClient::Operation> reads = {{.address = found.info->address}};
    if (found.is_wide) reads.push_back({.address = found.info->address + 4});
    const auto read = Held(board)->access(reads);
    if (found.is_wide) {
      *value = static_cast<std::int64_t>(std::uint64_t{read[1]} << 32 | read[0]);
    } else {
      *value = found.info->is_signed ? static_cast<std::int32_t>(read[0])
                                     : static_cast<std::int64_t>(read[0]);
    }
  });
}

int32_t skb_write_named(skb_board* board, const char* name, int64_t value) {
  return guarded([&] {
    const NamedRegister found = find_named(name);
    if (!is_allowed(*found.info, value)) {
      throw CallError(SKB_ERROR_OUT_OF_RANGE,
                      fmt::format("{}: {} is out of range; allowed: {}", found.info->name, value,
                                  board::allowed_text(*found.info)));
    }
    Held(board)->access(
        {{.address = found.info->address, .write = static_cast<std::uint32_t>(value)}});
  });
}

int32_t skb_find_register(const char* name, uint32_t* address) {
  return guarded([&] {
    require_pointer("address", address);
    *address = find_named(name).info->address;
  });
}

int32_t skb_fault_reason(skb_board* board, char* text, size_t capacity, size_t* size) {
  return guarded([&] { copy_text(Held(board)->fault_reason(), text, capacity, size); });
}

int32_t skb_start(skb_board* board) {
  return guarded([&] { Held(board)->start(); });
}

int32_t skb_read_sweep(skb_board* board, uint32_t timeout_ms, skb_sweep* sweep, size_t sweep_size,
                       uint16_t* a, size_t a_capacity, uint16_t* b, size_t b_capacity) {
  return guarded([&] {
    const Duration timeout = duration_of(timeout_ms);
    const std::array<Room, 2> rooms = {{{"a", a, a_capacity}, {"b", b, b_capacity}}};
    require_sweep_buffers(sweep, sweep_size, rooms);
    const Held held(board);
    copy_sweep(held->next_sweep(timeout), sweep, sweep_size, rooms);
    held->drop_sweep();
  });
}

int32_t skb_arm(skb_board* board) {
  return guarded([&] {
    // Not CONTROL, which would have to be read first: another program may write it meanwhile.
    Held(board)->access(
        {{.address = board::address_of(board::Digdar::trig_source), .write = kDigitiserTrigger},
         {.address = board::address_of(board::Digdar::command),
          .write = board::digdar_command::arm}});
  });
}

int32_t skb_read_fifo(skb_board* board, uint32_t timeout_ms, skb_sweep* sweep, size_t sweep_size,
                      uint16_t* a, size_t a_capacity, uint16_t* b, size_t b_capacity) {
  return guarded([&] {
    const Duration timeout = duration_of(timeout_ms);
    const std::array<Room, 2> rooms = {{{"a", a, a_capacity}, {"b", b, b_capacity}}};
    require_sweep_buffers(sweep, sweep_size, rooms);
    const Held held(board);
    copy_sweep(held->next_of_fifo(timeout), sweep, sweep_size, rooms);
    held->drop_of_fifo();
  });
}

int32_t skb_wait_arp(skb_board* board, uint32_t timeout_ms, skb_event* event, size_t event_size) {
  return wait_for(board, SKB_EVENT_ARP, timeout_ms, event, event_size);
}

int32_t skb_wait_event(skb_board* board, uint32_t events, uint32_t timeout_ms, skb_event* event,
                       size_t event_size) {
  return wait_for(board, events, timeout_ms, event, event_size);
}

int32_t skb_lost(skb_board* board, uint64_t* records) {
  return guarded([&] {
    require_pointer("records", records);
    *records = Held(board)->lost();
  });
}

int32_t skb_overruns(skb_board* board, uint32_t channel, uint32_t* sweeps) {
  return guarded([&] {
    require_pointer("sweeps", sweeps);
    require_range("channel", channel, 0, 1);
    const auto reg = channel == 0 ? board::Reg::overruns_a : board::Reg::overruns_b;
    *sweeps = Held(board)->access({{.address = board::address_of(reg)}}).front();
  });
}

}  // extern "C"

// FakeBoard: the interface board of a FakeServer's radar 3, and a ring in shared memory.
#pragma once

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <deque>
#include <functional>
#include <map>
#include <stdexcept>
#include <string>

#include "protocol/board/registers.hpp"
#include "protocol/board/sweep_record.hpp"
#include "protocol/board/sweep_ring.hpp"
#include "tests/unit/clients/fake_server.hpp"

namespace skerry::client {

inline constexpr std::uint32_t kBoardRadar = 3;

inline void say_board_hello(FakePeer& peer) {
  wire::ServerMessage message;
  auto* hello = message.mutable_hello();
  hello->set_protocol_version(1);
  hello->set_server("fake 1");
  for (std::uint32_t n = 0; n <= kBoardRadar; ++n) {
    auto* radar = hello->add_radars();
    radar->set_radar(n);
    radar->set_name("Mast\x1b[2J");
    radar->set_spokes_per_turn(256);
    radar->set_cells(256);
    radar->set_board(n == kBoardRadar);
  }
  peer.send(message);
}

// Pulse `n` of 512 a turn, 24 rpm, 4096 ACPs of 4096 ticks each, ARP at pulse 0 of each turn.
// Channel A: 8 samples n, n + 1 ...; channel B is off.
inline board::Sweep fake_sweep(std::uint64_t n) {
  board::Sweep sweep;
  board::SweepMeta& meta = sweep.meta;
  meta.radar = kBoardRadar;
  meta.trigger_count = n;
  meta.sample_clock_hz = 6'710'886;  // 4096 * 4096 ticks a turn of 2.5 s
  meta.trigger_tick = n * 32768 + 16;
  meta.acp_count = static_cast<std::uint32_t>(n % 512 * 8);
  meta.ticks_since_acp = 16;
  meta.acp_period = 4096;
  meta.acp_per_turn = 4096;
  meta.arp_ticks = 0;  // the ARP comes with an ACP
  meta.arp_count = static_cast<std::uint32_t>(n / 512);
  meta.utc_ns = 1'714'564'800'250'000'000;  // 2024-05-01T12:00:00.25
  meta.pulse_ns = 80;
  meta.prf_millihertz = 204'800;
  meta.channels[0] = {.samples = 8, .decimation = 1, .bits = 12};
  for (std::uint16_t i = 0; i < 8; ++i) {
    sweep.samples[0].push_back(static_cast<std::uint16_t>((n + i) % 4096));
  }
  return sweep;
}

inline board::Edges edges_of(std::uint64_t from, std::uint64_t to, std::vector<board::Edge> edges,
                             std::uint32_t clock_hz = 6'710'886) {
  board::Edges out;
  out.radar = kBoardRadar;
  out.sample_clock_hz = clock_hz;
  out.from_tick = from;
  out.to_tick = to;
  out.edges = std::move(edges);
  return out;
}

inline bool send_records(FakePeer& peer, const Bytes& records, std::uint32_t count) {
  wire::ServerMessage message;
  message.mutable_board_records()->set_radar(kBoardRadar);
  message.mutable_board_records()->set_count(count);
  message.mutable_board_records()->set_records(std::string(records.begin(), records.end()));
  return peer.send(message);
}
template <typename T>
bool send_record(FakePeer& peer, std::uint64_t sequence, const T& record) {
  Bytes bytes;
  board::append_record(bytes, sequence, record);
  return send_records(peer, bytes, 1);
}

// Registers that hold what is written (or clear its ones), a FIFO, whatever `on_stream` sends, and
// an own ship that lies still.
struct FakeBoard {
  std::map<std::uint32_t, std::uint32_t> registers;
  std::deque<board::Sweep> fifo;
  std::function<void(FakePeer&)> on_stream = [](FakePeer&) {};
  std::function<void(const wire::BoardAccess&)> on_access = [](const wire::BoardAccess&) {};
  std::string ring_name;
  std::uint64_t ring_bytes = 0;
  std::string fault_reason;

  void serve(FakePeer& peer) {
    say_board_hello(peer);
    while (const auto message = peer.receive()) {
      wire::ServerMessage answer;
      if (message->has_board_access()) {
        on_access(message->board_access());
        for (const auto& operation : message->board_access().operations()) {
          *answer.mutable_board()->add_results() = access(operation);
        }
        peer.send(answer);
      } else if (message->has_board_fifo()) {
        Bytes bytes;
        std::uint32_t count = 0;
        for (; count < message->board_fifo().count() && !fifo.empty(); ++count) {
          board::append_record(bytes, count, fifo.front());
          fifo.pop_front();
        }
        send_records(peer, bytes, count);
      } else if (message->has_board_ring()) {
        if (ring_name.empty()) {
          peer.answer(message->request(), wire::Reply::REFUSED, "no memory left");
          continue;
        }
        answer.mutable_board()->set_ring_name(ring_name);
        answer.mutable_board()->set_ring_bytes(ring_bytes);
        peer.send(answer);
      }
      peer.answer(message->request());
      if (message->has_subscribe()) {
        answer.mutable_own_ship()->set_name("Still");
        peer.send(answer);
        answer.mutable_settings()->set_range_nm(0.125);
        peer.send(answer);
      }
      if (message->has_board_stream() &&
          message->board_stream().kind() != wire::BoardStream::NONE) {
        on_stream(peer);
      }
    }
  }

 private:
  std::uint32_t value_at(std::uint32_t address) const {
    const auto reason = board::address_of(board::Reg::fault_reason);
    if (address >= reason && address < reason + board::kFaultReasonBytes) {
      std::uint32_t value = 0;
      for (std::uint32_t i = 0; i < 4 && address - reason + i < fault_reason.size(); ++i) {
        value |= std::uint32_t{static_cast<std::uint8_t>(fault_reason[address - reason + i])}
                 << (8 * i);
      }
      return value;
    }
    if (address == board::address_of(board::Reg::fifo_level)) {
      return static_cast<std::uint32_t>(fifo.size());
    }
    const auto found = registers.find(address);
    return found == registers.end() ? 0 : found->second;
  }
  void take(std::uint32_t address, std::uint32_t value) {
    const auto* const info = board::find_register(address);
    if (info->access == board::Access::write_ones_to_clear) {
      registers[address] &= ~value;
    } else {
      registers[address] = value;
    }
  }
  wire::BoardResult access(const wire::BoardOperation& operation) {
    wire::BoardResult result;
    const std::uint32_t address = operation.address();
    if (operation.has_write()) {
      const auto error = board::check_write(address, operation.write());
      result.set_error(static_cast<wire::BoardError>(error));
      if (error == board::RegisterError::ok) take(address, operation.write());
      result.set_value(operation.write());
      return result;
    }
    if (address % 4 != 0) {
      result.set_error(wire::BOARD_MISALIGNED);
    } else if (!board::find_register(address)) {
      result.set_error(wire::BOARD_UNKNOWN_REGISTER);
    }
    result.set_value(value_at(address));
    return result;
  }
};

// Shared memory with a ring in it, named as a server names its own.
class FakeRing {
 public:
  explicit FakeRing(std::size_t capacity = 1 << 20)
      : name_("/skerry-board-" + std::to_string(::getpid()) + "-3"),
        size_(board::ring_bytes(capacity)) {
    ::shm_unlink(name_.c_str());
    const int file = ::shm_open(name_.c_str(), O_RDWR | O_CREAT | O_EXCL, 0600);
    if (file < 0 || ::ftruncate(file, static_cast<off_t>(size_)) != 0) {
      throw std::runtime_error("no shared memory for the test");
    }
    memory_ = static_cast<std::uint8_t*>(
        ::mmap(nullptr, size_, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0));
    ::close(file);
    writer_.emplace(std::span(memory_, size_));
  }
  ~FakeRing() {
    ::munmap(memory_, size_);
    ::shm_unlink(name_.c_str());
  }
  FakeRing(const FakeRing&) = delete;
  FakeRing& operator=(const FakeRing&) = delete;

  const std::string& name() const { return name_; }
  std::size_t size() const { return size_; }
  std::span<std::uint8_t> memory() { return {memory_, size_}; }
  board::SweepRingWriter& writer() { return *writer_; }
  void write(std::uint64_t sequence, const board::Sweep& sweep) {
    Bytes bytes;
    board::append_record(bytes, sequence, sweep);
    writer_->write(bytes, sequence, 1);
  }

 private:
  std::string name_;
  std::size_t size_;
  std::uint8_t* memory_ = nullptr;
  std::optional<board::SweepRingWriter> writer_;
};

}  // namespace skerry::client

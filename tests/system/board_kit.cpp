#include "tests/system/board_kit.hpp"

#include <chrono>
#include <stdexcept>

namespace skerry::system_test {
namespace {

constexpr std::chrono::seconds kAnswer{60};

template <typename T>
T value_of(client::ClientResult<T> result) {
  if (!result) throw std::runtime_error("the board: " + result.error().text);
  return std::move(result).value();
}

}  // namespace

std::string board_scenario(const std::string& board) {
  return R"(name: Boards
seed: 11
own_ships:
  - name: Tern
    position: {lat: 60.36, lon: 4.70}
    course_deg: 335
    speed_kn: 12
    radars:
      - {name: X, spokes: 512, cells: 512, rpm: 12, range_nm: 6, board: )" +
         board + R"(}
      - {name: S, spokes: 512, cells: 512, rpm: 12, range_nm: 6}
  - name: Gannet
    position: {lat: 60.30, lon: 4.60}
    radars:
      - {name: Far, spokes: 512, cells: 512, rpm: 12, range_nm: 6}
targets:
  - {name: Tanker, position: {lat: 60.37, lon: 4.72}, course_deg: 160, speed_kn: 10,
     length_m: 182, beam_m: 32, height_m: 22}
)";
}

client::BoardClient board_at(std::uint16_t tcp_port, std::uint32_t radar) {
  return value_of(client::BoardClient::connect("127.0.0.1", tcp_port, radar, kAnswer));
}

void map_ring(client::BoardClient& board) { value_of(board.map_ring(kAnswer)); }

board::RegisterError write(client::BoardClient& board, board::Reg reg, std::uint32_t value) {
  return value_of(board.access({{board::address_of(reg), value}}, kAnswer)).at(0).error;
}

std::uint32_t read(client::BoardClient& board, board::Reg reg) {
  const auto values = value_of(board.access({{board::address_of(reg)}}, kAnswer));
  if (values.at(0).error != board::RegisterError::ok) {
    throw std::runtime_error("a register cannot be read: " +
                             std::string(board::name_of(values.at(0).error)));
  }
  return values.at(0).value;
}

void await_register(client::BoardClient& board, board::Reg reg,
                    const std::function<bool(std::uint32_t)>& condition) {
  const auto deadline = std::chrono::steady_clock::now() + kAnswer;
  while (!condition(read(board, reg))) {
    if (std::chrono::steady_clock::now() > deadline) {
      throw std::runtime_error("a register never got the value that was waited for");
    }
  }
}

void begin_stream(client::BoardClient& board, client::BoardStreamKind kind) {
  value_of(board.stream(kind, kAnswer));
}

board::DecodedRecord next_record(client::BoardClient& board) {
  auto record = value_of(board.next(kAnswer));
  if (!record) throw std::runtime_error("no record came from the board");
  return std::move(*record);
}

bool is_ramp(const board::Sweep& sweep) {
  const auto& samples = sweep.samples[0];
  const std::uint64_t steps = std::uint64_t{1} << sweep.meta.channels[0].bits;
  for (std::uint64_t i = 0; i < samples.size(); ++i) {
    if (samples[i] != (i + sweep.meta.trigger_count) % steps) return false;
  }
  return samples.size() == sweep.meta.channels[0].samples;
}

}  // namespace skerry::system_test

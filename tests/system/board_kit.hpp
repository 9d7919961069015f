// Steps that tests of interface boards share.  An answer that does not come within a
// minute, or any error, is a std::runtime_error.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "clients/board/board_client.hpp"
#include "tests/system/running_server.hpp"

namespace skerry::system_test {

// An own ship at sea with two radars of 12 turns a minute, X and S, and a second one with one: slow
// enough for boards of a server with a sanitizer.  `board` is the text of radar 0's board section.
std::string board_scenario(const std::string& board = "{}");

client::BoardClient board_at(std::uint16_t tcp_port, std::uint32_t radar = 0);
inline client::BoardClient board_of(const ServerProcess& server, std::uint32_t radar = 0) {
  return board_at(server.tcp_port(), radar);
}
void map_ring(client::BoardClient& board);

// Writes; true answers are board::RegisterError::ok.
board::RegisterError write(client::BoardClient& board, board::Reg reg, std::uint32_t value);
std::uint32_t read(client::BoardClient& board, board::Reg reg);
// Until it has reached a value, asked for again and again.
void await_register(client::BoardClient& board, board::Reg reg,
                    const std::function<bool(std::uint32_t)>& condition);

void begin_stream(client::BoardClient& board, client::BoardStreamKind kind);
board::DecodedRecord next_record(client::BoardClient& board);
// The next record of that type that meets the condition; others are passed over.
template <typename Kind>
Kind await_record(client::BoardClient& board, const std::function<bool(const Kind&)>& condition) {
  while (true) {
    board::DecodedRecord record = next_record(board);
    if (const Kind* const found = std::get_if<Kind>(&record.record); found && condition(*found)) {
      return *found;
    }
  }
}
inline board::Sweep next_sweep(client::BoardClient& board) {
  return await_record<board::Sweep>(board, [](const board::Sweep&) { return true; });
}

// Whether channel A is the ramp of the test mode, in every sample.
bool is_ramp(const board::Sweep& sweep);

}  // namespace skerry::system_test

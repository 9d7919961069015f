// Parts that the subcommands of `skerry board` share, and the list of them.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include "clients/board/board_client.hpp"
#include "clients/cli/command.hpp"

namespace skerry::client {

// `board` is the command they are subcommands of.
Command make_board_registers_command(CLI::App& board);
Command make_board_set_command(CLI::App& board);
Command make_board_scope_command(CLI::App& board);
Command make_board_watch_command(CLI::App& board);
Command make_board_ppi_command(CLI::App& board);
Command make_board_signals_command(CLI::App& board);

// Whose board, and by which way its records come.
struct BoardPlace {
  ServerPlace server;
  std::uint32_t radar = 0;
  std::string token;
  std::string stream = "tcp";  // or "shm"

  // --host, --port, --timeout, --radar, --token.
  void add_options(CLI::App& command);
  // --stream tcp|shm.
  void add_stream_option(CLI::App& command);

  Duration timeout() const { return server.timeout(); }
  ClientResult<BoardClient> connect() const;
  // Begins the stream: of all records (from shared memory if --stream says so), or of edges and
  // events alone.
  ClientResult<Done> start(BoardClient& client, BoardStreamKind kind) const;
  ClientResult<BoardClient> connect_stream(BoardStreamKind kind) const;
};

// Takes records as long as what a command wants keeps coming within the board's timeout, and
// nobody presses Ctrl-C.  `wanted`: what is waited for, e.g. "sweeps".
class PatientReader {
 public:
  PatientReader(BoardClient& client, const BoardPlace& place, std::string wanted);

  // nullopt after an error, which has been reported.
  std::optional<board::DecodedRecord> next();
  // Called when the wanted record has come: the timeout begins anew.
  void came();

 private:
  BoardClient& client_;
  const BoardPlace& place_;
  std::string wanted_;
  std::chrono::steady_clock::time_point last_;
};

// Reports as report() does, with advice that suits a board.
int report_board(const ClientError& error);

}  // namespace skerry::client

// skerry board: the interface board of a radar.
#include "clients/cli/board/board_command.hpp"

#include <fmt/format.h>

#include <array>
#include <chrono>
#include <utility>

#include "clients/cli/console.hpp"

namespace skerry::client {

void BoardPlace::add_options(CLI::App& command) {
  server.add_options(command);
  command.add_option("--radar", radar, "Index of the radar")->capture_default_str();
  command.add_option("--token", token, "Needed from another host than the server's")
      ->envname("SKERRY_TOKEN");
}

void BoardPlace::add_stream_option(CLI::App& command) {
  command
      .add_option("--stream", stream,
                  "tcp, or shm: the ring in shared memory, on the server's own host")
      ->check(CLI::IsMember({"tcp", "shm"}))
      ->capture_default_str();
}

ClientResult<BoardClient> BoardPlace::connect() const {
  if (!server.user.empty()) {
    return failure(ClientErrorKind::rejected,
                   "a board is asked with a token, not by a user; give --token");
  }
  return BoardClient::connect(server.host, server.port, radar, timeout(), token);
}

ClientResult<Done> BoardPlace::start(BoardClient& client, BoardStreamKind kind) const {
  return stream == "shm" && kind == BoardStreamKind::records ? client.map_ring(timeout())
                                                             : client.stream(kind, timeout());
}

ClientResult<BoardClient> BoardPlace::connect_stream(BoardStreamKind kind) const {
  auto client = connect();
  if (!client) return client;
  if (auto begun = start(*client, kind); !begun) return Failure{begun.error()};
  return client;
}

PatientReader::PatientReader(BoardClient& client, const BoardPlace& place, std::string wanted)
    : client_(client),
      place_(place),
      wanted_(std::move(wanted)),
      last_(std::chrono::steady_clock::now()) {}

void PatientReader::came() { last_ = std::chrono::steady_clock::now(); }

std::optional<board::DecodedRecord> PatientReader::next() {
  while (!interrupted()) {
    auto record = client_.next(kLookAround);
    if (!record) {
      report_board(record.error());
      return std::nullopt;
    }
    if (std::chrono::steady_clock::now() - last_ > place_.timeout()) {
      report(fmt::format("no {} from the board of radar {} of {} for {:g} s", wanted_, place_.radar,
                         client_.name(), place_.server.timeout_s),
             "skerry board registers shows whether it is running (CONTROL), the radar transmits "
             "(STATUS) and its settings fit each other (FAULTS).");
      return std::nullopt;
    }
    if (*record) return std::move(*record);
  }
  report("interrupted; nothing was written");
  return std::nullopt;
}

int report_board(const ClientError& error) {
  if (error.kind != ClientErrorKind::rejected) return report(error);
  return report(error.text,
                "skerry status shows the radars and their boards; shared memory is for programs "
                "of the server's own user on its own host, --stream tcp for all; from another "
                "host --token is needed.");
}

Command make_board_command(CLI::App& app) {
  CLI::App* board =
      app.add_subcommand("board", "Registers, sweeps and signals of a radar's interface board");
  board->require_subcommand(1);
  board->footer(
      "Examples:\n"
      "  skerry board registers\n"
      "  skerry board set TEST_MODE_A=rings SAMPLES_A=1024\n"
      "  skerry board scope\n"
      "  skerry board watch\n"
      "  skerry board ppi -o board.png\n"
      "  skerry board signals --vcd turn.vcd\n"
      "Each says more with --help.\n");
  const std::array commands = {
      make_board_registers_command(*board), make_board_set_command(*board),
      make_board_scope_command(*board),     make_board_watch_command(*board),
      make_board_ppi_command(*board),       make_board_signals_command(*board)};
  return {board, [commands] {
            for (const Command& command : commands) {
              if (command.app->parsed()) return command.run();
            }
            return kExitUsage;
          }};
}

}  // namespace skerry::client

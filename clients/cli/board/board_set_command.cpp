// skerry board set: writes registers of the board.
#include <fmt/format.h>

#include <memory>
#include <string>
#include <vector>

#include "clients/cli/board/board_command.hpp"
#include "clients/cli/board/board_words.hpp"
#include "clients/cli/console.hpp"

namespace skerry::client {
namespace {

struct BoardSetOptions {
  BoardPlace place;
  std::vector<std::string> assignments;
};

std::string done_line(const RegisterWrite& write, std::uint32_t value) {
  const board::RegisterInfo* const info = board::find_register(write.address);
  if (!info) return fmt::format("0x{:03X} = 0x{:08X}\n", write.address, value);
  const std::string word = word_of(*info, value);
  return fmt::format("{} = {}{}{}{}\n", info->name, number_of(*info, value),
                     info->unit.empty() ? "" : " ", info->unit,
                     word.empty() ? "" : fmt::format(" ({})", word));
}

int run_board_set(const BoardSetOptions& options) {
  std::vector<RegisterWrite> writes;
  std::vector<BoardClient::Operation> operations;
  for (const std::string& text : options.assignments) {
    const auto write = parse_write(text);
    if (!write) {
      report(write.error());
      return kExitUsage;
    }
    writes.push_back(*write);
    operations.push_back({.address = write->address, .write = write->value});
  }
  // Reads the results at the same instant.
  for (const RegisterWrite& write : writes) operations.push_back({.address = write.address});
  auto client = options.place.connect();
  if (!client) return report_board(client.error());
  const auto values = client->access(operations, options.place.timeout());
  if (!values) return report_board(values.error());
  // The board judges the settings when all writes of an access are done.
  std::vector<BoardClient::Operation> reads = fault_reason_reads();
  reads.push_back({.address = board::address_of(board::Reg::faults)});
  const auto judged = client->access(reads, options.place.timeout());
  if (!judged) return report_board(judged.error());
  int exit_code = kExitOk;
  for (std::size_t i = 0; i < writes.size(); ++i) {
    const BoardClient::Value& value = (*values)[i];
    if (value.error == board::RegisterError::ok) {
      write_out(done_line(writes[i], (*values)[writes.size() + i].value));
    } else {
      exit_code = report(refusal(writes[i], value.error));
    }
  }
  if ((judged->back().value & board::fault::config) != 0) {
    const auto reason = fault_reason_text(std::span(*judged).first(reads.size() - 1));
    exit_code = report(fmt::format("the settings contradict each other: {}", reason),
                       "The board goes on with the last ones that did not.");
  }
  return exit_code;
}

}  // namespace

Command make_board_set_command(CLI::App& board) {
  auto options = std::make_shared<BoardSetOptions>();
  CLI::App* command =
      board.add_subcommand("set", "Writes registers, in their order at one instant");
  options->place.add_options(*command);
  command
      ->add_option("assignments", options->assignments,
                   "NAME=VALUE: decimal, hexadecimal with 0x, negative, or a word such as rings; "
                   "an address may stand for the name")
      ->required()
      ->expected(1, static_cast<int>(BoardClient::kMaxOperations / 2));
  command->footer(
      "Each write is taken or refused by itself; a refused one changes nothing and makes the exit\n"
      "code 1.  Shown is what the registers hold after the last write.\n"
      "Examples:\n"
      "  skerry board set PRF_MILLIHERTZ=3000000 SAMPLES_A=1024\n"
      "  skerry board set TEST_MODE_A=rings TEST_VALUE_A=200\n"
      "  skerry board set GAIN_A=-300 ARP_ERROR=0x100\n"
      "  skerry board set INJECT_MISSING_ACP=3            (a fault to see how others bear it)\n"
      "  skerry board set SOURCE_B=1 DETECTOR_B=linear    (the second channel, of radar 0)\n"
      "  skerry board set FAULTS_LATCHED=0xFFFFFFFF       (clears them)\n");
  return {command, [options] { return run_board_set(*options); }};
}

}  // namespace skerry::client

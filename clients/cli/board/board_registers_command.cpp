// skerry board registers: what the board's registers hold.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>
#include <thread>
#include <vector>

#include "clients/cli/board/board_command.hpp"
#include "clients/cli/board/board_words.hpp"
#include "clients/cli/console.hpp"
#include "clients/cli/number_within.hpp"
#include "protocol/board/digdar_page.hpp"
#include "protocol/wire/printable_text.hpp"

namespace skerry::client {
namespace {

struct RegistersOptions {
  BoardPlace place;
  std::vector<std::string> names;
  bool json = false;
  std::optional<double> watch_s;
};

using Registers = std::vector<const board::RegisterInfo*>;

struct Reading {
  std::vector<BoardClient::Value> values;  // of the registers chosen
  std::uint32_t faults = 0;
  std::string fault_reason;
};

std::string upper(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 32) : c; });
  return text;
}

// Those whose name contains one of `names`, or whose address is one of them; without names all of
// the board's own, of which FAULT_REASON is shown as a text.
Registers chosen(const std::vector<std::string>& names) {
  Registers registers;
  const auto choose = [&](const board::RegisterInfo& info) {
    const bool wanted =
        names.empty() || std::any_of(names.begin(), names.end(), [&](const std::string& name) {
          return info.name.find(upper(name)) != std::string_view::npos ||
                 parse_number(name) == info.address;
        });
    if (wanted) registers.push_back(&info);
  };
  for (const board::RegisterInfo& info : board::all_registers()) choose(info);
  if (names.empty()) return registers;
  for (const BoardClient::Operation& read : fault_reason_reads()) {
    if (const auto* const info = board::find_register(read.address)) choose(*info);
  }
  for (const board::RegisterInfo& info : board::digdar_infos()) choose(info);
  return registers;
}

ClientResult<Reading> read(BoardClient& client, const Registers& registers, Duration timeout) {
  std::vector<BoardClient::Operation> reads = fault_reason_reads();
  reads.push_back({.address = board::address_of(board::Reg::faults)});
  const std::size_t first = reads.size();
  for (const auto* info : registers) reads.push_back({.address = info->address});
  auto values = client.access(reads, timeout);
  if (!values) return Failure{values.error()};
  return Reading{.values = {values->begin() + static_cast<std::ptrdiff_t>(first), values->end()},
                 .faults = (*values)[first - 1].value,
                 .fault_reason = fault_reason_text(std::span(*values).first(first - 1))};
}

std::string access_letters(board::Access access) {
  switch (access) {
    case board::Access::read_only:
      return "r";
    case board::Access::read_write:
      return "rw";
    case board::Access::write_ones_to_clear:
      return "w1c";
  }
  return "?";
}

std::string registers_table(const BoardClient& client, const Registers& registers,
                            const Reading& reading) {
  std::string out = fmt::format("board of radar {} ({}) of {}\n", client.radar().radar(),
                                printable(client.radar().name(), 40), client.name());
  if (reading.faults != 0) {
    out += fmt::format("FAULTS: {}", fault_words(reading.faults));
    if (!reading.fault_reason.empty()) out += fmt::format(": {}", reading.fault_reason);
    out += '\n';
  }
  out += fmt::format("{:<7} {:<26} {:>11} {:<11} {:<11} {:<3} {:<24} {}\n", "ADDRESS", "NAME",
                     "VALUE", "HEX", "UNIT", "", "RANGE", "WHAT");
  for (std::size_t i = 0; i < registers.size(); ++i) {
    const board::RegisterInfo& info = *registers[i];
    const BoardClient::Value& value = reading.values[i];
    const std::string address = fmt::format("0x{:03X}", info.address);
    if (value.error != board::RegisterError::ok) {
      out += fmt::format("{:<8}{:<26} {}\n", address, info.name, board::name_of(value.error));
      continue;
    }
    const std::string word = word_of(info, value.value);
    out += fmt::format("{:<8}{:<26} {:>11} 0x{:08X}  {:<11} {:<3} {:<24} {}{}\n", address,
                       info.name, number_of(info, value.value), value.value, info.unit,
                       access_letters(info.access), range_column(info),
                       word.empty() ? "" : fmt::format("[{}] ", word), info.what);
  }
  return out;
}

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : printable(text)) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + '"';
}

std::string registers_json(const BoardClient& client, const Registers& registers,
                           const Reading& reading) {
  std::string out = fmt::format(
      "{{\"radar\": {}, \"name\": {}, \"faults\": {}, \"fault_reason\": {}, "
      "\"registers\": [",
      client.radar().radar(), quoted(client.radar().name()), reading.faults,
      quoted(reading.fault_reason));
  bool first = true;
  for (std::size_t i = 0; i < registers.size(); ++i) {
    const board::RegisterInfo& info = *registers[i];
    const BoardClient::Value& value = reading.values[i];
    if (value.error != board::RegisterError::ok) continue;
    out += fmt::format(
        "{}{{\"address\": {}, \"name\": \"{}\", \"value\": {}, \"word\": {}, "
        "\"unit\": \"{}\"}}",
        first ? "" : ", ", info.address, info.name, number_of(info, value.value),
        quoted(word_of(info, value.value)), info.unit);
    first = false;
  }
  return out + "]}\n";
}

void pause(double seconds) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  while (!interrupted()) {
    const auto left = end - std::chrono::steady_clock::now();
    if (left <= left.zero()) return;
    std::this_thread::sleep_for(std::min<std::chrono::duration<double>>(left, kLookAround));
  }
}

int run_registers(const RegistersOptions& options) {
  const Registers registers = chosen(options.names);
  if (registers.empty()) {
    report(fmt::format("no register has '{}' in its name, or for its address",
                       printable(options.names.front(), 40)),
           "skerry board registers lists them all.");
    return kExitUsage;
  }
  auto client = options.place.connect();
  if (!client) return report_board(client.error());
  const bool redraw = options.watch_s && !options.json && ::isatty(STDOUT_FILENO) == 1;
  do {
    const auto reading = read(*client, registers, options.place.timeout());
    if (!reading) return report_board(reading.error());
    const std::string text =
        (options.json ? registers_json : registers_table)(*client, registers, *reading);
    write_out(redraw ? "\x1b[H\x1b[J" + text : text);
    if (options.watch_s) pause(*options.watch_s);
  } while (options.watch_s && !interrupted());
  return kExitOk;
}

}  // namespace

Command make_board_registers_command(CLI::App& board) {
  auto options = std::make_shared<RegistersOptions>();
  CLI::App* command =
      board.add_subcommand("registers", "Shows the registers, all read at one instant");
  options->place.add_options(*command);
  command->add_option(
      "names", options->names,
      "Only registers with one of these in their name, or at this address; those of the "
      "digitiser's page and FAULT_REASON too");
  command->add_flag("--json", options->json, "JSON, one line per reading");
  command
      ->add_option_function<double>(
          "--watch", [options](double seconds) { options->watch_s = seconds; },
          "Again every so many seconds, until Ctrl-C")
      ->expected(0, 1)
      ->default_str("1")
      ->check(number_within(0.1, 3600.0));
  command->footer(
      "The column before RANGE says r: read only, rw: read and write, w1c: writing ones clears.\n"
      "Examples:\n"
      "  skerry board registers\n"
      "  skerry board registers acp arp trigger_count --watch 0.5\n"
      "  skerry board registers --json faults\n"
      "  skerry board registers digdar 0x080\n");
  return {command, [options] { return run_registers(*options); }};
}

}  // namespace skerry::client

// Readers of a Raymarine Quantum's packets, and the way there and back of what they read.
#include "protocol/raymarine/quantum_command.hpp"
#include "protocol/raymarine/quantum_locator.hpp"
#include "protocol/raymarine/quantum_report.hpp"
#include "protocol/raymarine/quantum_spoke.hpp"
#include "protocol/raymarine/run_length.hpp"
#include "tests/fuzz/fuzz_require.hpp"

namespace {

using namespace skerry;
using namespace skerry::raymarine;

template <typename T>
bool is_read(const Result<T, WireError>& result, std::span<const std::uint8_t> input) {
  if (result.ok()) return true;
  fuzz::require(!result.error().text.empty(), "a refusal says why");
  fuzz::require(result.error().offset <= input.size() + 20, "a refusal's place is in the datagram");
  return false;
}

void check_spoke(std::span<const std::uint8_t> input) {
  const auto spoke = decode_quantum_spoke(input);
  if (!is_read(spoke, input)) return;
  fuzz::require(spoke->cells.size() <= kQuantumMaxCells, "cells are bounded");
  Bytes bytes;
  append_quantum_spoke(bytes, *spoke);
  const auto again = decode_quantum_spoke(bytes);
  fuzz::require(again.ok() && again->cells == spoke->cells && again->azimuth == spoke->azimuth,
                "a spoke comes back the same");
}

void check_runs(std::span<const std::uint8_t> input) {
  constexpr std::size_t kMost = 4096;
  const auto plain = decode_runs(input, kMost);
  if (!is_read(plain, input)) return;
  fuzz::require(plain->size() <= kMost, "runs are bounded");
  Bytes coded;
  append_runs(coded, *plain);
  const auto again = decode_runs(coded, kMost);
  fuzz::require(again.ok() && *again == *plain, "runs come back the same");
}

void check_reports(std::span<const std::uint8_t> input) {
  const auto status = decode_quantum_status(input);
  if (is_read(status, input)) {
    const auto again = decode_quantum_status(encode_quantum_status(*status));
    fuzz::require(again.ok() && *again == *status, "a status comes back the same");
  }
  const auto info = decode_quantum_info(input);
  if (is_read(info, input)) {
    const auto again = decode_quantum_info(encode_quantum_info(*info));
    fuzz::require(again.ok() && again->serial_number == info->serial_number,
                  "a name comes back the same");
  }
}

void check_locator(std::span<const std::uint8_t> input) {
  const auto addresses = decode_locator_addresses(input);
  if (is_read(addresses, input)) {
    const auto again = decode_locator_addresses(encode_locator_addresses(*addresses));
    fuzz::require(again.ok() && again->data == addresses->data && again->radar == addresses->radar,
                  "addresses come back the same");
  }
  const auto name = decode_locator_name(input);
  if (is_read(name, input)) {
    const auto again = decode_locator_name(encode_locator_name(*name));
    fuzz::require(again.ok() && again->name == name->name, "a device's name comes back the same");
  }
}

void check_command(std::span<const std::uint8_t> input) {
  const auto command = decode_quantum_command(input);
  if (!is_read(command, input)) return;
  const auto again =
      decode_quantum_command(encode_quantum_command(command->control, command->value));
  fuzz::require(again.ok() && again->control == command->control &&
                    again->value == command->value && !again->clamped,
                "a command's value is within its range and comes back the same");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  check_spoke({data, size});
  check_runs({data, size});
  check_reports({data, size});
  check_locator({data, size});
  check_command({data, size});
  return 0;
}

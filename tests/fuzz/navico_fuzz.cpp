// All readers of Navico packets; the first octet says which.  What is read is written, and reads
// the same again.
#include <variant>

#include "protocol/navico/command.hpp"
#include "protocol/navico/frame.hpp"
#include "protocol/navico/locator.hpp"
#include "protocol/navico/report.hpp"
#include "protocol/navico/ship_data.hpp"
#include "tests/fuzz/fuzz_require.hpp"

namespace {

using namespace skerry;
using navico::Model;

template <typename T>
bool refused(const Result<T, WireError>& result, std::size_t size) {
  if (result.ok()) return false;
  fuzz::require(!result.error().text.empty(), "a refusal says why");
  fuzz::require(result.error().offset <= size, "a refusal's place is in the datagram");
  return true;
}

void check_command(std::span<const std::uint8_t> input) {
  const auto command = navico::decode_command(input);
  if (refused(command, input.size())) return;
  for (const bool halo : {false, true}) {
    const auto again = navico::decode_command(navico::encode_command(*command, halo));
    fuzz::require(again.ok(), "our own command is read");
    // A HALO's sea control writes only those octets that count.
    const bool same = *again == *command || command->kind == navico::CommandKind::halo_sea ||
                      command->kind == navico::CommandKind::halo_sea_mode ||
                      command->kind == navico::CommandKind::halo_sea_adjust;
    fuzz::require(same && again->kind == command->kind, "and is the same");
  }
}

void check_report(std::span<const std::uint8_t> input) {
  const auto report = navico::decode_report(input);
  if (refused(report, input.size())) return;
  const auto* identity = std::get_if<navico::IdentityReport>(&*report);
  if (identity != nullptr) {
    fuzz::require(identity->firmware_date.size() <= 15 && identity->firmware_time.size() <= 15,
                  "texts are short");
  }
  const Bytes octets =
      std::visit([](const auto& fields) { return navico::encode(Model::halo, fields); }, *report);
  const auto again = navico::decode_report(octets);
  fuzz::require(again.ok() && *again == *report, "a report reads the same again");
}

void check_locator(std::span<const std::uint8_t> input) {
  const auto locator = navico::decode_locator(input);
  if (refused(locator, input.size())) return;
  std::size_t groups = 0;
  for (const auto& service : locator->services) groups += service.groups.size();
  fuzz::require(6 * locator->services.size() + 10 * groups <= input.size(),
                "what comes back was all there");
  (void)locator->find_picture(1);
  const auto again = navico::decode_locator(navico::encode_locator(*locator));
  fuzz::require(again.ok() && *again == *locator, "a locator reads the same again");
}

void check_frame(std::span<const std::uint8_t> input) {
  for (const Model model : {Model::br24, Model::g4, Model::halo}) {
    const auto spokes = navico::decode_frame(model, input);
    if (refused(spokes, input.size())) return;
    fuzz::require(spokes->size() <= navico::kFrameSpokes, "a frame has at most 32 spokes");
    for (const auto& spoke : *spokes) {
      fuzz::require(spoke.fields.angle < navico::kTurnUnits, "angles are of one turn");
      (void)navico::heading_of(spoke.fields.heading);
      for (const std::uint8_t cell : spoke.cells) fuzz::require(cell < 16, "cells have 4 bits");
    }
  }
}

void check_ship(std::span<const std::uint8_t> input) {
  const auto packet = navico::decode_ship_packet(input);
  if (refused(packet, input.size())) return;
  const Bytes octets =
      std::visit([](const auto& fields) { return navico::encode(fields); }, *packet);
  const auto again = navico::decode_ship_packet(octets);
  fuzz::require(again.ok() && again->index() == packet->index(), "a packet reads the same again");
  fuzz::require(
      std::visit([](const auto& fields) { return navico::encode(fields); }, *again) == octets,
      "to the last bit");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::span<const std::uint8_t> input(data + 1, size - 1);
  switch (data[0] % 5) {
    case 0:
      check_command(input);
      break;
    case 1:
      check_report(input);
      break;
    case 2:
      check_locator(input);
      break;
    case 3:
      check_frame(input);
      break;
    default:
      check_ship(input);
  }
  return 0;
}

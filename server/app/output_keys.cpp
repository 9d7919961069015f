#include "server/app/output_keys.hpp"

#include <fmt/format.h>
#include <google/protobuf/descriptor.h>

#include <algorithm>
#include <stdexcept>
#include <string_view>
#include <vector>

namespace skerry::server {
namespace {

using app::Output;
using Keys = std::vector<std::string_view>;

const Keys& keys_of(Output::Kind kind) {
  static const Keys native = {"kind",   "radar",   "view", "interface_address",
                              "ttl",    "address", "port", "max_datagram",
                              "spokes", "cells",   "bits"};
  static const Keys cat240 = {"kind",        "radar",       "view",        "interface_address",
                              "ttl",         "address",     "port",        "max_datagram",
                              "spokes",      "cells",       "bits",        "sac",
                              "sic",         "nanoseconds", "blocks",      "compressed",
                              "time_of_day", "summaries",   "start_range", "records"};
  static const Keys radar = {
      "kind",       "radar",   "view",   "interface_address", "ttl",      "serial", "obeys",
      "dual_range", "radar_b", "view_b", "standby_after_s",   "addresses"};
  static const Keys sentences = {"kind",
                                 "radar",
                                 "interface_address",
                                 "ttl",
                                 "address",
                                 "port",
                                 "transport",
                                 "broadcast",
                                 "sentences",
                                 "own_mmsi",
                                 "ais_range_nm",
                                 "tracking_range_nm",
                                 "tracked_targets",
                                 "static_period_s",
                                 "says_simulated"};
  static const Keys iec450 = {"kind",
                              "radar",
                              "interface_address",
                              "ttl",
                              "address",
                              "port",
                              "source",
                              "sentences",
                              "own_mmsi",
                              "ais_range_nm",
                              "tracking_range_nm",
                              "tracked_targets",
                              "static_period_s",
                              "says_simulated"};
  switch (kind) {
    case Output::native:
      return native;
    case Output::cat240:
      return cat240;
    case Output::nmea0183:
      return sentences;
    case Output::iec61162_450:
      return iec450;
    default:
      return radar;
  }
}

}  // namespace

std::string name_of(const Output& output, int index) {
  return fmt::format("outputs[{}] ({})", index, Output::Kind_Name(output.kind()));
}

void check_keys(const Output& output, const std::string& name) {
  std::vector<const google::protobuf::FieldDescriptor*> given;
  output.GetReflection()->ListFields(output, &given);
  const Keys& keys = keys_of(output.kind());
  for (const auto* field : given) {
    if (std::find(keys.begin(), keys.end(), field->name()) != keys.end()) continue;
    throw std::runtime_error(fmt::format("{}: '{}' is not a key of this kind; it takes {}", name,
                                         field->name(), fmt::join(keys, ", ")));
  }
}

}  // namespace skerry::server

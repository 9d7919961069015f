#include "clients/recording/radar_numbers.hpp"

#include <fmt/format.h>
#include <google/protobuf/descriptor.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <set>

#include "protocol/recording/topics.hpp"
#include "protocol/wire/printable_text.hpp"

namespace skerry::client {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;
using recording::Item;
using recording::RecordingReader;

// Radars that a recording says it has, or has items of.
std::map<std::uint32_t, wire::RadarInfo> radars_of(const RecordingReader& reader) {
  std::map<std::uint32_t, wire::RadarInfo> radars;
  for (const auto& [topic, count] : reader.summary().items) {
    if (is_of_a_radar(topic.kind)) radars[topic.radar].set_radar(topic.radar);
  }
  if (const auto hello = reader.hello()) {
    for (const auto& info : hello->radars()) radars[info.radar()] = info;
  }
  return radars;
}

bool same_radar(const wire::RadarInfo& a, const wire::RadarInfo& b) {
  return a.name() == b.name() && a.own_ship() == b.own_ship() &&
         a.spokes_per_turn() == b.spokes_per_turn();
}

// Renames the radars that a message names: its field `radar`, and `radars` of it and of its lists.
// False: it has no such field.
bool rename_radars(Message& message, const std::function<std::uint32_t(std::uint32_t)>& rename) {
  const auto& at = *message.GetReflection();
  const auto& fields = *message.GetDescriptor();
  bool names_some = false;
  for (int i = 0; i < fields.field_count(); ++i) {
    const FieldDescriptor& field = *fields.field(i);
    const bool is_list = field.is_repeated();
    const bool names_radar = field.cpp_type() == FieldDescriptor::CPPTYPE_UINT32 &&
                             field.name() == (is_list ? "radars" : "radar");
    names_some |= names_radar;
    if (names_radar && !is_list) {
      at.SetUInt32(&message, &field, rename(at.GetUInt32(message, &field)));
    }
    for (int k = 0; is_list && k < at.FieldSize(message, &field); ++k) {
      if (names_radar) {
        at.SetRepeatedUInt32(&message, &field, k, rename(at.GetRepeatedUInt32(message, &field, k)));
      } else if (field.cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE) {
        names_some |= rename_radars(*at.MutableRepeatedMessage(&message, &field, k), rename);
      }
    }
  }
  return names_some;
}

}  // namespace

RadarNumbers::RadarNumbers(std::span<const RecordingReader> sources) {
  hello_ = sources.front().hello().value_or(wire::Hello{});
  UtcTime end = UtcTime::min();
  for (std::size_t i = 0; i < sources.size(); ++i) {
    add(i, sources[i], sources[i].summary().begin >= end);
    end = std::max(end, sources[i].summary().end);
  }
  hello_.clear_radars();
  for (const auto& [number, info] : taken_) {
    *hello_.add_radars() = info;
    hello_.mutable_radars()->rbegin()->set_radar(number);
  }
}

void RadarNumbers::add(std::size_t source, const RecordingReader& reader, bool follows) {
  numbers_.emplace_back();
  std::set<std::uint32_t> used;  // by radars of this source
  for (const auto& [radar, info] : radars_of(reader)) {
    std::uint32_t number = radar;
    const auto there = taken_.find(radar);
    if (there != taken_.end() && !(follows && same_radar(there->second, info))) {
      number = taken_.rbegin()->first + 1;
    }
    while (used.contains(number)) ++number;
    used.insert(number);
    numbers_[source][radar] = number;
    taken_.emplace(number, info);
    if (number != radar) {
      changes_.push_back(fmt::format("radar {} of {} is radar {} now", radar,
                                     printable(reader.summary().file), number));
    }
  }
}

std::uint32_t RadarNumbers::of(std::size_t source, std::uint32_t radar) const {
  const auto found = numbers_[source].find(radar);
  return found == numbers_[source].end() ? radar : found->second;
}

Item RadarNumbers::renamed(std::size_t source, const Item& item) {
  const auto& numbers = numbers_[source];
  if (std::all_of(numbers.begin(), numbers.end(),
                  [](const auto& each) { return each.first == each.second; })) {
    return item;
  }
  const recording::KindRow& row = recording::row_of(item.topic.kind);
  // Inputs name the radars of the exercise, which joining does not change.
  if (row.edit == recording::EditRule::cumulated) return item;
  Item out = item;
  if (is_of_a_radar(item.topic.kind)) out.topic.radar = of(source, item.topic.radar);
  const std::unique_ptr<Message> message(row.message().New());
  if (!message->ParseFromArray(item.bytes.data(), static_cast<int>(item.bytes.size()))) return out;
  if (!rename_radars(*message, [&](std::uint32_t radar) { return of(source, radar); })) return out;
  bytes_ = message->SerializeAsString();
  if (!bytes_.empty()) {
    out.bytes = {reinterpret_cast<const std::uint8_t*>(bytes_.data()), bytes_.size()};
  }
  return out;
}

}  // namespace skerry::client

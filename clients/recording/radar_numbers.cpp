#include "clients/recording/radar_numbers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "protocol/recording/recording.pb.h"
#include "protocol/wire/printable_text.hpp"

namespace skerry::client {
namespace {

using recording::Item;
using recording::Kind;
using recording::RecordingReader;

// Radars that a recording says it has, or has items of.
std::map<std::uint32_t, wire::RadarInfo> radars_of(const RecordingReader& reader) {
  std::map<std::uint32_t, wire::RadarInfo> radars;
  for (const auto& [topic, count] : reader.summary().items) {
    if (topic.kind == Kind::spoke || topic.kind == Kind::settings || topic.kind == Kind::own_ship) {
      radars[topic.radar].set_radar(topic.radar);
    }
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

// Re-serialises `item` as a Message whose radar is set by `change`; empty if it cannot be read.
template <typename Message, typename Change>
std::string changed(const Item& item, const Change& change) {
  Message message;
  if (!message.ParseFromArray(item.bytes.data(), static_cast<int>(item.bytes.size()))) return {};
  change(message);
  return message.SerializeAsString();
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
  const auto rename = [&](auto& message) { message.set_radar(of(source, message.radar())); };
  Item out = item;
  bytes_.clear();
  switch (item.topic.kind) {
    case Kind::spoke:
      bytes_ = changed<wire::Spoke>(item, rename);
      break;
    case Kind::settings:
      bytes_ = changed<wire::Settings>(item, rename);
      break;
    case Kind::own_ship:
      bytes_ = changed<wire::OwnShip>(item, rename);
      break;
    case Kind::event:
      bytes_ = changed<recording::Event>(item, rename);
      break;
    case Kind::traffic:
      bytes_ = changed<recording::Traffic>(item, [&](recording::Traffic& traffic) {
        for (auto& each : *traffic.mutable_items()) {
          for (auto& radar : *each.mutable_radars()) radar = of(source, radar);
        }
      });
      break;
    case Kind::hello:
    case Kind::world:
    case Kind::log:
    case Kind::input:
      return item;
  }
  if (item.topic.kind != Kind::event && item.topic.kind != Kind::traffic) {
    out.topic.radar = of(source, item.topic.radar);
  }
  if (!bytes_.empty()) {
    out.bytes = {reinterpret_cast<const std::uint8_t*>(bytes_.data()), bytes_.size()};
  }
  return out;
}

}  // namespace skerry::client

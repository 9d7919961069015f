// RelayedState: what is in force at the place where a playback stands, besides the video.
#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "protocol/quantity/time.hpp"
#include "protocol/recording/item.hpp"
#include "protocol/recording/recording.pb.h"
#include "protocol/video/spoke.hpp"
#include "protocol/wire/radar.pb.h"
#include "server/core/traffic.hpp"

namespace skerry::server {

// Settings, own ships, world, traffic and the exercise as the last items said, brought into range.
// Between items ships sail on as they did, for at most kSailsOn. If a file has no own ships or no
// settings, position, heading and range scale come from its spokes. Radars are the playback's (they
// are numbered anew), views the recording's. Thread: one writes (the playback), any read.
class RelayedState {
 public:
  static constexpr Duration kSailsOn = std::chrono::seconds(3);

  // False if the bytes are no such message, or of a kind that is not kept here.  `topic` with the
  // playback's number of the radar.  `radars`: by recorded number, the playback's.
  bool take(const recording::Topic& topic, UtcTime time, std::span<const std::uint8_t> bytes,
            const std::map<std::uint32_t, std::uint32_t>& radars);
  void take(const SpokeHeader& header);
  // A view that has ended.
  void forget(std::uint32_t radar, std::uint32_t view);

  wire::Settings settings(std::uint32_t radar, std::uint32_t view) const;
  // `now`: where the playback stands.  `utc`: what the ship's time is to be; nothing: her own.
  wire::OwnShip own_ship(std::uint32_t radar, UtcTime now, std::optional<UtcTime> utc) const;
  wire::World world() const;
  std::vector<TrafficItem> traffic(UtcTime now) const;
  // Truth, for instructors; nothing before the first state of the exercise.
  std::optional<wire::ExerciseState> exercise(UtcTime now) const;

  std::uint64_t settings_version() const;
  std::uint64_t world_version() const;

 private:
  template <typename T>
  struct Timed {
    UtcTime time{};
    T value;
  };
  using ViewKey = std::pair<std::uint32_t, std::uint32_t>;  // radar, view

  mutable std::mutex mutex_;
  std::map<ViewKey, wire::Settings> settings_;
  std::map<ViewKey, SpokeHeader> spokes_;  // the newest
  std::map<std::uint32_t, Timed<wire::OwnShip>> own_ships_;
  wire::World world_;
  Timed<std::vector<TrafficItem>> traffic_;
  std::optional<wire::ExerciseState> exercise_;
  UtcTime exercise_time_{};
  std::uint64_t settings_version_ = 1, world_version_ = 1;
};

}  // namespace skerry::server

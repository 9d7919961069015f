// A RadarHost without radars: the test publishes spokes itself, from its own thread.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "server/core/radar_host.hpp"

namespace skerry::server {

// Spokes of kSpokesPerTurn by kCells, full of bytes that depend on radar and sequence.
class FakeHost final : public RadarHost {
 public:
  static constexpr std::uint32_t kSpokesPerTurn = 256;
  static constexpr std::uint32_t kCells = 1024;
  static constexpr std::uint32_t kSectorSpokes = 16;

  explicit FakeHost(std::uint32_t radars = 1, std::size_t ring_sectors = 64) {
    for (std::uint32_t i = 0; i < radars; ++i) {
      radars_.push_back(std::make_unique<Radar>(ring_sectors));
      radars_.back()->settings.set_radar(i);
      radars_.back()->settings.set_range_nm(12);
      radars_.back()->settings.set_gain(50);
    }
  }

  wire::Hello hello() const override {
    wire::Hello hello;
    hello.set_protocol_version(1);
    hello.set_server("fake");
    for (std::uint32_t i = 0; i < radars_.size(); ++i) {
      wire::RadarInfo& info = *hello.add_radars();
      info.set_radar(i);
      info.set_spokes_per_turn(kSpokesPerTurn);
      info.set_cells(kCells);
      info.set_bits(8);
      info.set_rpm(24);
    }
    return hello;
  }
  std::uint32_t radar_count() const override { return static_cast<std::uint32_t>(radars_.size()); }
  VideoChannel* find_channel(std::uint32_t radar, std::uint32_t view) override {
    return radar < radars_.size() && view == 0 ? &radars_[radar]->channel : nullptr;
  }

  wire::Reply apply(const wire::Set& set) override {
    const std::lock_guard lock(mutex_);
    last_set_ = set;
    wire::Reply reply;
    if (set.radar() >= radars_.size()) {
      reply.set_code(wire::Reply::UNKNOWN);
    } else if (set.gain() < 0 || set.gain() > 100) {
      reply.set_code(wire::Reply::OUT_OF_RANGE);
      reply.set_text("gain must be 0 to 100");
    } else {
      radars_[set.radar()]->settings.set_gain(set.gain());
      ++settings_version_;
    }
    return reply;
  }
  wire::Set last_set() const {
    const std::lock_guard lock(mutex_);
    return last_set_;
  }

  wire::Settings settings(std::uint32_t radar, std::uint32_t) const override {
    const std::lock_guard lock(mutex_);
    return radars_[radar]->settings;
  }
  wire::OwnShip own_ship(std::uint32_t radar) const override {
    wire::OwnShip ship;
    ship.set_radar(radar);
    ship.set_name("ship of radar " + std::to_string(radar));
    return ship;
  }
  wire::Status status() const override {
    wire::Status status;
    status.set_server("fake");
    return status;
  }
  std::uint64_t settings_version() const override {
    const std::lock_guard lock(mutex_);
    return settings_version_;
  }

  Spoke spoke(std::uint32_t radar, std::uint64_t sequence) const {
    Spoke spoke;
    spoke.header.radar = radar;
    spoke.header.sequence = sequence;
    spoke.header.scan = static_cast<std::uint32_t>(sequence / kSpokesPerTurn);
    spoke.header.index = static_cast<std::uint32_t>(sequence % kSpokesPerTurn);
    spoke.header.geometry = {.spokes_per_turn = kSpokesPerTurn, .cells = kCells, .bits = 8};
    spoke.header.utc = UtcTime(Duration(1'795'000'000'000'000'000 + sequence * 1000));
    spoke.cells.resize(kCells);
    std::uint64_t state = sequence * 2 + radar + 1;
    for (auto& cell : spoke.cells) {
      state = state * 6364136223846793005u + 1442695040888963407u;
      cell = static_cast<std::uint8_t>(state >> 56);
    }
    return spoke;
  }

  // The next sector of the radar.
  void publish(std::uint32_t radar = 0) {
    Sector sector;
    for (std::uint32_t i = 0; i < kSectorSpokes; ++i) {
      sector.spokes.push_back(
          std::make_shared<const Spoke>(spoke(radar, radars_[radar]->published++)));
    }
    radars_[radar]->channel.publish(sector);
  }
  // Spokes.  Thread: the publishing one.
  std::uint64_t published(std::uint32_t radar = 0) const { return radars_[radar]->published; }
  std::uint64_t encoded(const std::string& format, std::uint32_t radar = 0) const {
    return radars_[radar]->channel.spokes_encoded().at(format);
  }

 private:
  struct Radar {
    explicit Radar(std::size_t ring_sectors) : channel(ring_sectors) {}
    VideoChannel channel;
    wire::Settings settings;
    std::uint64_t published = 0;
  };
  std::vector<std::unique_ptr<Radar>> radars_;
  mutable std::mutex mutex_;  // of settings, settings_version_ and last_set_
  wire::Set last_set_;
  std::uint64_t settings_version_ = 1;
};

}  // namespace skerry::server

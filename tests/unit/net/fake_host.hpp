// A RadarHost without radars: the test publishes spokes itself, from its own thread.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "server/core/radar_host.hpp"
#include "tests/unit/net/fake_board.hpp"

namespace skerry::server {

// Spokes of kSpokesPerTurn by kCells, full of bytes that depend on radar and sequence.
class FakeHost : public RadarHost {
 public:
  static constexpr std::uint32_t kSpokesPerTurn = 256;
  static constexpr std::uint32_t kCells = 1024;
  static constexpr std::uint32_t kSectorSpokes = 16;
  static constexpr Duration kSpokeTime = std::chrono::microseconds(1);

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
      info.set_own_ship("ship of radar " + std::to_string(i));
      info.set_spokes_per_turn(kSpokesPerTurn);
      info.set_cells(kCells);
      info.set_bits(8);
      info.set_rpm(24);
    }
    return hello;
  }
  std::uint32_t radar_count() const override { return static_cast<std::uint32_t>(radars_.size()); }
  VideoChannelPtr find_channel(std::uint32_t radar, std::uint32_t view) override {
    const std::lock_guard lock(mutex_);
    if (radar >= radars_.size()) return nullptr;
    const auto& channels = radars_[radar]->channels;
    const auto found = channels.find(view);
    return found == channels.end() ? nullptr : found->second;
  }
  // At most so many views, 0 among them, numbered upwards.
  static constexpr std::size_t kMaxViews = 3;
  std::optional<std::uint32_t> open_view(
      std::uint32_t radar, std::uint32_t, bool,
      const std::function<void(VideoChannel&)>& prepare) override {
    const std::lock_guard lock(mutex_);
    Radar& mine = *radars_[radar];
    if (mine.channels.size() == kMaxViews) return std::nullopt;
    auto channel = std::make_shared<VideoChannel>(64);
    prepare(*channel);
    mine.channels.emplace(++mine.last_view, std::move(channel));
    ++views_version_;
    return mine.last_view;
  }
  // The next view to be opened has the number after this.
  void count_views_from(std::uint32_t number, std::uint32_t radar = 0) {
    const std::lock_guard lock(mutex_);
    radars_[radar]->last_view = number;
  }
  void close_view(std::uint32_t radar, std::uint32_t view) override {
    const std::lock_guard lock(mutex_);
    if (view != 0) radars_[radar]->channels.erase(view);
    ++views_version_;
  }
  std::vector<View> views(std::uint32_t radar) override {
    const std::lock_guard lock(mutex_);
    std::vector<View> views;
    for (const auto& [view, channel] : radars_[radar]->channels) views.push_back({view, channel});
    return views;
  }
  std::uint64_t views_version() const override {
    const std::lock_guard lock(mutex_);
    return views_version_;
  }
  std::size_t view_count(std::uint32_t radar) const {
    const std::lock_guard lock(mutex_);
    return radars_[radar]->channels.size();
  }

  // The board of radar 0, if the test gives it one.
  std::shared_ptr<FakeBoard> board;
  BoardPortPtr find_board(std::uint32_t radar) override { return radar == 0 ? board : nullptr; }

  UtcTime begin_utc{std::chrono::seconds(1'795'000'000)};  // of spoke 0

  // The recorder and player, if the test has one.
  RecordingPort* recorder = nullptr;
  PlaybackPort* player = nullptr;
  RecordingPort* recording() override { return recorder; }
  PlaybackPort* playback() override { return player; }

  // The plotters, if the test has some.
  TargetPort* plotters = nullptr;
  TargetPort* targets() override { return plotters; }

  // The answer of traffic(); not to be changed while the server runs.
  std::vector<TrafficItem> traffic_items;
  std::vector<TrafficItem> traffic() const override { return traffic_items; }

  // Only the instructor may change the gain from now on.
  void lock_gain() {
    const std::lock_guard lock(mutex_);
    for (const auto& radar : radars_) radar->settings.add_locked("gain");
    ++settings_version_;
  }
  wire::Reply apply(const wire::Set& set, const std::string& origin) override {
    const std::lock_guard lock(mutex_);
    last_set_ = set;
    wire::Reply reply;
    if (set.has_gain() && radars_.front()->settings.locked_size() > 0) {
      reply.set_code(wire::Reply::REFUSED);
      reply.set_text("gain: locked by the instructor");
      return reply;
    }
    if (set.radar() >= radars_.size()) {
      reply.set_code(wire::Reply::UNKNOWN);
    } else if (set.gain() < 0 || set.gain() > 100) {
      reply.set_code(wire::Reply::OUT_OF_RANGE);
      reply.set_text("gain must be 0 to 100");
    } else {
      Radar& radar = *radars_[set.radar()];
      if (set.has_gain()) radar.settings.set_gain(set.gain());
      if (set.has_range_nm()) radar.settings.set_range_nm(set.range_nm());
      if (set.has_instrumented_range_m()) {
        radar.reaches[set.view()] = set.instrumented_range_m();
      } else {
        origins_.push_back(origin);
      }
      ++settings_version_;
    }
    return reply;
  }
  // Who asked for what was applied, but for instrumented ranges.
  std::vector<std::string> origins() const {
    const std::lock_guard lock(mutex_);
    return origins_;
  }
  wire::Set last_set() const {
    const std::lock_guard lock(mutex_);
    return last_set_;
  }

  std::string last_origin() const {
    const std::lock_guard lock(mutex_);
    return last_origin_;
  }

  wire::Settings settings(std::uint32_t radar, std::uint32_t view) const override {
    const std::lock_guard lock(mutex_);
    wire::Settings settings = radars_[radar]->settings;
    settings.set_view(view);
    const auto reach = radars_[radar]->reaches.find(view);
    if (reach != radars_[radar]->reaches.end()) settings.set_instrumented_range_m(reach->second);
    return settings;
  }
  wire::World world() const override {
    const std::lock_guard lock(mutex_);
    return world_;
  }
  void change_world(double sea_state) {
    const std::lock_guard lock(mutex_);
    world_.set_sea_state(sea_state);
    ++world_version_;
  }
  wire::OwnShip own_ship(std::uint32_t radar) const override {
    wire::OwnShip ship;
    ship.set_radar(radar);
    ship.set_name("ship of radar " + std::to_string(radar));
    ship.set_utc_ns(static_cast<std::uint64_t>(
        Duration(std::chrono::system_clock::now().time_since_epoch()).count()));
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
  std::uint64_t world_version() const override {
    const std::lock_guard lock(mutex_);
    return world_version_;
  }

  Spoke spoke(std::uint32_t radar, std::uint64_t sequence) const {
    Spoke spoke;
    spoke.header.radar = radar;
    spoke.header.sequence = sequence;
    spoke.header.scan = static_cast<std::uint32_t>(sequence / kSpokesPerTurn);
    spoke.header.index = static_cast<std::uint32_t>(sequence % kSpokesPerTurn);
    spoke.header.geometry = {.spokes_per_turn = kSpokesPerTurn, .cells = kCells, .bits = 8};
    spoke.header.scenario_time = ScenarioTime(kSpokeTime * static_cast<std::int64_t>(sequence));
    spoke.header.utc = begin_utc + spoke.header.scenario_time.time_since_epoch();
    spoke.cells.resize(kCells);
    std::uint64_t state = sequence * 2 + radar + 1;
    for (auto& cell : spoke.cells) {
      state = state * 6364136223846793005u + 1442695040888963407u;
      cell = static_cast<std::uint8_t>(state >> 56);
    }
    return spoke;
  }

  double reach_of(std::uint32_t radar, std::uint32_t view) const {
    const std::lock_guard lock(mutex_);
    const auto found = radars_[radar]->reaches.find(view);
    return found == radars_[radar]->reaches.end() ? 0.0 : found->second;
  }

  // The next sector of the radar, the same in all its views but for their number.
  void publish(std::uint32_t radar = 0) { publish_at_once(1, radar); }
  // So many of them, made before the first is published: as fast as a ring takes them.
  void publish_at_once(std::size_t sectors, std::uint32_t radar = 0) {
    std::map<std::uint32_t, VideoChannelPtr> channels;
    {
      const std::lock_guard lock(mutex_);
      channels = radars_[radar]->channels;
    }
    for (const auto& [view, channel] : channels) {
      std::vector<Sector> made(sectors);
      std::uint64_t sequence = radars_[radar]->published;
      for (Sector& sector : made) {
        for (std::uint32_t i = 0; i < kSectorSpokes; ++i) {
          Spoke next = spoke(radar, sequence++);
          next.header.view = view;
          next.header.instrumented_range = metres(reach_of(radar, view));
          sector.spokes.push_back(std::make_shared<const Spoke>(std::move(next)));
        }
      }
      for (const Sector& sector : made) channel->publish(sector);
    }
    radars_[radar]->published += sectors * kSectorSpokes;
  }
  // Spokes.  Thread: the publishing one.
  std::uint64_t published(std::uint32_t radar = 0) const { return radars_[radar]->published; }
  std::uint64_t encoded(const std::string& format, std::uint32_t radar = 0) const {
    return radars_[radar]->channels.at(0)->spokes_encoded().at(format);
  }

 private:
  struct Radar {
    explicit Radar(std::size_t ring_sectors) {
      channels.emplace(0, std::make_shared<VideoChannel>(ring_sectors));
    }
    std::map<std::uint32_t, VideoChannelPtr> channels;
    std::uint32_t last_view = 0;
    wire::Settings settings;
    std::map<std::uint32_t, double> reaches;  // instrumented ranges of views
    std::uint64_t published = 0;
  };
  std::vector<std::unique_ptr<Radar>> radars_;
  mutable std::mutex mutex_;  // of all but what is published
  wire::Set last_set_;
  std::string last_origin_;
  std::vector<std::string> origins_;
  wire::World world_;
  std::uint64_t settings_version_ = 1, world_version_ = 1, views_version_ = 1;
};

}  // namespace skerry::server

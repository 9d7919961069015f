#include "server/net/common/net_context.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <set>
#include <utility>

#include "protocol/thin/thin_shape.hpp"
#include "protocol/wire/frame.hpp"
#include "server/core/process_memory.hpp"
#include "server/net/common/encoders.hpp"
#include "server/net/common/for_strangers.hpp"
#include "server/net/common/net_clock.hpp"

namespace skerry::server {
namespace {

constexpr std::size_t kMinSendBuffer = 32 * 1024;
constexpr std::size_t kThinSendBuffer = 8 * 1024;        // a quarter of a second of level 3
constexpr std::size_t kMaxSendBuffer = 4 * 1024 * 1024;  // Debian's tcp_wmem maximum
constexpr std::size_t kUnknownSendBuffer = 1024 * 1024;  // of a board that has yet to send
constexpr double kSpokeOverhead = 100;                   // bytes besides the cells
constexpr double kSendBufferSeconds = 0.1;

}  // namespace

void OutputCounters::set_last_display(const std::string& address) {
  const std::lock_guard lock(mutex_);
  last_display_ = address;
}

std::string OutputCounters::last_display() const {
  const std::lock_guard lock(mutex_);
  return last_display_;
}

OutputPtr OutputRegistry::add(wire::OutputStatus what) {
  auto output = std::make_shared<OutputCounters>(std::move(what));
  const std::lock_guard lock(mutex_);
  std::erase_if(outputs_, [](const auto& known) { return known.expired(); });
  outputs_.push_back(output);
  return output;
}

void OutputRegistry::append_to(wire::Status& status) const {
  const std::lock_guard lock(mutex_);
  for (const auto& known : outputs_) {
    const OutputPtr output = known.lock();
    if (output == nullptr) continue;
    const auto read = [](const std::atomic<std::uint64_t>& counter) {
      return counter.load(std::memory_order_relaxed);
    };
    wire::OutputStatus& entry = *status.add_outputs();
    entry = output->fixed;
    entry.set_datagrams(read(output->datagrams));
    entry.set_reports(read(output->reports));
    entry.set_bytes(read(output->bytes));
    entry.set_spokes_lost(read(output->spokes_lost));
    entry.set_datagrams_unsent(read(output->datagrams_unsent));
    entry.set_commands(read(output->commands));
    entry.set_commands_refused(read(output->commands_refused));
    entry.set_commands_dropped(read(output->commands_dropped));
    entry.set_last_display(output->last_display());
  }
}

SharedBytes make_frame(const wire::ServerMessage& message) {
  auto bytes = std::make_shared<Bytes>();
  append_frame(*bytes, message);
  return bytes;
}

NetContext::NetContext(RadarHost& radar_host, NetConfig net_config)
    : host(radar_host),
      config(std::move(net_config)),
      connections(config.max_connections, config.limits),
      gate({config.control_token, config.tokens, config.users}),
      changes(PeerBudgets::of_changes(config.limits)),
      sign_ins(PeerBudgets::of_sign_ins(config.limits)),
      handshakes(PeerBudgets::of_handshakes(config.limits)),
      log_pace_(config.limits.log_period),
      settings_version_(host.settings_version()),
      world_version_(host.world_version()) {
  if (!config.tls.empty()) tls.emplace(config.tls);
  if (!config.setups.empty()) {
    setups.emplace(SetupShelf::Config{
        config.setups, [this](SetupShelf::Task task) { asio::post(io, std::move(task)); }});
  }
  if (gate.has_users()) {
    passwords.emplace([this](PasswordDesk::Task task) { asio::post(io, std::move(task)); });
  }
  const wire::Hello told = host.hello();
  for (const wire::RadarInfo& info : told.radars()) {
    ships_.resize(std::max<std::size_t>(ships_.size(), info.radar() + 1));
    ships_[info.radar()] = info.own_ship();
  }
}

SpokeFeed* NetContext::find_feed(std::uint32_t radar, std::uint32_t view,
                                 const std::string& format) {
  const FeedKey key(radar, view, format);
  if (const auto known = feeds_.find(key); known != feeds_.end()) return known->second.get();
  VideoChannelPtr channel = host.find_channel(radar, view);
  if (channel == nullptr) return nullptr;
  FormatRing* const ring = channel->find_format(format);
  if (ring == nullptr) return nullptr;
  auto& feed = feeds_[key];
  feed = std::make_unique<SpokeFeed>(io, FormatRingPtr(std::move(channel), ring));
  return feed.get();
}

SpokeFeed* NetContext::find_board_feed(std::uint32_t radar, const std::string& format) {
  BoardPortPtr board = host.find_board(radar);
  if (board == nullptr) return nullptr;
  FormatRing& ring = board->ring(format);
  auto& feed = board_feeds_[{radar, format}];
  if (feed == nullptr) {
    feed = std::make_unique<SpokeFeed>(io, FormatRingPtr(std::move(board), &ring));
  }
  return feed.get();
}

std::optional<RadarHost::OpenedView> NetContext::open_view(std::uint32_t radar, std::uint32_t like,
                                                           const TcpPeer& peer,
                                                           const RadarHost::ViewOpened& later) {
  if (!peer.on_own_host) {
    std::size_t of_peer = 0, of_others = 0;
    const auto count = [&](std::uint32_t of_radar, const PeerNet& by) {
      if (of_radar != radar || by == PeerNet::own_host()) return;
      ++of_others;
      if (by == peer.net) ++of_peer;
    };
    for (const auto& [key, opened] : opened_) count(key.first, opened.by);
    for (const auto& [of_radar, by] : opening_) count(of_radar, by);
    if (of_peer >= config.limits.views_of_peer) {
      return Failure{fmt::format(
          "{} has opened {} views of radar {}, as many as one address may; close another console "
          "there or share a view",
          peer.net.text(), of_peer, radar)};
    }
    if (of_others >= config.limits.views_of_token) {
      return Failure{fmt::format(
          "other hosts have opened {} views of radar {}, as many as they may; close another "
          "console or share a view",
          of_others, radar)};
    }
  }
  const auto keep = [this, radar, net = peer.net](const RadarHost::OpenedView& view) {
    if (view) opened_[{radar, *view}] = {std::chrono::steady_clock::now(), net};
  };
  const auto opening = opening_.emplace(radar, peer.net);
  auto view = host.open_view_or_ask(
      radar, like, [](VideoChannel& channel) { add_native_formats(channel); },
      [this, opening, keep, later](RadarHost::OpenedView opened) {
        asio::post(io, [this, opening, keep, later, opened = std::move(opened)] {
          opening_.erase(opening);
          keep(opened);
          later(opened);
        });
      });
  if (view) {
    opening_.erase(opening);
    keep(*view);
  }
  return view;
}

wire::Reply NetContext::apply(wire::Set set, const std::string& origin) {
  set.clear_token();
  wire::Reply reply = host.apply(set, origin);
  tell_refused(origin, reply);
  return reply;
}

void NetContext::tell_refused(const std::string& origin, const wire::Reply& reply) const {
  if (reply.code() == wire::Reply::OK) return;
  audit({.kind = AuditEntry::Kind::refusal, .from = origin, .what = reply.text()});
}

std::optional<wire::Reply> NetContext::apply_or_ask(wire::Set set, const std::string& origin,
                                                    const Answered& later) {
  set.clear_token();
  auto reply = host.apply_or_ask(set, origin, [this, origin, later](wire::Reply answer) {
    asio::post(io, [this, origin, later, answer = std::move(answer)] {
      tell_refused(origin, answer);
      later(answer);
    });
  });
  if (reply) tell_refused(origin, *reply);
  return reply;
}

wire::Reply NetContext::order(wire::TargetOrder order, const std::string& origin) {
  order.clear_token();
  wire::Reply reply;
  if (TargetPort* port = host.targets()) {
    reply = port->order(order, origin);
  } else {
    reply.set_code(wire::Reply::REFUSED);
    reply.set_text("this server has no plotter");
  }
  audit({.kind = AuditEntry::Kind::request,
         .from = origin,
         .what = "target_order { " + order.ShortDebugString() + " }",
         .result = reply.code() == wire::Reply::OK ? "ok" : reply.text()});
  return reply;
}

bool NetContext::has_readers(const ViewKey& view) const {
  for (std::uint32_t thin = 0; thin <= kThinLevels; ++thin) {
    const auto feed = feeds_.find(FeedKey(view.first, view.second, native_format(thin)));
    if (feed != feeds_.end() && !feed->second->readers().empty()) return true;
  }
  return false;
}

void NetContext::end_views(std::chrono::steady_clock::time_point now) {
  for (auto view = opened_.begin(); view != opened_.end();) {
    auto& [key, opened] = *view;
    if (has_readers(key)) opened.last_read = now;
    if (now - opened.last_read < kViewGrace) {
      ++view;
      continue;
    }
    host.close_view(key.first, key.second);
    for (std::uint32_t thin = 0; thin <= kThinLevels; ++thin) {
      const auto feed = feeds_.find(FeedKey(key.first, key.second, native_format(thin)));
      if (feed == feeds_.end()) continue;
      SpokeFeed::retire(std::move(feed->second));
      feeds_.erase(feed);
    }
    view = opened_.erase(view);
  }
}

std::size_t NetContext::send_buffer_for(std::uint32_t radar, std::uint32_t thin) const {
  const wire::Hello hello = host.hello();
  for (const wire::RadarInfo& info : hello.radars()) {
    if (info.radar() != radar) continue;
    const double spokes_per_second = info.spokes_per_turn() * info.rpm() / 60.0;
    const double bytes_per_spoke = info.cells() * info.bits() / 8.0 + kSpokeOverhead;
    const double bytes = spokes_per_second * bytes_per_spoke * kSendBufferSeconds;
    // Of a link that is slow a smaller one waits as long.
    if (thin > 0) return kThinSendBuffer;
    return static_cast<std::size_t>(
        std::clamp(bytes, double{kMinSendBuffer}, double{kMaxSendBuffer}));
  }
  return kMinSendBuffer;
}

std::size_t NetContext::board_send_buffer_for(std::uint32_t radar) const {
  const BoardPortPtr board = host.find_board(radar);
  const double rate = board->bytes_per_second();
  if (rate <= 0.0) return kUnknownSendBuffer;
  return static_cast<std::size_t>(
      std::clamp(rate * kSendBufferSeconds, double{kMinSendBuffer}, double{kMaxSendBuffer}));
}

void NetContext::tell_send_buffers() {
  for (const auto& [key, feed] : board_feeds_) {
    if (feed->readers().empty()) continue;
    const std::size_t bytes = board_send_buffer_for(key.first);
    for (FeedReader* reader : feed->readers()) reader->on_send_buffer(bytes);
  }
}

void NetContext::tell_settings() {
  const std::uint64_t settings = host.settings_version(), world = host.world_version();
  const bool settings_changed = std::exchange(settings_version_, settings) != settings;
  const bool world_changed = std::exchange(world_version_, world) != world;
  const std::uint64_t fleet = host.fleet_version();
  const bool fleet_changed = std::exchange(fleet_version_, fleet) != fleet;
  if (!settings_changed && !world_changed && !fleet_changed) return;
  const SharedBytes of_world = world_changed ? world_frame() : nullptr;
  const SharedBytes of_fleet = fleet_changed ? fleet_frame() : nullptr;
  for (const auto& [key, feed] : feeds_) {
    if (feed->readers().empty()) continue;
    const SharedBytes frame =
        settings_changed ? settings_frame(std::get<0>(key), std::get<1>(key)) : nullptr;
    for (FeedReader* reader : feed->readers()) {
      if (frame) reader->on_settings(frame);
      if (of_world) reader->on_world(of_world);
      if (of_fleet) reader->on_fleet(of_fleet);
    }
  }
}

void NetContext::tell_own_ships() {
  const std::uint64_t before = own_ship_calls_++, now = own_ship_calls_;
  const auto is_due = [&](std::uint32_t hz) {  // of every kOwnShipMostHz calls
    return now * hz / kOwnShipMostHz != before * hz / kOwnShipMostHz;
  };
  SharedBytes exercise;
  for (const auto& [key, feed] : feeds_) {
    SharedBytes frame, targets;
    for (FeedReader* reader : feed->readers()) {
      if (is_due(reader->targets_hz())) {
        if (targets == nullptr) targets = targets_frame(std::get<0>(key), std::get<1>(key));
        if (targets != nullptr) reader->on_targets(targets);
      }
      if (is_due(reader->exercise_hz())) {
        if (exercise == nullptr) exercise = exercise_frame();
        if (exercise != nullptr) reader->on_exercise(exercise);
      }
      if (!is_due(reader->own_ship_hz())) continue;
      if (frame == nullptr) frame = own_ship_frame(std::get<0>(key));
      reader->on_own_ship(frame);
    }
  }
}

void NetContext::tell_recordings(std::chrono::steady_clock::time_point now) {
  const RecordingNews::Frames due = recording_news_.due(now);
  if (!due.whole.recorder && !due.whole.playback) return;
  for (const auto& [key, feed] : feeds_) {
    for (FeedReader* reader : feed->readers()) {
      const auto& [recorder, playback] = reader->is_trusted() ? due.whole : due.for_strangers;
      if (recorder) reader->on_recorder(recorder);
      if (playback) reader->on_playback(playback);
    }
  }
}

wire::OwnShip NetContext::sensed_own_ship(std::uint32_t radar) const {
  const wire::OwnShip ship = host.own_ship(radar);
  return host.playback() == nullptr ? sensed(ship, config.sensors) : ship;
}

wire::Hello NetContext::hello() const {
  wire::Hello hello = host.hello();
  hello.set_can_record(host.recording() != nullptr);
  hello.set_playback(host.playback() != nullptr);
  hello.set_has_chart(host.has_chart());
  hello.set_warning(config.exposure);
  hello.set_has_classes(true);
  hello.set_identity(config.identity);
  if (auto fleet = host.fleet()) *hello.mutable_fleet() = *std::move(fleet);
  return hello;
}

SharedBytes NetContext::settings_frame(std::uint32_t radar, std::uint32_t view) const {
  wire::ServerMessage message;
  *message.mutable_settings() = host.settings(radar, view);
  return make_frame(message);
}

SharedBytes NetContext::own_ship_frame(std::uint32_t radar) const {
  wire::ServerMessage message;
  *message.mutable_own_ship() = host.own_ship(radar);
  return make_frame(message);
}

SharedBytes NetContext::exercise_frame() const {
  auto state = host.exercise_state();
  if (!state) return nullptr;
  wire::ServerMessage message;
  *message.mutable_exercise() = *std::move(state);
  return make_frame(message);
}

SharedBytes NetContext::targets_frame(std::uint32_t radar, std::uint32_t view) const {
  const TargetPort* port = host.targets();
  const TargetListPtr list = port == nullptr ? nullptr : port->targets(radar, view);
  if (list == nullptr) return nullptr;
  wire::ServerMessage message;
  *message.mutable_targets() = *list;
  return make_frame(message);
}

SharedBytes NetContext::world_frame() const {
  wire::ServerMessage message;
  *message.mutable_world() = host.world();
  return make_frame(message);
}

wire::Status NetContext::status() const {
  wire::Status status = host.status();
  clients.append_to(status);
  outputs.append_to(status);
  for (const auto& [kind, times] : errors.counts()) (*status.mutable_errors())[kind] += times;
  if (const RecordingPort* port = host.recording()) *status.mutable_recorder() = port->state();
  if (const PlaybackPort* port = host.playback()) *status.mutable_playback() = port->state();
  for (wire::HopStatus& hop : host.hops()) *status.add_hops() = std::move(hop);
  if (auto fleet = host.fleet()) *status.mutable_fleet() = *std::move(fleet);
  status.set_resident_mib(resident_mib());
  status.set_warning(config.exposure);
  return status;
}

wire::Status NetContext::status_for_strangers() const {
  wire::Status all = status();
  leave_out_for_strangers(all);
  return all;
}

}  // namespace skerry::server

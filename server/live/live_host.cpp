#include "server/live/live_host.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <utility>

#include "protocol/quantity/speed.hpp"
#include "protocol/recording/topics.hpp"
#include "server/live/live_commands.hpp"

namespace skerry::server {
namespace {

constexpr std::size_t kRingSectors = 4096;
constexpr std::size_t kHeldBytes = 8u << 20;  // of a format, for slow readers
constexpr std::chrono::seconds kTellEvery{1};
constexpr Duration kOwnShipEvery = std::chrono::seconds(1);
// Until the radar has been heard.
// On every picture, by the radar's name.
constexpr char kSimulatedSuffix[] = " + simulated";
constexpr std::uint32_t kUsualSpokes = 2048, kUsualCells = 1024, kUsualBits = 4;
constexpr double kUsualRpm = 24.0;

RelayedHost::RadarViews views_of(const std::vector<LiveSource>& sources) {
  RelayedHost::RadarViews views;
  for (const LiveSource& source : sources) {
    if (views.size() <= source.radar) views.resize(source.radar + 1);
    if (views[source.radar]) throw std::logic_error("two sources of one radar");
    views[source.radar] =
        std::make_unique<RelayedViewList>(std::vector<std::uint32_t>{0}, 0, kRingSectors);
    views[source.radar]->hold(kHeldBytes);
  }
  return views;
}

std::string text_of_address(std::uint32_t address) {
  return fmt::format("{}.{}.{}.{}", address >> 24, address >> 16 & 255, address >> 8 & 255,
                     address & 255);
}

std::vector<std::uint8_t> octets_of(const google::protobuf::MessageLite& message) {
  std::vector<std::uint8_t> octets(message.ByteSizeLong());
  message.SerializeToArray(octets.data(), static_cast<int>(octets.size()));
  return octets;
}

}  // namespace

LiveHost::LiveHost(const std::vector<LiveSource>& sources, std::string server)
    : RelayedHost(views_of(sources)), server_(std::move(server)) {
  for (const LiveSource& source : sources) {
    inputs_.push_back(std::make_unique<Input>(source));
    inputs_.back()->model = source.kind->model;
    wire::RadarInfo& info = inputs_.back()->info;
    info.set_radar(source.radar);
    info.set_name(std::string(source.kind->name));
    info.set_own_ship("own ship");
    info.set_spokes_per_turn(kUsualSpokes);
    info.set_cells(kUsualCells);
    info.set_bits(kUsualBits);
    info.set_rpm(kUsualRpm);
    info.set_set(fmt::format("{}, live", captures::name_of(source.kind->family)));
    info.set_band("X");
    wire::Settings silent;
    silent.set_standby(true);
    state_.take({recording::Kind::settings, source.radar, 0}, {}, octets_of(silent), {});
  }
}

LiveHost::Input& LiveHost::of(std::uint32_t radar) const {
  const auto found = std::find_if(inputs_.begin(), inputs_.end(),
                                  [&](const auto& each) { return each->source.radar == radar; });
  if (found == inputs_.end()) throw std::out_of_range("no such live radar");
  return **found;
}

UtcTime LiveHost::place() const {
  return std::chrono::time_point_cast<Duration>(std::chrono::system_clock::now());
}

// --- the receiving thread

bool LiveHost::take(std::size_t source, const pcap::Datagram& datagram) {
  Input& input = *inputs_[source];
  input.datagrams.fetch_add(1, std::memory_order_relaxed);
  LiveRadar::News news;
  input.radar.take(datagram, news);
  give(input, news, datagram.time);
  return news.groups;
}

bool LiveHost::look(std::size_t source, UtcTime now) {
  Input& input = *inputs_[source];
  std::optional<OwnShipFix> fix;
  {
    const std::lock_guard lock(input.mutex);
    fix = std::exchange(input.fix, std::nullopt);
  }
  if (fix) {
    captures::ShipFix put{fix->position,
                          fix->heading_deg,
                          fix->course_over_ground_deg,
                          {},
                          fix->rate_of_turn_deg_min};
    if (fix->speed_mps) put.speed_kn = *fix->speed_mps / kKnot;
    input.radar.put_own_ship(put);
  }
  LiveRadar::News news;
  input.radar.look(now, news);
  give(input, news, now);
  return news.groups;
}

void LiveHost::give(Input& input, LiveRadar::News& news, UtcTime now) {
  input.has_commands.store(input.radar.groups().commands().has_value(), std::memory_order_relaxed);
  input.others.store(input.radar.others(), std::memory_order_relaxed);
  if (!news.refusal.empty()) {
    input.refused.fetch_add(1, std::memory_order_relaxed);
    spdlog::debug("radar {}: {}", input.source.radar, news.refusal);
  }
  if (news.anew) tell_found(input);
  if (news.settings) {
    state_.take({recording::Kind::settings, input.source.radar, 0}, now,
                octets_of(input.radar.settings()), {});
  }
  if (now - input.ship_told >= kOwnShipEvery || now < input.ship_told) tell_ship(input, now);
  if (!news.spokes.empty()) publish(input, news.spokes);
  if (news.lost) {
    input.from.store(0, std::memory_order_relaxed);
    spdlog::warn("radar {}: {} is silent for {:.0f} s; listening for it again", input.source.radar,
                 info(input.source.radar).name(), in_seconds(LiveRadar::kSilence));
  }
}

void LiveHost::tell_found(Input& input) {
  const captures::SurveyedPicture& picture = *input.radar.picture();
  input.from.store(picture.traits.key.from, std::memory_order_relaxed);
  wire::RadarInfo info;
  {
    const std::lock_guard lock(input.mutex);
    input.info.set_name(picture.name);
    input.model = picture.traits.model;
    input.info.set_spokes_per_turn(picture.traits.spokes_per_turn);
    input.info.set_cells(
        std::clamp(picture.cells, ScanGeometry::kMinCells, ScanGeometry::kMaxCells));
    input.info.set_bits(picture.bits);
    if (picture.rpm > 0.0) input.info.set_rpm(picture.rpm);
    info = input.info;
  }
  spdlog::info("radar {}: found {} at {}, {} spokes a turn, {:.0f} turns a minute",
               input.source.radar, info.name(), text_of_address(picture.traits.key.from),
               info.spokes_per_turn(), info.rpm());
  const auto views = views_[input.source.radar]->get();
  for (const RelayedViewPtr& view : *views) view->begin_anew();
}

void LiveHost::tell_ship(Input& input, UtcTime now) {
  input.ship_told = now;
  state_.take({recording::Kind::own_ship, input.source.radar, 0}, now,
              octets_of(input.radar.own_ship(now)), {});
}

void LiveHost::publish(Input& input, std::vector<Spoke>& spokes) {
  if (input.add) input.add(spokes, input.radar.knows_heading());
  state_.take(spokes.back().header);
  const auto views = views_[input.source.radar]->get();
  for (std::size_t begin = 0; begin < spokes.size(); begin += kMostSpokes) {
    const std::size_t end = std::min(begin + kMostSpokes, spokes.size());
    for (const RelayedViewPtr& view : *views) {
      std::vector<std::shared_ptr<Spoke>> own;
      own.reserve(end - begin);
      for (std::size_t i = begin; i < end; ++i) own.push_back(std::make_shared<Spoke>(spokes[i]));
      view->publish(std::move(own));
    }
  }
}

// --- any thread

void LiveHost::count_dropped(std::size_t source, std::uint64_t datagrams) {
  inputs_[source]->dropped.fetch_add(datagrams, std::memory_order_relaxed);
}

wire::RadarInfo LiveHost::info(std::uint32_t radar) const {
  const Input& input = of(radar);
  const std::lock_guard lock(input.mutex);
  wire::RadarInfo info = input.info;
  if (input.source.simulated) info.set_name(info.name() + kSimulatedSuffix);
  return info;
}

wire::Hello LiveHost::hello() const {
  wire::Hello hello;
  hello.set_protocol_version(1);
  hello.set_server(server_);
  for (std::uint32_t radar = 0; radar < views_.size(); ++radar) {
    if (has(radar)) *hello.add_radars() = info(radar);
  }
  for (const double nm : RangeScale::kNauticalMiles) hello.add_range_scales_nm(nm);
  return hello;
}

wire::Reply LiveHost::change(const wire::Set& set, const std::string& origin) {
  Input& input = of(set.radar());
  if (!input.source.commands) {
    spdlog::debug("{}: a change of the live radar {} was refused", origin, set.radar());
    return reply_of(wire::Reply::REFUSED,
                    fmt::format("radar {} is a real one that this server only listens to; set its "
                                "controls at its own display, or give the input commands=true",
                                set.radar()));
  }
  if (!input.has_commands.load(std::memory_order_relaxed)) {
    return reply_of(wire::Reply::REFUSED,
                    fmt::format("radar {} has not been heard yet: it is not known where it takes "
                                "commands; skerry status shows what comes in",
                                set.radar()));
  }
  const wire::Settings now = settings(set.radar(), set.view());
  {
    const std::lock_guard lock(input.mutex);
    auto commands = live_commands(*input.source.kind, input.model, set, now);
    if (!commands) return reply_of(wire::Reply::REFUSED, commands.error());
    if (input.orders.size() + commands->size() > kMostOrders) {
      return reply_of(wire::Reply::REFUSED, "too many changes at once; try again");
    }
    for (Bytes& command : *commands) input.orders.push_back(std::move(command));
    // A knob that is turned is one line a second.
    const auto moment = std::chrono::steady_clock::now();
    if (moment - input.told < kTellEvery) {
      ++input.untold;
    } else {
      input.told = moment;
      wire::Set told = set;
      told.clear_token();
      spdlog::info("radar {}: {} asks it for {}{}", set.radar(), origin, told.ShortDebugString(),
                   input.untold == 0 ? "" : fmt::format(" ({} changes before)", input.untold));
      if (audit_ != nullptr) {
        audit_->add({.kind = AuditEntry::Kind::request,
                     .from = origin,
                     .what = fmt::format("radar {}: {}", set.radar(), told.ShortDebugString()),
                     .times = 1 + static_cast<std::uint32_t>(input.untold),
                     .result = "asked for"});
      }
      input.untold = 0;
    }
  }
  if (wake_) wake_();
  return reply_of(wire::Reply::OK);
}

LiveHost::Orders LiveHost::take_orders(std::size_t source, UtcTime now) {
  Input& input = *inputs_[source];
  Orders orders;
  if (!input.source.commands || !input.radar.groups().commands()) return orders;
  orders.to = *input.radar.groups().commands();
  {
    const std::lock_guard lock(input.mutex);
    orders.commands = std::exchange(input.orders, {});
  }
  StayAlive alive = stay_alive_of(*input.source.kind);
  if (now - input.kept_alive >= alive.every || now < input.kept_alive) {
    input.kept_alive = now;
    for (Bytes& each : alive.packets) orders.commands.push_back(std::move(each));
  }
  return orders;
}

std::optional<std::string> LiveHost::drive(std::uint32_t radar, const OwnShipFix& fix) {
  if (!has(radar)) return fmt::format("no live radar {}", radar);
  Input& input = of(radar);
  const std::lock_guard lock(input.mutex);
  // Each sentence tells a part.
  if (!input.fix) input.fix.emplace();
  OwnShipFix& known = *input.fix;
  const auto keep = [](auto& kept, const auto& said) {
    if (said) kept = said;
  };
  keep(known.position, fix.position);
  keep(known.heading_deg, fix.heading_deg);
  keep(known.course_over_ground_deg, fix.course_over_ground_deg);
  keep(known.speed_mps, fix.speed_mps);
  keep(known.rate_of_turn_deg_min, fix.rate_of_turn_deg_min);
  return std::nullopt;
}

wire::Status LiveHost::status() const {
  wire::Status status;
  status.set_server(server_);
  tell_status(status);
  for (const auto& input : inputs_) {
    wire::OutputStatus& about = *status.add_outputs();
    about.set_name(fmt::format("{}_input", input->source.kind->name));
    about.set_radar(input->source.radar);
    about.set_interface_address(input->source.interface_address);
    about.set_commands(input->datagrams.load(std::memory_order_relaxed));
    about.set_commands_refused(input->refused.load(std::memory_order_relaxed));
    about.set_commands_dropped(input->dropped.load(std::memory_order_relaxed) +
                               input->others.load(std::memory_order_relaxed));
    const std::uint32_t from = input->from.load(std::memory_order_relaxed);
    about.set_last_display(from == 0 ? "no radar found" : text_of_address(from));
  }
  return status;
}

}  // namespace skerry::server

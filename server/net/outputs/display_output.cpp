#include "server/net/outputs/display_output.hpp"

#include <fmt/format.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "server/net/common/encoders.hpp"
#include "server/net/common/output_socket.hpp"

namespace skerry::server {
namespace {

constexpr int kMostUnfitSectors = 64;
constexpr double kSameReach = 5e-3;
// Datagrams that are due so soon leave now: a timer is not finer.
constexpr Duration kSoon = std::chrono::microseconds(200);

std::string_view letter(RangeChannel channel) { return channel == RangeChannel::a ? "A" : "B"; }

}  // namespace

DisplayOutput::DisplayOutput(NetContext& context, const DisplayOutputConfig& config,
                             std::size_t number)
    : context_(context),
      config_(config),
      name_(fmt::format("output {} ({})", number + 1, config.name)),
      socket_(context.io),
      timer_(context.io) {
  error_code error;
  interface_ = asio::ip::make_address_v4(config.interface_address, error);
  if (error || interface_.is_unspecified() || interface_.is_multicast()) {
    fail(fmt::format("interface address '{}' is not an IPv4 address of this host",
                     config.interface_address));
  }
  if (config.ttl < 0 || config.ttl > 255) fail(fmt::format("TTL {} is not 0 to 255", config.ttl));
  if (config.sources.empty()) fail("no radar is named");
  try {
    emulation_ = config.make();
  } catch (const std::exception& why) {
    fail(why.what());
  }
  wanted_ = emulation_->listens();
}

void DisplayOutput::open() {
  try {
    socket_ = open_sending(context_.io, interface_, config_.ttl);
    own_ = socket_.local_endpoint();
    for (const EmulationListen& listen : wanted_) {
      ears_.push_back(
          {open_listening(context_.io, listen, interface_), listen.at.is_multicast(), false});
    }
  } catch (const std::exception& why) {
    fail(why.what());
  }
  const std::vector<RangeChannel> channels = emulation_->channels();
  for (std::size_t i = 0; i < channels.size(); ++i) {
    open_range(channels[i], config_.sources[std::min(i, config_.sources.size() - 1)]);
  }
  wire::OutputStatus about;
  about.set_name(config_.name);
  about.set_radar(ranges_.front()->radar);
  about.set_view(ranges_.front()->controlled);
  about.set_address(text_of(ranges_.front()->to));
  about.set_interface_address(config_.interface_address);
  counters_ = context_.outputs.add(std::move(about));
}

DisplayOutput::~DisplayOutput() = default;

void DisplayOutput::fail(const std::string& reason) const {
  throw std::runtime_error(name_ + ": " + reason);
}

void DisplayOutput::open_range(RangeChannel channel, const OutputSource& source) {
  RadarHost& host = context_.host;
  if (host.find_channel(source.radar, 0) == nullptr) {
    fail(fmt::format("there is no radar {}; there are {}, counted from 0", source.radar,
                     host.radar_count()));
  }
  auto range = std::make_unique<Range>(*this, channel, config_.burst);
  range->radar = source.radar;
  range->format = fmt::format("{} {}", name_, letter(channel));
  range->to = emulation_->data_address(channel);
  const auto view = host.open_view(source.radar, 0, !source.own_view, [&](VideoChannel& video) {
    video.add_format(kNativeFormat, native_encoder());  // as it is looked at and recorded
    video.add_format(range->format, timed_encoder(emulation_->spoke_encoder(channel)));
  });
  if (!view) {
    fail(fmt::format("radar {} has as many views as it may; leave out an output", source.radar));
  }
  range->shown = *view;
  range->controlled = source.own_view ? *view : 0;
  ranges_.push_back(std::move(range));
  fit_range(*ranges_.back());
}

OutputClaim DisplayOutput::claim() const {
  OutputClaim claim{.name = name_,
                    .interface_address = config_.interface_address,
                    .interface = interface_of(interface_),
                    .identity = config_.identity,
                    .groups = {}};
  for (const EmulationListen& listen : wanted_) {
    if (listen.at.is_multicast()) claim.groups.push_back(listen.at);
  }
  return claim;
}

void DisplayOutput::start() {
  closed_ = false;
  std::vector<std::uint16_t> ports;
  for (const Ear& ear : ears_) ports.push_back(ear.socket.local_endpoint().port());
  settings_version_ = context_.host.settings_version();
  // The first report tells displays that the radar is there: by then its picture is, too.
  for (const auto& range : ranges_) {
    range->feed = context_.find_feed(range->radar, range->shown, range->format);
    if (range->feed != nullptr) range->cursor = range->feed->add(*range);
  }
  emulation_->begin(interface_.to_uint(), ports, now(), *this);
  for (std::size_t ear = 0; ear < ears_.size(); ++ear) listen(ear);
}

void DisplayOutput::close() {
  if (std::exchange(closed_, true)) return;
  for (const auto& range : ranges_) {
    if (range->feed != nullptr) range->feed->remove(*range);
    range->feed = nullptr;
    range->pending.clear();
  }
  error_code ignored;
  timer_.cancel();
  for (Ear& ear : ears_) ear.socket.close(ignored);
  socket_.close(ignored);
}

ScenarioTime DisplayOutput::now() const {
  return ScenarioTime(std::chrono::steady_clock::now() - made_);
}

void DisplayOutput::follow_settings() {
  const std::uint64_t version = context_.host.settings_version();
  if (std::exchange(settings_version_, version) == version) return;
  for (const auto& range : ranges_) emulation_->on_settings(range->channel, now(), *this);
  fit_ranges();
}

void DisplayOutput::tick() {
  if (closed_) return;
  follow_settings();
  emulation_->on_time(now(), *this);
  hush();
  for (std::size_t ear = 0; ear < ears_.size(); ++ear) {
    if (std::exchange(ears_[ear].resting, false)) listen(ear);
  }
}

// After whatever may have changed what a display has chosen: the emulation knows it by then.
void DisplayOutput::fit_ranges() {
  for (const auto& range : ranges_) fit_range(*range);
}

// A range that says it has no picture sends no spokes, not even those that wait.
void DisplayOutput::hush() {
  for (const auto& range : ranges_) {
    if (is_silent(*range)) range->pending.clear();
  }
}

bool DisplayOutput::is_silent(const Range& range) const {
  return !emulation_->has_picture(range.channel) || settings(range.channel).standby();
}

// The view's instrumented range is the output's own affair and no operator's: what is refused is a
// fault of the emulation.
void DisplayOutput::fit_range(Range& range) {
  RadarHost& host = context_.host;
  const wire::Settings now = settings(range.channel);
  double wanted = emulation_->instrumented_range_m(range.channel, now);
  // Rows that are as long as a spoke by themselves, but for the rounding of a recorded header, stay
  // as they are: a recording of such a radar leaves cell by cell as it came.  `wanted` is a whole
  // number of spokes.
  const double as_they_are = now.instrumented_range_m();
  if (as_they_are > 0.0) {
    const double spokes = std::round(wanted / as_they_are);
    if (std::abs(as_they_are * spokes - wanted) <= kSameReach * wanted) wanted = as_they_are;
  }
  if (range.reach_m != wanted) range.reach_before_m = std::exchange(range.reach_m, wanted);
  if (host.settings(range.radar, range.shown).instrumented_range_m() == wanted) return;
  wire::Set set;
  set.set_radar(range.radar);
  set.set_view(range.shown);
  set.set_instrumented_range_m(wanted);
  const wire::Reply reply = host.apply(set, name_);
  if (reply.code() != wire::Reply::OK)
    context_.errors.add("output range", name_ + ": " + reply.text());
}

// Between the change of a range scale and the fit to it rows have a reach that is nobody's range;
// they are left out.  A view that is not fitted within so many sectors never will be, and is sent
// as it is.
bool DisplayOutput::is_unfit(Range& range, const EncodedSector& sector) {
  const auto is = [&](double reach_m) {
    return std::abs(sector.reach_m - reach_m) <= 1e-6 * reach_m;
  };
  const bool fits = is(range.reach_m) || is(range.reach_before_m);
  range.unfit = fits ? 0 : std::min(range.unfit + 1, kMostUnfitSectors);
  return range.unfit > 0 && range.unfit < kMostUnfitSectors;
}

const DisplayOutput::Range& DisplayOutput::range_of(RangeChannel channel) const {
  const auto found = std::find_if(ranges_.begin(), ranges_.end(),
                                  [&](const auto& range) { return range->channel == channel; });
  return found == ranges_.end() ? *ranges_.front() : **found;
}

void DisplayOutput::send(const Ipv4Endpoint& to, std::span<const std::uint8_t> payload) {
  if (!send_to(to, payload)) return;
  counters_->reports.fetch_add(1, std::memory_order_relaxed);
}

wire::Reply DisplayOutput::change(RangeChannel channel, const wire::Set& set) {
  if (!config_.obeys && display_.port != 0) {
    wire::Reply reply;
    reply.set_code(wire::Reply::REFUSED);
    reply.set_text(name_ + " is configured not to obey displays");
    return reply;
  }
  const Range& range = range_of(channel);
  wire::Set mine = set;
  mine.set_radar(range.radar);
  mine.set_view(range.controlled);
  const std::string origin =
      display_.port == 0 ? name_
                         : fmt::format("{} display {}", config_.identity.family, text_of(display_));
  wire::Reply reply = context_.apply(mine, origin);
  return reply;
}

wire::Settings DisplayOutput::settings(RangeChannel channel) const {
  const Range& range = range_of(channel);
  wire::Settings settings = context_.host.settings(range.radar, range.controlled);
  // A view of the output's own has that of fit_range(), which says nothing new.
  if (range.controlled == range.shown) settings.clear_instrumented_range_m();
  return settings;
}

wire::OwnShip DisplayOutput::own_ship() const {
  return context_.host.own_ship(ranges_.front()->radar);
}

void DisplayOutput::count(std::string_view kind, std::string_view detail) {
  counters_->commands_refused.fetch_add(1, std::memory_order_relaxed);
  context_.errors.add(kind, fmt::format("{}{}{}: {}", name_, display_.port == 0 ? "" : " from ",
                                        display_.port == 0 ? "" : text_of(display_), detail));
}

void DisplayOutput::take_sectors(Range& range) {
  follow_settings();  // sectors are of what the settings are now, or were before
  const bool silent = is_silent(range);
  while (const EncodedSectorPtr sector = range.feed->ring().take(range.cursor)) {
    if (is_unfit(range, *sector) || silent) continue;
    range.pacer.on_sector(std::chrono::steady_clock::now(), sector->times.first,
                          sector->times.last);
    for (std::uint32_t i = 0; i < sector->spoke_count(); ++i) {
      range.pending.push_back({range.pacer.leaves(sector->times.completed[i]), sector, i});
    }
  }
  for (; range.pending.size() > kPending; range.pending.pop_front()) ++unsent_;
  std::uint64_t lost = 0;
  for (const auto& each : ranges_) lost += each->cursor.spokes_lost;
  counters_->spokes_lost.store(lost, std::memory_order_relaxed);
  send_due();
}

void DisplayOutput::send_due() {
  const auto until = std::chrono::steady_clock::now() + kSoon;
  auto next = DatagramPacer::SteadyTime::max();
  for (const auto& range : ranges_) {
    for (; !range->pending.empty() && range->pending.front().leaves <= until;
         range->pending.pop_front()) {
      const auto& [leaves, sector, index] = range->pending.front();
      const std::uint32_t begin = index == 0 ? sector->begin : sector->spoke_ends[index - 1];
      const bool sent = send_to(
          range->to, std::span(sector->bytes).subspan(begin, sector->spoke_ends[index] - begin));
      if (sent) counters_->datagrams.fetch_add(1, std::memory_order_relaxed);
      if (!sent) ++unsent_;
    }
    if (!range->pending.empty()) next = std::min(next, range->pending.front().leaves);
  }
  counters_->datagrams_unsent.store(unsent_, std::memory_order_relaxed);
  if (next == DatagramPacer::SteadyTime::max()) return;
  timer_.expires_at(next);
  timer_.async_wait([this](error_code error) {
    if (!error && !closed_) send_due();
  });
}

bool DisplayOutput::send_to(const Ipv4Endpoint& to, std::span<const std::uint8_t> payload) {
  const asio::ip::udp::endpoint there(asio::ip::address_v4(to.address), to.port);
  for (;;) {
    const auto sent = ::sendto(socket_.native_handle(), payload.data(), payload.size(),
                               MSG_DONTWAIT, there.data(), static_cast<socklen_t>(there.size()));
    if (sent >= 0) break;
    if (errno == EINTR) continue;
    context_.errors.add(config_.name + " send",
                        fmt::format("{} to {}: {}", name_, text_of(to), std::strerror(errno)));
    return false;
  }
  counters_->bytes.fetch_add(payload.size(), std::memory_order_relaxed);
  return true;
}

void DisplayOutput::listen(std::size_t ear) {
  ears_[ear].socket.async_wait(UdpSocket::wait_read, [this, ear](error_code error) {
    if (error || closed_) return;
    read(ear);
    if (!ears_[ear].resting) listen(ear);
  });
}

// On loopback every radar's groups are heard by all (see above).
bool DisplayOutput::is_for_us(const Ear& ear, const asio::ip::udp::endpoint& from) const {
  if (from == own_) return false;
  return !ear.group || !interface_.is_loopback() || from.address() == interface_;
}

void DisplayOutput::read(std::size_t which) {
  Ear& ear = ears_[which];
  for (int i = 0; i < kReads; ++i) {
    asio::ip::udp::endpoint from;
    error_code error;
    const std::size_t size = ear.socket.receive_from(asio::buffer(buffer_), from, 0, error);
    if (error == asio::error::would_block || error == asio::error::try_again) return;
    if (error || !is_for_us(ear, from)) continue;
    counters_->commands.fetch_add(1, std::memory_order_relaxed);
    if (!gate_.lets_pass(now())) {
      ear.resting = true;
      counters_->commands_dropped.fetch_add(1, std::memory_order_relaxed);
      context_.errors.add("commands dropped",
                          fmt::format("{}: more than {} a second, the last from {}", name_,
                                      CommandGate::kPerSecond, text_of(ipv4_endpoint_of(from))));
      continue;
    }
    display_ = ipv4_endpoint_of(from);
    if (display_ != last_display_) {
      last_display_ = display_;
      counters_->set_last_display(text_of(display_));
    }
    if (size == buffer_.size()) {
      count("display command too long", "no display sends so much");
    } else {
      emulation_->on_datagram(which, display_, std::span(buffer_).first(size), now(), *this);
      fit_ranges();
      hush();
    }
    display_ = {};
  }
  ear.resting = true;
}

}  // namespace skerry::server

// NetContext: what the connections of one server share.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "protocol/quantity/result.hpp"
#include "protocol/wire/radar.pb.h"
#include "server/access/gate.hpp"
#include "server/access/password_desk.hpp"
#include "server/core/error_counts.hpp"
#include "server/core/radar_host.hpp"
#include "server/net/common/asio.hpp"
#include "server/net/common/client_registry.hpp"
#include "server/net/common/connection_table.hpp"
#include "server/net/common/log_pace.hpp"
#include "server/net/common/net_config.hpp"
#include "server/net/common/peer_budgets.hpp"
#include "server/net/common/recording_news.hpp"
#include "server/net/common/spoke_feed.hpp"
#include "server/net/common/tls_keys.hpp"
#include "server/setups/setup_shelf.hpp"

namespace skerry::server {

// One emulated radar's counters.  Thread: written by net-0, read by any.
struct OutputCounters {
  explicit OutputCounters(wire::OutputStatus what) : fixed(std::move(what)) {}

  const wire::OutputStatus fixed;  // name, radar, views, addresses
  std::atomic<std::uint64_t> datagrams{0}, reports{0}, bytes{0};
  std::atomic<std::uint64_t> spokes_lost{0}, datagrams_unsent{0};
  std::atomic<std::uint64_t> commands{0}, commands_refused{0}, commands_dropped{0};

  void set_last_display(const std::string& address);
  std::string last_display() const;

 private:
  mutable std::mutex mutex_;
  std::string last_display_;
};
using OutputPtr = std::shared_ptr<OutputCounters>;

// What the emulated radars send and are told, for the status message.
// Knows each output for as long as somebody holds its counters.  Thread: any.
class OutputRegistry {
 public:
  OutputPtr add(wire::OutputStatus what);
  void append_to(wire::Status& status) const;

 private:
  mutable std::mutex mutex_;
  std::vector<std::weak_ptr<OutputCounters>> outputs_;
};

// A ServerMessage as a frame that any number of sessions can send.
SharedBytes make_frame(const wire::ServerMessage& message);

// Thread: net-0, except where stated.
class NetContext {
 public:
  NetContext(RadarHost& radar_host, NetConfig net_config);

  asio::io_context io{1};  // first: destroyed last
  RadarHost& host;
  const NetConfig config;
  ErrorCounts errors;      // any thread
  ClientRegistry clients;  // any thread
  OutputRegistry outputs;  // any thread
  ConnectionTable connections;
  Gate gate;  // who may do what; refreshed by look_at_tokens()

  // Who that is who has this token or, with none, came with this certificate.
  Who who(const TcpPeer& peer, std::string_view token) const;
  // Whether what she shows of these is good, wherever she comes from.
  bool knows(const TcpPeer& peer, std::string_view token = {}) const;
  // The own ship that carries a radar; empty if there is no such radar.
  const std::string& ship_of(std::uint32_t radar) const;
  // Whether it is one; and which there are, for a refusal.
  bool has_ship(std::string_view name) const;
  std::string ships_in_words() const;
  // Heeds changed files of tokens and users, and tokens that have ended.  Call it once a second.
  void look_at_tokens();
  // Heeds a changed certificate and key: what is wrong with them is told, and the old ones hold.
  // Call it once a second.
  void look_at_tls(TlsKeys::When when = TlsKeys::When::settled);
  // Ends the connections of clients whose certificate has ended, which is told.  Call it a few
  // times a second.
  void end_certificates();
  PeerBudgets changes, sign_ins, handshakes;
  std::optional<TlsKeys> tls;             // nothing: this server is plain
  std::optional<SetupShelf> setups;       // of consoles; nothing: this server keeps none
  std::optional<PasswordDesk> passwords;  // nothing: this server has no users

  // Counts a client's breach of a limit, and writes it to the log, but no more than one line of a
  // kind every PeerLimits::log_period.  `kind` is a short fixed name.
  void complain(std::string_view kind, std::string_view text);

  // Counts what somebody at `from` may not, and keeps it with the audit.
  void refuse(const std::string& from, const std::string& who, const std::string& text);
  // Keeps it with the audit, if there is one.
  void audit(AuditEntry entry) const {
    if (config.audit != nullptr) config.audit->add(std::move(entry));
  }
  // What the host does with a Set and the plotters with an order; the audit has what was refused,
  // and every order.  Tokens are taken out here.
  wire::Reply apply(wire::Set set, const std::string& origin);
  // As RadarHost::apply_or_ask(), with `later` called on net-0.
  std::optional<wire::Reply> apply_or_ask(wire::Set set, const std::string& origin,
                                          const Answered& later);
  wire::Reply order(wire::TargetOrder order, const std::string& origin);

  // nullptr if there is no such view.  Lives as long as it has a reader; of view 0, as long as the
  // context.
  SpokeFeed* find_feed(std::uint32_t radar, std::uint32_t view, const std::string& format);

  // The feed of a radar's interface board in kRecordsFormat or kSignalsFormat; nullptr if it has
  // none.  Lives as long as the context.
  SpokeFeed* find_board_feed(std::uint32_t radar, const std::string& format);

  // A further view with the settings of view `like`, for native clients.  It ends when it has had
  // no reader for kViewGrace.  Requires that find_feed() knows the radar and view.
  // Nothing is returned where another server is asked: then `later` is called on net-0.
  // Error: the radar, or this peer, has as many as it may, those that are being opened among them;
  // what to do.
  std::optional<RadarHost::OpenedView> open_view(std::uint32_t radar, std::uint32_t like,
                                                 const TcpPeer& peer,
                                                 const RadarHost::ViewOpened& later);
  static constexpr std::chrono::seconds kViewGrace{5};
  // Ends the views whose time has come.  Call it a few times a second.
  void end_views(std::chrono::steady_clock::time_point now);

  // About 100 ms of the radar's spokes, in bytes: what may wait in the kernel for a slow console,
  // which so sees a picture at most that old.  `thin`: as in Subscribe.
  std::size_t send_buffer_for(std::uint32_t radar, std::uint32_t thin = 0) const;
  // The same of a board's records, by what was sent lately.  Requires a radar with a board.
  std::size_t board_send_buffer_for(std::uint32_t radar) const;

  // Sends Settings and World to the readers of all views, if any changed since the last call.
  void tell_settings();
  // Sends RecorderState and PlaybackState to all readers when due.  Call it ten times a second.
  void tell_recordings(std::chrono::steady_clock::time_point now);
  // Tells the readers of boards what may now wait in the kernel.  Call it once a second.
  void tell_send_buffers();
  // Sends OwnShip, the exercise and targets to the readers whose turn it is.  Call it
  // kOwnShipMostHz times a second.
  void tell_own_ships();

  // Own ship as her sensors tell of her: in sentences and Signal K.
  wire::OwnShip sensed_own_ship(std::uint32_t radar) const;

  // The host's, with what the network does for it.
  // Origins of the pages of the other hosts of the fleet ("http://192.0.2.7:7480").
  std::vector<std::string> sisters() const;
  wire::Hello hello() const;
  RecordingNews::Frames recording_frames() const { return recording_news_.all(); }
  SharedBytes settings_frame(std::uint32_t radar, std::uint32_t view) const;
  SharedBytes own_ship_frame(std::uint32_t radar) const;
  SharedBytes world_frame() const;
  SharedBytes fleet_frame() const;  // null: there is no fleet
  // Of a server that has an exercise; else nullptr.
  SharedBytes exercise_frame() const;
  // Of a view whose targets somebody wants, once there is a list; else nullptr.
  SharedBytes targets_frame(std::uint32_t radar, std::uint32_t view) const;
  wire::Status status() const;  // any thread
  // The same for who is not trusted: without addresses of others, names of folders and texts that
  // may hold either.  Thread: any.
  wire::Status status_for_strangers() const;

 private:
  using FeedKey = std::tuple<std::uint32_t, std::uint32_t, std::string>;  // radar, view, format
  using BoardKey = std::pair<std::uint32_t, std::string>;                 // radar, format
  using ViewKey = std::pair<std::uint32_t, std::uint32_t>;                // radar, view
  bool has_readers(const ViewKey& view) const;
  void tell_refused(const std::string& origin, const wire::Reply& reply) const;

  std::map<FeedKey, std::unique_ptr<SpokeFeed>> feeds_;
  std::map<BoardKey, std::unique_ptr<SpokeFeed>> board_feeds_;
  struct Opened {
    std::chrono::steady_clock::time_point last_read;
    PeerNet by;
  };
  std::map<ViewKey, Opened> opened_;  // further views
  // Radar and peer of those that another server has been asked for and has not opened yet.
  std::multiset<std::pair<std::uint32_t, PeerNet>> opening_;
  LogPace log_pace_;
  std::uint64_t settings_version_ = 0, world_version_ = 0, fleet_version_ = 0;
  std::uint64_t own_ship_calls_ = 0;
  RecordingNews recording_news_{host};
  std::vector<std::string> ships_;  // of the radars
};

}  // namespace skerry::server

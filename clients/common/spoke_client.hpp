// SpokeClient: the native protocol over TCP, as a console or any other program uses it.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>

#include "clients/common/client_error.hpp"
#include "protocol/quantity/time.hpp"
#include "protocol/video/spoke.hpp"
#include "protocol/wire/radar.pb.h"
#include "protocol/wire/sequence_gap.hpp"

namespace skerry::client {

// Whatever a subscribed connection brings.
using ClientEvent =
    std::variant<Spoke, wire::Settings, wire::OwnShip, wire::Reply, wire::Status, wire::World,
                 wire::RecorderState, wire::PlaybackState, wire::ExerciseState, wire::TargetList>;

// One connection to a server.  Nothing that comes from the network throws or is believed unchecked.
// An error ends the connection: every later call answers with the same error, and whether to
// connect again is the caller's business.  Exception: a request that the server rejects or does not
// answer in time leaves the connection as it was. Memory: at most kMaxWaiting events, which wait
// while a request is under way; then the oldest give way, and spokes among them count as lost.
// Thread: one at a time.  No call waits longer than its timeout (but for the system's name lookup).
class SpokeClient {
 public:
  static constexpr std::size_t kMaxWaiting = 8192;

  // Connects and waits for the server's Hello.
  // Error: unreachable, refused, timed_out, closed, malformed (not a Skerry server, or a protocol
  // version this library does not know).
  static ClientResult<SpokeClient> connect(const std::string& host, std::uint16_t port,
                                           Duration timeout);
  SpokeClient(SpokeClient&&) noexcept;
  SpokeClient& operator=(SpokeClient&&) noexcept;
  ~SpokeClient();

  const wire::Hello& hello() const;  // its fleet is that which was told last
  const std::string& name() const;   // "host:port", for messages

  // Says who the client is: what it asks for from now on without a token of its own is asked with
  // this one.  Servers older than this request close the connection at it.
  // Error: rejected if the server does not know the token, and the errors of receive().
  ClientResult<wire::Reply> sign_in(const std::string& token, Duration timeout);

  // The same by a token, by name and password, or by a class code.  Only a server whose Hello says
  // has_classes knows more than a token; to another nothing is sent.
  // Error: also rejected if the server does not know who that is.
  ClientResult<wire::Reply> sign_in(const wire::SignIn& who, Duration timeout);

  // From now on receive() brings the spokes, settings and own ship of that radar and view; what was
  // waiting of an earlier subscription is dropped and the loss counter begins anew.
  // Error: rejected if there is no such radar or view, and the errors of receive().
  ClientResult<Done> subscribe(std::uint32_t radar, std::uint32_t view, Duration timeout);

  // Opens a further view with the settings of `like` and subscribes to it; gives its number.  It
  // ends some seconds after its last subscriber has left.
  // Error: also rejected where the radar has as many views as it may, or the token is not right
  // (needed from another host than the server's).
  ClientResult<std::uint32_t> subscribe_new_view(std::uint32_t radar, std::uint32_t like,
                                                 Duration timeout, const std::string& token = {});

  // From now on receive() brings the exercise as it really is (wire::ExerciseState), 1 to 4 times a
  // second, settings and own ship of radar 0, and no spokes.
  // Error: as subscribe_new_view().
  ClientResult<Done> watch_exercise(std::uint32_t times_a_second, Duration timeout,
                                    const std::string& token = {});

  // From now on receive() brings what the plotter of that view has (wire::TargetList), 1 or 2 times
  // a second, settings and own ship, and no spokes.  The plotter begins now, if nobody has wanted
  // it.  A server without plotters sends no list.
  // Error: as subscribe().
  ClientResult<Done> watch_targets(std::uint32_t radar, std::uint32_t view,
                                   std::uint32_t times_a_second, Duration timeout);

  // The next event; nothing if none came within `timeout` (zero: what is there already).
  // Error: closed (with the server's last complaint, if it had one), malformed.
  ClientResult<std::optional<ClientEvent>> receive(Duration timeout);

  // Changes the fields present in `request`; all or nothing.
  // Error: rejected with the server's text, timed_out, and the errors of receive().
  ClientResult<wire::Reply> set(const wire::Set& request, Duration timeout);
  ClientResult<wire::Status> get_status(Duration timeout);

  // Orders the plotter of a view; all or nothing.  Only once a TargetList has come: other servers
  // may not know the request.
  // Error: as set(); with Reply::UNKNOWN where no echo is to be acquired, or a target is not there.
  ClientResult<wire::Reply> order_targets(const wire::TargetOrder& order, Duration timeout);

  // Makes or ends a class code, or neither; gives what codes there are then.  Only for a server
  // whose Hello says has_classes; otherwise it is rejected here. Error: as set().
  ClientResult<wire::ClassList> order_class(const wire::ClassOrder& order, Duration timeout);

  // Only for a server whose Hello says can_record, or playback.  Otherwise it is rejected here and
  // nothing is sent, because such a server may not know the request.  All or nothing.
  // Error: as set().
  ClientResult<wire::Reply> record(const wire::Record& request, Duration timeout);
  ClientResult<wire::Reply> playback(const wire::Playback& request, Duration timeout);

  // Losses among the spokes since subscribe().
  const LossCounter& losses() const;

 private:
  class Connection;
  explicit SpokeClient(std::unique_ptr<Connection> connection);
  std::unique_ptr<Connection> connection_;
};

}  // namespace skerry::client

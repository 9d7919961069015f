// UpstreamLine: one connection to the server that is relayed: what is said on it.  No sockets.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>

#include "protocol/wire/frame.hpp"
#include "protocol/wire/radar.pb.h"
#include "protocol/wire/sequence_gap.hpp"
#include "server/relay/spoke_batch.hpp"

namespace skerry::server {

using SteadyTime = std::chrono::steady_clock::time_point;

// What a line subscribes to.
struct LineWish {
  std::uint32_t radar = 0, view = 0;
  bool new_view = false;  // one like `view`
  bool spokes = true;
  std::uint32_t own_ship_hz = 1, exercise_hz = 0;
  std::uint32_t thin = 0;  // as in Subscribe
};

// Why a connection ends.
struct LineEnd {
  enum class Kind : std::uint8_t {
    lost,      // it ended, or nothing came any more
    refused,   // the other server would not, or this one does not want it
    no_view,   // the view to go on with is no more
    malformed  // what came is not the native protocol
  };
  Kind kind = Kind::lost;
  std::string text;
};

// With what the server said before its reply: a coastline, objects of the chart, hops.
using AnsweredUp = std::function<void(const wire::Reply& reply, wire::ServerMessage* told)>;

// What is heard on a line.
class LineUser {
 public:
  virtual ~LineUser() = default;
  // Error: why the connection is not wanted.  The wish may still be changed.
  virtual std::optional<LineEnd> on_hello(const wire::Hello& hello, LineWish& wish) = 0;
  // The view it has.  Gives the view's number here.
  virtual std::uint32_t on_subscribed(std::uint32_t view) = 0;
  virtual void on_spokes(SpokeBatch::Spokes spokes) = 0;
  // Settings, OwnShip, World, PlaybackState, ExerciseState.
  virtual void on_news(wire::ServerMessage& message) = 0;
};

// Says who it is, subscribes, and then hands on what comes and asks what it is told to ask.
// Thread: one at a time.  Time is passed in.
class UpstreamLine {
 public:
  static constexpr std::chrono::seconds kSilence{5};  // then the connection is given up
  // Bytes that wait to be sent: twice what a server that reads can be asked at once (UpstreamTalk's
  // orders, of kMaxClientFrame each).  Then nothing more is asked and the connection is given up.
  static constexpr std::size_t kMostOutput = 4 * 1024 * 1024;

  // `token`: of the other server; empty: none.  `name`: of the other server, in errors.
  UpstreamLine(LineUser& user, LineWish wish, std::string token, std::string name)
      : user_(user), wish_(wish), token_(std::move(token)), name_(std::move(name)) {}

  // What came.  Error: why the connection is to be ended; nothing more may then be given.
  std::optional<LineEnd> take(std::span<const std::uint8_t> bytes, SteadyTime now);
  // Hands on the spokes collected; to be called once nothing more waits to be read.
  void flush();
  // What is to be sent now.
  Bytes take_output() { return std::exchange(output_, {}); }

  std::uint32_t thin() const { return wish_.thin; }
  bool is_subscribed() const { return state_ == State::subscribed; }
  // `answered` is called once: refused at once if the request is too long, or if the server does
  // not read.  `late`, if there is any, is called with the server's own answer where that comes
  // after `patience`, on the same connection.  Requires is_subscribed().
  void ask(wire::ClientMessage message, SteadyTime now, std::chrono::seconds patience,
           AnsweredUp answered, AnsweredUp late = {});
  static constexpr std::size_t kMostLate = 64;  // such as may still come; the oldest are given up
  // The same spokes at another level of thinness; they are numbered anew.  `answered` is called
  // once.  Requires is_subscribed().
  void change_thin(std::uint32_t thin, SteadyTime now, std::chrono::seconds patience,
                   AnsweredUp answered);
  std::size_t unanswered() const { return asked_.size(); }
  // Answers in place of the server what it was asked for too long ago.
  // Error: as take(), when nothing has come for kSilence, or kMostOutput waits to be sent.
  std::optional<LineEnd> tick(SteadyTime now);
  // The connection has ended: what is still unanswered is answered with this.
  void end(const std::string& why);

  std::uint64_t bytes() const { return bytes_; }
  const LossCounter& losses() const { return losses_; }

 private:
  enum class State : std::uint8_t { greeted_by_none, signing_in, subscribing, subscribed };

  std::optional<LineEnd> take_body(std::span<const std::uint8_t> body, SteadyTime now);
  std::optional<LineEnd> take_hello();
  std::optional<LineEnd> take_reply();
  std::optional<LineEnd> take_spoke(std::span<const std::uint8_t> body);
  std::optional<LineEnd> take_thin_spokes();
  wire::ClientMessage subscription() const;
  void subscribe();
  void send(wire::ClientMessage& message);
  LineEnd malformed(const std::string& what) const;
  std::string does_not_read() const;

  LineUser& user_;
  LineWish wish_;
  const std::string token_, name_;
  State state_ = State::greeted_by_none;
  FrameReader frames_{kMaxServerFrame};
  wire::ServerMessage message_;  // kept for its memory
  Bytes output_;
  bool is_full_ = false;  // it was to be asked more than kMostOutput
  std::uint32_t request_ = 0;
  std::optional<SpokeBatch> batch_;
  LossCounter losses_;
  std::uint64_t bytes_ = 0;
  std::optional<SteadyTime> heard_;
  struct Asked {
    AnsweredUp answered;
    SteadyTime until;
    AnsweredUp late;
  };
  std::map<std::uint32_t, Asked> asked_;
  std::map<std::uint32_t, AnsweredUp> late_;  // by request, not answered in time
  std::optional<wire::ServerMessage> told_;   // before its reply
};

}  // namespace skerry::server

// UpstreamTalk: all that a relay says to the server that it relays, and when it connects.  No
// sockets.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "server/relay/thin_choice.hpp"
#include "server/relay/upstream_host.hpp"
#include "server/relay/upstream_line.hpp"

namespace skerry::server {

// One line for view 0 of each radar, one for each further view that a console here has, and one for
// the exercise while somebody wants it.  That of radar 0 is the main one: orders go by it, and
// while it is not there no other is begun.  A line that has ended is begun again, the later the
// oftener it has failed, for ever.
// Thread: one at a time.  Time is passed in.
class UpstreamTalk {
 public:
  using LineId = std::uint64_t;
  static constexpr std::chrono::milliseconds kFirstRetry{250}, kLastRetry{4000};
  static constexpr std::chrono::seconds kPingEvery{2};
  // A line that was subscribed for less, twice in a row, is begun again the later the oftener.
  static constexpr std::chrono::seconds kProven{10};
  // For a view to be opened, and for who has been refused the exercise to ask again.
  static constexpr std::chrono::seconds kOpenPatience{5}, kTruthRetry{60};
  // For other spokes: what waits before the answer may fill a slow link for long.
  static constexpr std::chrono::seconds kThinPatience{60};

  // `token`: of the other server; empty: none.  `thin`: level of thin spokes, 0: as they are;
  // nothing: as the link needs.
  UpstreamTalk(UpstreamHost& host, std::string token, SteadyTime now,
               std::optional<std::uint32_t> thin = 0);
  ~UpstreamTalk();

  // Connections that are to be begun now, and such as are to be ended; each is told once.
  std::vector<LineId> to_begin(SteadyTime now);
  std::vector<LineId> to_end() { return std::exchange(to_end_, {}); }

  // Of a connection that was to be begun and is not to be ended.
  void connected(LineId id, SteadyTime now);
  void ended(LineId id, const std::string& why, SteadyTime now);  // or could not begin
  void take(LineId id, std::span<const std::uint8_t> bytes, SteadyTime now);
  void flush(LineId id, SteadyTime now);  // nothing more waits to be read
  Bytes take_output(LineId id);

  // Takes the orders of the host.
  void take_orders(SteadyTime now);
  // A few times a second.
  void tick(SteadyTime now);
  // Answers whatever is still unanswered; nothing may be called any more.
  void stop();

 private:
  class Link;
  using LinkPtr = std::unique_ptr<Link>;
  enum class Purpose : std::uint8_t { shared, own_view, truth };

  Link* find(LineId id);
  Link& main() { return *links_.front(); }
  bool is_there() const;
  void end(Link& link, const LineEnd& why, SteadyTime now);  // the connection is still there
  void after_end(Link& link, const LineEnd& why, SteadyTime now);
  void tell_gone(const LineEnd& why, SteadyTime now);
  void tell_back(SteadyTime now);
  // Ends lines to another run of the server than the main one's.
  void end_strays(SteadyTime now);
  void drop(LineId id);
  void carry_out(AskUp& order, SteadyTime now);
  void carry_out(OpenUp& order);
  void carry_out(const CloseUp& order);
  void begin_chart(SteadyTime now);
  void ping(SteadyTime now);
  void look_at_truth(SteadyTime now);
  // Asks for other spokes where the link carries more or less than now.
  void look_at_thin(SteadyTime now);

  UpstreamHost& host_;
  const std::string token_;
  ThinChoice thin_;
  std::vector<LinkPtr> links_;  // the main one first
  LineId last_id_ = 0;
  std::vector<LineId> to_end_;
  SteadyTime now_;  // of the call that is carried out
  std::optional<SteadyTime> gone_since_;
  std::string told_;  // why it has gone, as the log has it
  bool was_there_ = false;
  bool has_identity_ = false;
  SteadyTime pinged_, truth_refused_;
  bool truth_told_ = false;
  // The other server makes one of these at a time for each connection.
  std::deque<AskUp> charts_;
  bool chart_asked_ = false;
};

}  // namespace skerry::server

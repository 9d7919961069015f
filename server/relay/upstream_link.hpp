// A line of an UpstreamTalk, and what it is for.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "server/relay/upstream_talk.hpp"

namespace skerry::server {

class UpstreamTalk::Link final : public LineUser {
 public:
  Link(UpstreamTalk& talk, LineId number, Purpose purpose, LineWish wanted)
      : id(number), what(purpose), wish(wanted), talk_(talk) {}

  std::optional<LineEnd> on_hello(const wire::Hello& hello, LineWish& wanted) override;
  std::uint32_t on_subscribed(std::uint32_t view) override;
  void on_spokes(SpokeBatch::Spokes spokes) override;
  void on_news(wire::ServerMessage& message) override;

  // Counts what has come since it was last called.
  void count(SteadyTime now);
  void end_line();
  // Greeted by another run of the server than the main line was.
  bool is_stray() const;
  // The wait before the next attempt.
  std::chrono::milliseconds pause() const;
  // Another level of thin spokes from now on.
  void change_thin(std::uint32_t level);
  // Refuses who has asked for the view, if it has not been opened yet.
  void refuse_opening(const std::string& why);

  const LineId id;
  const Purpose what;
  LineWish wish;
  std::optional<UpstreamLine> line;  // while it is connected
  bool under_way = false;            // connected, or about to be
  bool is_unwanted = false;          // to be dropped once its line has been left
  unsigned failures = 0;             // to be subscribed, in a row
  unsigned short_lives = 0;          // subscribed for less than kProven, in a row
  SteadyTime subscribed_at{};
  SteadyTime next_try{};
  // Of a console's view.
  std::optional<OpenUp> opening;  // until it has been opened
  SteadyTime open_until{};
  std::optional<std::uint32_t> view;  // its number here
  std::string identity;               // of the run of the server that has opened it
  ThinChoice::Came came;              // and not yet looked at

 private:
  void note_pace(ScenarioTime made);
  wire::ClientMessage settings_again() const;
  void number_anew();

  UpstreamTalk& talk_;
  std::string greeted_by_;  // identity
  std::uint64_t bytes_counted_ = 0, received_counted_ = 0, lost_counted_ = 0;
  LossCounter losses_;  // over connections
  // Thin spokes have numbers of their own, in which those here go on.
  std::uint64_t shift_ = 0;
  std::optional<std::uint64_t> last_number_;  // here
  bool joins_ = false;                        // the next spoke follows the last one
  // When the last one came and was made.
  struct Paced {
    SteadyTime came{};
    ScenarioTime made{};
  };
  std::optional<Paced> paced_;
};

}  // namespace skerry::server

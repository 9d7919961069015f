#include "server/playback/turn_finder.hpp"

#include <algorithm>
#include <vector>

namespace skerry::server {
namespace {

constexpr int kGuesses = 12;
constexpr Duration kSlowestTurn = std::chrono::milliseconds(12'500);
constexpr std::size_t kMostSpokes = 200'000;  // looked at in one go: a file may say anything

// Far more than lie in any recording, so few that their time cannot overflow.
constexpr std::int32_t kMostTurns = 10'000'000;

std::int32_t turns_between(std::uint32_t from, std::uint32_t to) {
  return static_cast<std::int32_t>(to - from);
}

}  // namespace

TurnFinder::TurnFinder(const recording::RecordingReader& reader, recording::Topic topic, double rpm)
    : summary_(reader.summary()),
      cursor_(reader.items({topic})),
      turn_(seconds_as_duration(60.0 / std::clamp(rpm, 5.0, 60.0))) {}

std::optional<TurnFinder::Seen> TurnFinder::next() {
  while (const auto item = cursor_.next()) {
    if (!message_.ParseFromArray(item->bytes.data(), static_cast<int>(item->bytes.size())))
      continue;
    return Seen{item->time, message_.scan(), message_.index()};
  }
  return std::nullopt;
}

std::optional<TurnFinder::Seen> TurnFinder::first_from(UtcTime time) {
  cursor_.seek(std::max(time, summary_.begin));
  return next();
}

bool TurnFinder::turns_at(UtcTime place) {
  const auto spoke = first_from(place - kSlowestTurn);
  return spoke && spoke->time <= place + kSlowestTurn;
}

UtcTime TurnFinder::turn_before(UtcTime place) {
  std::vector<Seen> seen;
  for (Duration window = turn_ * 5 / 4;; window = kSlowestTurn) {
    seen.clear();
    for (auto spoke = first_from(place - window);
         spoke && spoke->time < place && seen.size() < kMostSpokes; spoke = next()) {
      seen.push_back(*spoke);
    }
    if (seen.empty()) return place;
    // A turn ends where the same index comes again.
    const Seen last = seen.back();
    const auto is_of_turn = [&](const Seen& spoke) {
      const std::int32_t back = turns_between(spoke.scan, last.scan);
      return back == 0 || (back == 1 && spoke.index > last.index);
    };
    const auto first = std::find_if(seen.begin(), seen.end(), is_of_turn);
    const bool whole = first != seen.begin() || seen.front().time <= summary_.begin;
    if (whole || window >= kSlowestTurn) return first->time;
  }
}

std::optional<UtcTime> TurnFinder::turn_from(UtcTime place, int turns) {
  const auto here = first_from(place);
  if (!here) {
    // At the end: the turn at hand is the last one.
    if (turns > 0) return std::nullopt;
    std::optional<Seen> last;
    std::size_t looked_at = 0;
    for (auto spoke = first_from(place - kSlowestTurn); spoke && looked_at < kMostSpokes;
         spoke = next(), ++looked_at) {
      last = spoke;
    }
    if (!last) return std::nullopt;
    return begin_of(last->scan + static_cast<std::uint32_t>(turns + 1), *last);
  }
  const auto begin = begin_of(here->scan, *here);
  const bool at_begin = begin && *begin == here->time;
  const int from_this_turn = turns < 0 && !at_begin ? turns + 1 : turns;
  return begin_of(here->scan + static_cast<std::uint32_t>(from_this_turn), *here);
}

std::optional<UtcTime> TurnFinder::begin_of(std::uint32_t scan, Seen near) {
  for (int guess = 0; guess < kGuesses; ++guess) {
    const std::int32_t ahead = std::clamp(turns_between(near.scan, scan), -kMostTurns, kMostTurns);
    // Somewhere in the turn before; exact from there.
    const UtcTime wanted =
        near.time + turn_ * (ahead - 1) - (ahead <= 0 ? turn_ / 2 : Duration::zero());
    const auto from = first_from(wanted);
    if (!from) {
      // Behind the end: nearer by half.
      if (ahead <= 2) return std::nullopt;
      const auto half = first_from(near.time + turn_ * (ahead / 2));
      if (!half) return std::nullopt;
      near = *half;
      continue;
    }
    const std::int32_t left = turns_between(from->scan, scan);
    if (left <= 0 && wanted <= summary_.begin) {
      return left == 0 && from->index == 0 ? std::optional(from->time) : std::nullopt;
    }
    // It began while no video came: with the first that came.
    if (left <= 0 && from->time - wanted > turn_ / 2) return from->time;
    if (left <= 0 || left > 3) {
      near = *from;
      continue;
    }
    std::size_t looked_at = 0;
    for (auto spoke = from; spoke && looked_at < kMostSpokes; spoke = next(), ++looked_at) {
      if (turns_between(spoke->scan, scan) <= 0) return spoke->time;
    }
    return std::nullopt;
  }
  return std::nullopt;
}

}  // namespace skerry::server

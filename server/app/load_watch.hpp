// LoadWatch: what radars could not do in time, in the server's log.
#pragma once

#include <chrono>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace skerry::server {

// How far a radar has come.
struct RadarPace {
  std::uint32_t radar = 0;
  std::uint64_t sectors = 0;  // that its antenna has passed and that it has looked at
  std::uint64_t skipped = 0;  // of these, never made for want of time
};

// Tells the begin, the end and the totals of
//   overload       radars leave out sectors, as they are too late for them
//   a standstill   of the whole server (the machine slept, SIGSTOP), or of one radar's thread,
//                  longer than kStill
// Of an overload there is a line at the begin and one every kAgain, the last of them once nothing
// was left out for kCalm: what comes and goes does not fill the log.
// Thread: one at a time.
class LoadWatch {
 public:
  using Steady = std::chrono::steady_clock::time_point;
  static constexpr std::chrono::milliseconds kLook{250};  // between calls of look()
  static constexpr std::chrono::seconds kStill{1}, kCalm{5}, kAgain{60};

  struct Line {
    bool is_warning = false;
    std::string text;
  };
  // The same radars in the same order every time.
  std::vector<Line> look(std::span<const RadarPace> radars, Steady now);
  // What has not come to its end.
  std::vector<Line> end();

 private:
  struct Known {
    RadarPace pace;
    Steady moved{};
    bool stands_still = false;
    std::uint64_t skipped_before = 0;  // before it stood still
  };
  struct Overload {
    Steady since{}, last{}, told{};
    std::uint64_t sectors = 0, skipped = 0;  // from `since` to `last`
    std::uint64_t calm_sectors = 0;          // after it
  };
  void begin(std::span<const RadarPace> radars, Steady now);
  void look_at_stall(std::uint64_t skipped);
  // False: it stands or stood still, so that what it leaves out is no overload.
  bool look_at_radar(Known& known, const RadarPace& pace, Steady now);
  void look_at_overload(std::uint64_t sectors, std::uint64_t skipped,
                        const std::vector<std::uint32_t>& late, Steady now);
  void tell(bool is_warning, std::string text) { lines_.push_back({is_warning, std::move(text)}); }
  std::string totals() const;

  std::vector<Known> radars_;
  Steady looked_{};
  // Radars notice a standstill of the server a moment after it is over.
  int stall_looks_ = 0;
  double stall_s_ = 0.0;
  std::uint64_t stall_skipped_ = 0;
  bool is_overloaded_ = false;
  Overload overload_;
  std::vector<Line> lines_;
};

}  // namespace skerry::server

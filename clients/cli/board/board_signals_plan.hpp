// The files that `skerry board signals` will write, their sizes, and reasons to refuse.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "clients/cli/board/board_command.hpp"
#include "clients/signals/signal_recording.hpp"
#include "clients/signals/waveform.hpp"

namespace skerry::client {

struct SignalOptions {
  BoardPlace place;
  std::uint32_t turns = 1;
  double seconds = 0.0;  // 0: turns instead
  std::string vcd, wav, sigmf;
  bool vcd_video = false;
  double rate_hz = 0.0;               // 0: the sample clock
  std::vector<std::string> channels;  // none: all that are on
};

// The board as its registers say, all read at one instant.
struct BoardFacts {
  std::uint32_t sample_clock_hz = 0;
  double turns_per_second = 0.0;
  double triggers_per_second = 0.0;  // at most, where the pulse decides
  std::uint32_t acp_per_turn = 0;
  std::uint32_t spokes_per_turn = 0;
  std::array<std::uint32_t, 2> samples{};  // of each video channel; 0: off
  std::uint64_t clocks = 0, utc_ns = 0;
  std::string source;
};
ClientResult<BoardFacts> read_facts(BoardClient& client, const BoardPlace& place);

struct SignalPlan {
  std::uint32_t rate_hz = 0;
  std::vector<SignalChannel> channels;
  bool sweeps = false;           // needed
  std::uint64_t lead_ticks = 1;  // of a recording of turns, as of SignalWish
  double seconds = 0.0;          // that it will last
};

// Error: why it cannot be done, and what can.
Result<SignalPlan, std::string> make_plan(const SignalOptions& options, const BoardFacts& facts);

// Size and path of every file, and whether there is room for them.
struct FileSizes {
  std::string text;          // "a.vcd 0.9 MB, a.wav 1.2 GB"
  std::string no_room = {};  // why not; empty: there is
};
// `edges` and `video_samples` of the whole recording.
FileSizes file_sizes(const SignalOptions& options, const SignalPlan& plan, std::uint64_t ticks,
                     std::uint32_t sample_clock_hz, std::uint64_t edges,
                     std::uint64_t video_samples);
// "1.2 GB".
std::string size_text(std::uint64_t bytes);

}  // namespace skerry::client

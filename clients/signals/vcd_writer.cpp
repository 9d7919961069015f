#include "clients/signals/vcd_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <optional>
#include <vector>

#include "clients/signals/output_file.hpp"
#include "clients/signals/pulse_train.hpp"
#include "clients/signals/video_track.hpp"
#include "protocol/wire/printable_text.hpp"

namespace skerry::client {
namespace {

constexpr std::uint64_t kBlockTicks = 1 << 16;

struct Change {
  std::uint64_t tick = 0;
  std::uint8_t wire = 0;
  std::uint8_t level = 0;
};

// The name of a wire where its level changes.
char id_of(std::size_t wire) { return static_cast<char>('!' + wire); }

class Dump {
 public:
  Dump(const std::string& path, const SignalRecording& recording, bool video)
      : recording_(recording),
        grid_(recording.sample_clock_hz, recording.sample_clock_hz, recording.ticks()),
        time_(vcd_timescale(recording.sample_clock_hz)) {
    for (const board::Line line :
         {board::Line::trigger, board::Line::acp, board::Line::arp, board::Line::heading}) {
      const auto wire = static_cast<std::uint8_t>(names_.size());
      names_.push_back(line_name(line));
      for (const Pulse& pulse : pulses_of(recording, line, grid_)) {
        edges_.push_back({pulse.rise, wire, 1});
        if (pulse.fall < grid_.ticks()) edges_.push_back({pulse.fall, wire, 0});
      }
    }
    std::sort(edges_.begin(), edges_.end(),
              [](const Change& a, const Change& b) { return a.tick < b.tick; });
    for (std::size_t channel = 0; video && channel < 2; ++channel) {
      if (!has_video(recording, channel)) continue;
      unsigned bits = 1;
      for (const board::Sweep& sweep : recording.sweeps) {
        bits = std::max(bits, code_bits(sweep.meta.channels[channel]));
      }
      videos_.push_back({channel, names_.size(), bits, 0});
      for (unsigned bit = bits; bit-- > 0;) {
        names_.push_back(fmt::format("video_{}[{}]", channel == 0 ? 'a' : 'b', bit));
      }
    }
    levels_.assign(names_.size(), 0);
    file_.emplace(path);
  }

  SignalFile write(const GoOn& go_on) {
    write_head();
    SignalFile result;
    std::size_t next = 0;
    for (std::uint64_t from = 0; from < grid_.ticks(); from += kBlockTicks) {
      const std::uint64_t to = std::min(from + kBlockTicks, grid_.ticks());
      changes_.clear();
      for (; next < edges_.size() && edges_[next].tick < to; ++next) {
        changes_.push_back(edges_[next]);
      }
      find_video_changes(from, to);
      for (const Change& change : changes_) write_change(change);
      result.samples = to;
      flush();
      const double done = static_cast<double>(to) / static_cast<double>(grid_.ticks());
      if (!go_on(done)) break;
    }
    result.complete = result.samples == grid_.ticks();
    begin_time(result.samples);
    flush();
    file_->close();
    result.bytes = file_->bytes();
    return result;
  }

 private:
  // A wire for every bit, the highest first.
  struct Video {
    std::size_t channel = 0;
    std::size_t first_wire = 0;
    unsigned bits = 0;
    std::uint16_t code = 0;  // until now
  };

  void write_head() {
    const auto out = std::back_inserter(text_);
    fmt::format_to(out, "$version skerry $end\n$comment {} $end\n", comment_text());
    fmt::format_to(out,
                   "$comment sample clock {} Hz, first tick {}, one sample per tick: "
                   "sigrok-cli -I vcd:downsample={} $end\n",
                   recording_.sample_clock_hz, recording_.from_tick, time_.downsample());
    fmt::format_to(out, "$timescale {} $end\n$scope module board $end\n", time_.unit);
    for (std::size_t wire = 0; wire < names_.size(); ++wire) {
      fmt::format_to(out, "$var wire 1 {} {} $end\n", id_of(wire), names_[wire]);
    }
    fmt::format_to(out, "$upscope $end\n$enddefinitions $end\n");
    write_first_levels();
  }

  // All wires as they are at time 0.
  void write_first_levels() {
    const auto out = std::back_inserter(text_);
    for (const Change& change : edges_) {
      if (change.tick == 0) levels_[change.wire] = change.level;
    }
    changes_.clear();
    find_video_changes(0, std::min<std::uint64_t>(grid_.ticks(), 1));
    for (const Change& change : changes_) levels_[change.wire] = change.level;
    begin_time(0);
    fmt::format_to(out, "$dumpvars\n");
    for (std::size_t wire = 0; wire < names_.size(); ++wire) write_level(wire);
    fmt::format_to(out, "$end\n");
  }

  // A `$end` in it would end the comment.
  std::string comment_text() const {
    std::string text = printable(recording_.source);
    std::replace(text.begin(), text.end(), '$', '_');
    return text.empty() ? "signals of an interface board" : text;
  }

  VideoTrack track(const Video& video) const {
    return {recording_, video.channel, grid_, VideoTrack::Scale::codes};
  }

  void find_video_changes(std::uint64_t from, std::uint64_t to) {
    if (videos_.empty()) return;
    codes_.resize(to - from);
    for (Video& video : videos_) {
      track(video).fill(from, codes_);
      for (std::uint64_t k = 0; k < codes_.size(); ++k) {
        if (codes_[k] != video.code) add_changes(video, from + k, codes_[k]);
      }
    }
    std::stable_sort(changes_.begin(), changes_.end(),
                     [](const Change& a, const Change& b) { return a.tick < b.tick; });
  }

  void add_changes(Video& video, std::uint64_t tick, std::uint16_t code) {
    const unsigned changed = video.code ^ code;
    for (unsigned bit = 0; bit < video.bits; ++bit) {
      if (((changed >> bit) & 1u) == 0) continue;
      changes_.push_back({tick, static_cast<std::uint8_t>(video.first_wire + video.bits - 1 - bit),
                          static_cast<std::uint8_t>((code >> bit) & 1u)});
    }
    video.code = code;
  }

  void write_change(const Change& change) {
    if (levels_[change.wire] == change.level) return;  // as at time 0
    levels_[change.wire] = change.level;
    begin_time(change.tick);
    write_level(change.wire);
  }

  void begin_time(std::uint64_t tick) {
    if (tick_written_ && tick_ == tick) return;
    tick_written_ = true;
    tick_ = tick;
    fmt::format_to(std::back_inserter(text_), "#{}\n", time_.time_of(tick));
  }

  void write_level(std::size_t wire) {
    text_.push_back(static_cast<char>('0' + levels_[wire]));
    text_.push_back(id_of(wire));
    text_.push_back('\n');
  }

  void flush() {
    file_->write(std::string_view(text_.data(), text_.size()));
    text_.clear();
  }

  const SignalRecording& recording_;
  SampleGrid grid_;
  VcdTimescale time_;
  std::vector<std::string> names_;    // of the wires
  std::vector<std::uint8_t> levels_;  // of the wires, as written
  std::vector<Video> videos_;
  std::vector<Change> edges_, changes_;
  std::vector<std::uint16_t> codes_;
  std::uint64_t tick_ = 0;
  bool tick_written_ = false;
  fmt::memory_buffer text_;
  std::optional<OutputFile> file_;
};

}  // namespace

std::uint64_t VcdTimescale::time_of(std::uint64_t tick) const {
  return static_cast<std::uint64_t>(
      (static_cast<unsigned __int128>(tick) * units_per_second + clock_hz / 2) / clock_hz);
}

VcdTimescale vcd_timescale(std::uint32_t clock_hz) {
  constexpr std::array<VcdTimescale, 3> kUnits = {
      {{"1 ns", 1'000'000'000}, {"1 ps", 1'000'000'000'000}, {"1 fs", 1'000'000'000'000'000}}};
  VcdTimescale chosen = kUnits.back();
  for (const VcdTimescale& unit : kUnits) {
    if (unit.units_per_second % clock_hz != 0) continue;
    chosen = unit;
    break;
  }
  chosen.clock_hz = clock_hz;
  return chosen;
}

std::uint64_t vcd_bytes(std::uint64_t edges, std::uint64_t video_changes) {
  return 4096 + edges * 42 + video_changes * 40;
}

SignalFile write_vcd(const std::string& path, const SignalRecording& recording, bool video,
                     const GoOn& go_on) {
  return Dump(path, recording, video).write(go_on);
}

}  // namespace skerry::client

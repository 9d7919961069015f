#include "clients/cli/recording/record_words.hpp"

#include <fmt/format.h>

#include <array>

#include "protocol/wire/printable_text.hpp"

namespace skerry::client {
namespace {

using wire::RecorderState;

const char* phase_text(RecorderState::Phase phase) {
  switch (phase) {
    case RecorderState::OFF:
      return "off";
    case RecorderState::RECORDING:
      return "recording";
    case RecorderState::DISK_FULL:
      return "DISK FULL";
    case RecorderState::FAILED:
      return "FAILED";
    default:
      return "unknown";
  }
}

std::string time_text(double seconds) {
  const auto whole = static_cast<std::int64_t>(seconds);
  return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

std::string path_of(const RecorderState& state) {
  if (state.file().empty()) return printable(state.folder());
  return printable(state.folder()) + "/" + printable(state.file());
}

}  // namespace

std::string bytes_text(double bytes) {
  constexpr std::array<const char*, 5> kUnits = {"B", "kB", "MB", "GB", "TB"};
  std::size_t unit = 0;
  for (; bytes >= 1000.0 && unit + 1 < kUnits.size(); ++unit) bytes /= 1000.0;
  return unit == 0 ? fmt::format("{:.0f} B", bytes) : fmt::format("{:.3g} {}", bytes, kUnits[unit]);
}

std::string recorder_line(const RecorderState& state) {
  std::string line = fmt::format("{:<9}  {}", phase_text(state.phase()), path_of(state));
  if (state.file().empty()) return line;
  line += fmt::format("  {}  {}", time_text(state.seconds()),
                      bytes_text(static_cast<double>(state.total_bytes())));
  if (state.phase() == RecorderState::RECORDING) {
    line += fmt::format("  {}/s", bytes_text(state.bytes_per_second()));
  }
  line += fmt::format("  {} free  {} spokes, {} lost",
                      bytes_text(static_cast<double>(state.free_bytes())), state.spokes(),
                      state.spokes_lost());
  if (state.marks() > 0) line += fmt::format("  {} marks", state.marks());
  return line;
}

std::string recorder_text(const RecorderState& state) {
  std::string text = fmt::format("{:<12}{}{}{}\n", "STATE", phase_text(state.phase()),
                                 state.inputs_only() ? ", inputs only" : "",
                                 state.all_views() ? ", all views" : "");
  const auto add = [&](const char* what, const std::string& value) {
    text += fmt::format("{:<12}{}\n", what, value);
  };
  add("FOLDER", printable(state.folder()));
  if (!state.file().empty()) {
    add("FILE", printable(state.file()));
    add("SIZE",
        fmt::format("{}, of all files {}", bytes_text(static_cast<double>(state.file_bytes())),
                    bytes_text(static_cast<double>(state.total_bytes()))));
    add("TIME", time_text(state.seconds()));
    add("RATE", bytes_text(state.bytes_per_second()) + "/s");
    add("SPOKES", fmt::format("{}, {} lost", state.spokes(), state.spokes_lost()));
    add("MARKS", fmt::format("{}", state.marks()));
  }
  if (state.free_bytes() > 0 || state.phase() == RecorderState::DISK_FULL) {
    add("FREE", bytes_text(static_cast<double>(state.free_bytes())));
  }
  if (!state.problem().empty()) add("PROBLEM", printable(state.problem()));
  return text;
}

}  // namespace skerry::client

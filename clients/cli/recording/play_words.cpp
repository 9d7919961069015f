#include "clients/cli/recording/play_words.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <optional>

#include "protocol/recording/position.hpp"
#include "protocol/wire/printable_text.hpp"

namespace skerry::client {
namespace {

constexpr double kLongest = 1e9;  // s; a server may say anything

std::string_view trimmed(std::string_view text) {
  const auto from = text.find_first_not_of(" \t\r\n");
  if (from == std::string_view::npos) return {};
  return text.substr(from, text.find_last_not_of(" \t\r\n") - from + 1);
}

template <typename Number>
std::optional<Number> number_of(std::string_view text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::string clock_text(double seconds) {
  const double known = seconds >= 0.0 && seconds <= kLongest ? seconds : 0.0;
  const auto tenths = std::llround(known * 10.0);
  return fmt::format("{}:{:02}:{:02}.{}", tenths / 36'000, tenths / 600 % 60, tenths / 10 % 60,
                     tenths % 10);
}

Failure<std::string> wrong(std::string_view line, std::string_view expected) {
  return Failure<std::string>{fmt::format("'{}': {}", printable(line, 100), expected)};
}

}  // namespace

Result<PlayWords, std::string> parse_play_words(std::string_view line) {
  line = trimmed(line);
  const auto space = line.find_first_of(" \t");
  const std::string_view verb = line.substr(0, space);
  const std::string_view rest =
      space == std::string_view::npos ? std::string_view{} : trimmed(line.substr(space));
  PlayWords words;
  const auto alone = [&](PlayWords::What what) -> Result<PlayWords, std::string> {
    if (!rest.empty()) return wrong(line, fmt::format("expected '{}' and nothing behind it", verb));
    words.what = what;
    return words;
  };
  if (verb.empty() || verb == "state") return alone(PlayWords::What::state);
  if (verb == "marks") return alone(PlayWords::What::marks);
  if (verb == "help" || verb == "?") return alone(PlayWords::What::help);
  if (verb == "quit" || verb == "exit") return alone(PlayWords::What::quit);
  wire::Playback& request = words.request;
  if (verb == "play" || verb == "pause") {
    request.set_playing(verb == "play");
    return alone(PlayWords::What::ask);
  }
  words.what = PlayWords::What::ask;
  if (verb == "seek" || verb == "mark") {
    const auto place =
        recording::parse_position(verb == "mark" ? "mark:" + std::string(rest) : std::string(rest));
    if (!place) return Failure{place.error()};
    if (place->is_mark()) {
      request.set_mark(place->mark);
    } else {
      request.set_position_s(in_seconds(place->since_begin));
    }
    return words;
  }
  if (verb == "rate") {
    const std::string_view digits = rest.ends_with('x') ? rest.substr(0, rest.size() - 1) : rest;
    const auto rate = number_of<double>(digits);
    if (!rate) return wrong(line, "expected a number, as 'rate 4'");
    request.set_rate(*rate);
    return words;
  }
  if (verb == "loop") {
    if (rest != "on" && rest != "off") return wrong(line, "expected 'loop on' or 'loop off'");
    request.set_loop(rest == "on");
    return words;
  }
  if (verb == "step" || verb == "back") {
    const auto turns = rest.empty() ? std::optional(1) : number_of<int>(rest);
    if (!turns) return wrong(line, fmt::format("expected a number of turns, as '{} 3'", verb));
    request.set_step_turns(verb == "back" ? -*turns : *turns);
    return words;
  }
  return wrong(line, "unknown; 'help' lists what there is");
}

std::string play_words_help() {
  return "  play                 go on\n"
         "  pause                stand still\n"
         "  seek PLACE           90, 1:30, 0:01:30.5 or a mark's name\n"
         "  mark NAME            the same, where a name looks like a time\n"
         "  rate R               times the recorded pace, 0.1 to 100\n"
         "  loop on|off          from the begin again at the end\n"
         "  step [N], back [N]   so many turns of the antenna on or back, then stand still\n"
         "  marks                the recording's marks\n"
         "  state                where it is (also an empty line)\n"
         "  quit                 end\n";
}

std::string playback_line(const wire::PlaybackState& state) {
  std::string text =
      fmt::format("{} of {}  {}  {:g}x", clock_text(state.position_s()),
                  clock_text(state.length_s()), state.playing() ? "plays" : "stands", state.rate());
  if (state.loop()) text += "  in a loop";
  if (!state.problem().empty()) text += "  (" + printable(state.problem(), 200) + ")";
  return text;
}

std::string marks_text(const wire::PlaybackState& state) {
  if (state.marks_size() == 0) return "the recording has no marks\n";
  std::string text;
  for (const auto& mark : state.marks()) {
    text += fmt::format("{}  {}\n", clock_text(mark.position_s()), printable(mark.name(), 100));
  }
  return text;
}

}  // namespace skerry::client

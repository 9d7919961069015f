// skerry play: plays a recording to every output, and controls a playback.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "clients/cli/command.hpp"
#include "clients/cli/console.hpp"
#include "clients/cli/number_within.hpp"
#include "clients/cli/recording/play_words.hpp"
#include "clients/cli/recording/server_child.hpp"
#include "protocol/wire/printable_text.hpp"

namespace skerry::client {
namespace {

struct PlayOptions {
  ServerPlace place;
  bool running = false;            // --server: one that runs already
  std::vector<std::string> words;  // the file; of a running server, what to say to it
  double rate = 1.0;
  bool loop = false, paused = false, current_timestamps = false;
  std::string from, token;
  std::vector<std::string> outputs;
  std::uint16_t http_port = 7480;
  bool no_udp = false, no_cat240 = false;
};

// Lines of standard input as they come, without waiting for them.
class Lines {
 public:
  // nullopt if no whole line has come within `timeout`; waits that long at the end of input too.
  std::optional<std::string> next(std::chrono::milliseconds timeout) {
    if (auto line = take()) return line;
    if (ended_) {
      std::this_thread::sleep_for(timeout);
      return std::nullopt;
    }
    pollfd wait{STDIN_FILENO, POLLIN, 0};
    if (::poll(&wait, 1, static_cast<int>(timeout.count())) <= 0) return std::nullopt;
    char bytes[4096];
    const auto size = ::read(STDIN_FILENO, bytes, sizeof bytes);
    if (size < 0 && errno == EINTR) return std::nullopt;
    if (size <= 0) ended_ = true;
    if (size > 0) unread_.append(bytes, static_cast<std::size_t>(size));
    return take();
  }

 private:
  std::optional<std::string> take() {
    const auto end = unread_.find('\n');
    if (end == std::string::npos && !(ended_ && !unread_.empty())) return std::nullopt;
    const std::string line = unread_.substr(0, end);
    unread_.erase(0, end == std::string::npos ? end : end + 1);
    return line;
  }
  std::string unread_;
  bool ended_ = false;
};

class Conversation {
 public:
  Conversation(SpokeClient& client, const PlayOptions& options)
      : client_(client), options_(options) {}

  // False: nothing more is wanted.  What the server refuses is told and goes on.
  // Error: the connection's.
  ClientResult<bool> say(const PlayWords& words) {
    if (words.what == PlayWords::What::quit) return false;
    if (words.what == PlayWords::What::help) {
      write_out(play_words_help());
      return true;
    }
    if (words.what == PlayWords::What::ask) {
      wire::Playback request = words.request;
      request.set_token(options_.token);
      const auto reply = client_.playback(request, options_.place.timeout());
      if (!reply && reply.error().kind != ClientErrorKind::rejected) return Failure{reply.error()};
      refused_ = !reply;
      if (!reply) {
        fmt::print(stderr, "{}\n", reply.error().text);
        return true;
      }
    }
    const auto state = this->state();
    if (!state) return Failure{state.error()};
    write_out(words.what == PlayWords::What::marks ? marks_text(*state)
                                                   : playback_line(*state) + "\n");
    return true;
  }
  ClientResult<wire::PlaybackState> state() {
    auto status = client_.get_status(options_.place.timeout());
    if (!status) return Failure{status.error()};
    return status->playback();
  }
  bool refused() const { return refused_; }

 private:
  SpokeClient& client_;
  const PlayOptions& options_;
  bool refused_ = false;
};

// Takes words from the terminal until quit, Ctrl-C, or the end of the server `child`, if it has
// one.
int converse(SpokeClient& client, const PlayOptions& options, ServerChild* child) {
  Conversation conversation(client, options);
  Lines lines;
  const bool terminal = ::isatty(STDIN_FILENO) == 1;
  if (terminal) fmt::print(stderr, "Type play, pause, seek 1:30 ... ('help' lists all).\n");
  Progress progress;
  while (!interrupted()) {
    const auto line = lines.next(std::chrono::milliseconds(500));
    if (child != nullptr && child->ended()) return interrupted() ? kExitOk : kExitFailure;
    if (interrupted()) break;
    if (!line) {
      const auto state = conversation.state();
      if (!state) return interrupted() ? kExitOk : report(state.error());
      if (terminal) progress.show(playback_line(*state));
      continue;
    }
    const auto words = parse_play_words(*line);
    if (!words) {
      fmt::print(stderr, "{}\n", words.error());
      continue;
    }
    const auto more = conversation.say(*words);
    if (!more) return interrupted() ? kExitOk : report(more.error());
    if (!*more) break;
  }
  return kExitOk;
}

int control_running(const PlayOptions& options) {
  auto client = options.place.connect();
  if (!client) return report(client.error());
  if (!client->hello().playback()) {
    return report(client->name() + " plays no recording: its radars run",
                  "skerry play FILE plays one.");
  }
  if (options.words.empty()) return converse(*client, options, nullptr);
  const auto words = parse_play_words(fmt::format("{}", fmt::join(options.words, " ")));
  if (!words) {
    report(words.error());
    return kExitUsage;
  }
  Conversation conversation(*client, options);
  const auto said = conversation.say(*words);
  if (!said) return report(said.error());
  return conversation.refused() ? kExitFailure : kExitOk;
}

std::vector<std::string> server_arguments(const PlayOptions& options) {
  std::vector<std::string> arguments = {"--play",      options.words.front(),
                                        "--play-rate", fmt::format("{}", options.rate),
                                        "--tcp-port",  fmt::format("{}", options.place.port),
                                        "--http-port", fmt::format("{}", options.http_port)};
  if (options.loop) arguments.emplace_back("--play-loop");
  if (options.paused) arguments.emplace_back("--play-paused");
  if (options.current_timestamps) arguments.emplace_back("--current-timestamps");
  if (options.no_udp) arguments.emplace_back("--no-udp");
  if (options.no_cat240) arguments.emplace_back("--no-cat240");
  if (!options.from.empty()) arguments.insert(arguments.end(), {"--play-from", options.from});
  for (const std::string& output : options.outputs) {
    arguments.insert(arguments.end(), {"--output", output});
  }
  return arguments;
}

int play_file(PlayOptions options) {
  if (options.words.size() != 1) {
    report("play: one file is played at a time",
           "skerry play FILE; words like 'pause' go to a running server: skerry play --server "
           "pause");
    return kExitUsage;
  }
  ServerChild child(server_arguments(options));
  const auto port = child.await_port();
  if (interrupted()) return kExitOk;
  if (!port) return kExitFailure;  // it has said why
  options.place.host = kDefaultHost;
  options.place.port = *port;
  auto client = options.place.connect();
  if (!client) return interrupted() ? kExitOk : report(client.error());
  return converse(*client, options, &child);
}

void add_file_options(CLI::App& command, PlayOptions& options) {
  const char* const group = "Of a file";
  command.add_option("--rate", options.rate, "Times the recorded pace")
      ->check(number_within(0.1, 100.0))
      ->capture_default_str()
      ->group(group);
  command.add_flag("--loop", options.loop, "From the begin again at the end")->group(group);
  command.add_option("--from", options.from, "Begin there: 90, 1:30, 0:01:30.5 or a mark's name")
      ->group(group);
  command.add_flag("--paused", options.paused, "Stand there until told to play")->group(group);
  command
      .add_flag("--current-timestamps", options.current_timestamps,
                "Spokes and ships bear the time at which they are played, not their own")
      ->group(group);
  command
      .add_option("--output", options.outputs,
                  "Further outputs, as of skerryd: navico_4g, garmin_xhd, cat240:port=8601 ...")
      ->group(group);
  command.add_option("--http-port", options.http_port, "Port of the web console; 0: any free one")
      ->capture_default_str()
      ->group(group);
  command.add_flag("--no-udp", options.no_udp, "No native datagrams")->group(group);
  command.add_flag("--no-cat240", options.no_cat240, "No CAT240")->group(group);
}

}  // namespace

Command make_play_command(CLI::App& app) {
  auto options = std::make_shared<PlayOptions>();
  CLI::App* command = app.add_subcommand(
      "play",
      "Plays a recording to every output: the web console, displays, CAT240, Signal K; or controls "
      "a playback");
  command->add_option("words", options->words,
                      "The recording; with --server what to say to it (none: from the terminal)");
  command->add_flag("--server", options->running, "Controls a skerryd that plays already");
  command->add_option("--host", options->place.host, "Where that runs")->capture_default_str();
  command->add_option("--port", options->place.port, "Native TCP port; of a file, 0: any free one")
      ->check(CLI::Range(0, 65535))
      ->capture_default_str();
  command
      ->add_option("--timeout", options->place.timeout_s,
                   "Seconds without an answer to give up after")
      ->check(number_within(0.1, 3600.0))
      ->capture_default_str();
  command->add_option("--token", options->token, "Needed from another host than the server's")
      ->envname("SKERRY_TOKEN");
  add_file_options(*command, *options);
  command->footer(
      "From the terminal, a line each:\n" + play_words_help() +
      "Ctrl-C ends.\n\n"
      "Examples:\n"
      "  skerry play exercise.mcap\n"
      "  skerry play exercise.mcap --rate 10 --loop --from 1:30\n"
      "  skerry play halo.mcap --output garmin_xhd        (a HALO on a Garmin plotter)\n"
      "  skerry play --server seek 0:05:00\n"
      "  skerry play --server step 1\n");
  return {command,
          [options] { return options->running ? control_running(*options) : play_file(*options); }};
}

}  // namespace skerry::client

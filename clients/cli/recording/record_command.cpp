// skerry record: begins, ends and marks recordings on the server's disk, and says how they go.
#include <fmt/format.h>

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "clients/cli/command.hpp"
#include "clients/cli/console.hpp"
#include "clients/cli/message_json.hpp"
#include "clients/cli/recording/record_words.hpp"
#include "protocol/wire/printable_text.hpp"

namespace skerry::client {
namespace {

using wire::RecorderState;

constexpr std::chrono::seconds kSettles{30};  // a recorder on a disk that is slow but not dead

struct RecordOptions {
  ServerPlace place;
  std::string name, token;
  std::vector<std::uint32_t> radars;
  bool inputs_only = false;
  bool all_views = false;
  bool json = false;
};

bool is_recording(const RecorderState& state) {
  return state.phase() == RecorderState::RECORDING || state.phase() == RecorderState::DISK_FULL;
}

ClientResult<RecorderState> state_of(SpokeClient& client, const RecordOptions& options) {
  auto status = client.get_status(options.place.timeout());
  if (!status) return Failure{status.error()};
  return status->recorder();
}

// Asks until what was ordered has come about; the state then, or as it is after kSettles.
template <typename Done>
ClientResult<RecorderState> await(SpokeClient& client, const RecordOptions& options, Done&& done) {
  const auto until = std::chrono::steady_clock::now() + kSettles;
  for (;;) {
    auto state = state_of(client, options);
    if (!state || done(*state) || interrupted() || std::chrono::steady_clock::now() > until) {
      return state;
    }
    std::this_thread::sleep_for(kLookAround);
  }
}

ClientResult<SpokeClient> connect(const RecordOptions& options) {
  auto client = options.place.connect();
  if (client && !client->hello().can_record()) {
    return Failure{ClientError{ClientErrorKind::rejected, client->name() + " cannot record"}};
  }
  return client;
}

int ask(const RecordOptions& options, wire::Record::Action action) {
  auto client = connect(options);
  if (!client) return report(client.error());
  wire::Record request;
  request.set_action(action);
  request.set_name(options.name);
  request.set_token(options.token);
  request.set_inputs_only(options.inputs_only);
  request.set_all_views(options.all_views);
  for (const std::uint32_t radar : options.radars) request.add_radars(radar);
  const auto before = state_of(*client, options);
  if (!before) return report(before.error());
  const auto reply = client->record(request, options.place.timeout());
  if (!reply) return report(reply.error());
  const auto state = await(*client, options, [&](const RecorderState& now) {
    switch (action) {
      case wire::Record::START:
        return is_recording(now) ? !now.file().empty() : now.phase() == RecorderState::FAILED;
      case wire::Record::STOP:
        return !is_recording(now);
      default:
        return now.marks() != before->marks() || !is_recording(now);
    }
  });
  if (!state) return report(state.error());
  if (state->phase() == RecorderState::FAILED) return report(printable(state->problem()));
  write_out(recorder_line(*state) + "\n");
  if (!state->problem().empty()) return report(printable(state->problem()));
  return kExitOk;
}

int show(const RecordOptions& options) {
  auto client = connect(options);
  if (!client) return report(client.error());
  const auto state = state_of(*client, options);
  if (!state) return report(state.error());
  if (!options.json) {
    write_out(recorder_text(*state));
    return kExitOk;
  }
  write_out(json_text(*state));
  return kExitOk;
}

int watch(const RecordOptions& options) {
  auto client = connect(options);
  if (!client) return report(client.error());
  while (!interrupted()) {
    const auto state = state_of(*client, options);
    if (!state) return interrupted() ? kExitOk : report(state.error());
    write_out(recorder_line(*state) + "\n");
    for (int i = 0; i < 10 && !interrupted(); ++i) std::this_thread::sleep_for(kLookAround);
  }
  return kExitOk;
}

}  // namespace

Command make_record_command(CLI::App& app) {
  auto* command = app.add_subcommand("record", "Records on the server's disk");
  auto options = std::make_shared<RecordOptions>();
  command->require_subcommand(1);
  command->footer(
      "Examples:\n"
      "  skerry record start                     all radars; named by date and time\n"
      "  skerry record start \"watch 3\" --radar 0\n"
      "  skerry record start exam --all-views    what each console saw, at its own range and "
      "gain\n"
      "  skerry record mark \"collision\"          skerry play FILE --from collision goes there\n"
      "  skerry record watch                     a line a second until Ctrl-C\n"
      "  skerry record stop\n"
      "Where recordings go and when old ones are removed is the server's configuration.\n");
  auto* start = command->add_subcommand("start", "Begins a recording");
  start->add_option("name", options->name, "Of the file, without folder and ending");
  start->add_option("--radar", options->radars, "These radars; all without");
  auto* inputs_only =
      start->add_flag("--inputs-only", options->inputs_only,
                      "What the exercise was given, from which its video can be made again: a few "
                      "kB an hour");
  start
      ->add_flag("--all-views", options->all_views,
                 "Every view of the radars, also those opened later; without, view 0 alone, which "
                 "all consoles share")
      ->excludes(inputs_only);
  auto* stop = command->add_subcommand("stop", "Ends it, and waits until its file is whole");
  auto* mark = command->add_subcommand("mark", "Marks this moment");
  mark->add_option("name", options->name, "Of the mark; \"mark N\" without");
  auto* status = command->add_subcommand("status", "Says how it goes");
  status->add_flag("--json", options->json, "The whole answer as JSON");
  auto* watches = command->add_subcommand("watch", "Says so once a second, until Ctrl-C");
  for (CLI::App* each : {start, stop, mark, status, watches}) options->place.add_options(*each);
  for (CLI::App* each : {start, stop, mark}) {
    each->add_option("--token", options->token,
                     "The server's control token; needed from another host than the server's")
        ->envname("SKERRY_TOKEN");
  }
  return {command, [=] {
            if (start->parsed()) return ask(*options, wire::Record::START);
            if (stop->parsed()) return ask(*options, wire::Record::STOP);
            if (mark->parsed()) return ask(*options, wire::Record::MARK);
            return status->parsed() ? show(*options) : watch(*options);
          }};
}

}  // namespace skerry::client

// skerry board signals: a few turns of the board's signals as files for bench generators and
// viewers.
#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "clients/cli/board/board_command.hpp"
#include "clients/cli/board/board_signals_plan.hpp"
#include "clients/cli/console.hpp"
#include "clients/cli/number_within.hpp"
#include "clients/signals/sigmf_writer.hpp"
#include "clients/signals/signal_gatherer.hpp"
#include "clients/signals/vcd_writer.hpp"
#include "clients/signals/wav_writer.hpp"

namespace skerry::client {
namespace {

// A recording that was lost so often will be again.
constexpr int kMostAttempts = 3;
constexpr const char* kLessAdvice =
    "Record without video (--channels), lower SAMPLES_A, or close other programs.";

std::optional<FileSizes> room_for(const SignalOptions& options, const SignalPlan& plan,
                                  std::uint64_t ticks, std::uint32_t clock_hz, std::uint64_t edges,
                                  std::uint64_t video_samples) {
  FileSizes sizes = file_sizes(options, plan, ticks, clock_hz, edges, video_samples);
  if (sizes.no_room.empty()) return sizes;
  report(fmt::format("{}: {}", sizes.text, sizes.no_room),
         "Files need a folder that is there and room in it: record less (--turns, --seconds), at "
         "a lower --rate, or fewer --channels.");
  return std::nullopt;
}

// Takes records until all that was wished for has come, or Ctrl-C.  nullopt after an error, which
// has been reported.
std::optional<SignalRecording> gather(BoardClient& client, const SignalOptions& options,
                                      const SignalPlan& plan) {
  using State = SignalGatherer::State;
  SignalGatherer gatherer({.turns = options.seconds > 0 ? 0 : options.turns,
                           .seconds = options.seconds,
                           .sweeps = plan.sweeps,
                           .lead_ticks = plan.lead_ticks});
  Progress progress;
  auto last = Clock::now();
  std::uint64_t lost = 0;
  int attempts = 1;
  while (true) {
    if (interrupted()) {
      if (gatherer.state() == State::gathering) return gatherer.take();
      report("interrupted before the recording began; nothing was written");
      return std::nullopt;
    }
    const auto record = client.next(kLookAround);
    if (!record) {
      report_board(record.error());
      return std::nullopt;
    }
    if (!*record) {
      if (Clock::now() - last <= options.place.timeout()) continue;
      report(fmt::format("no signals from the board of radar {} of {} for {:g} s",
                         options.place.radar, client.name(), options.place.server.timeout_s),
             "skerry board registers shows whether it is running (CONTROL).");
      return std::nullopt;
    }
    last = Clock::now();
    if (client.records_lost() != lost) {
      lost = client.records_lost();
      if (++attempts > kMostAttempts) {
        report(fmt::format("{} records were lost on the way, a recording would have gaps", lost),
               kLessAdvice);
        return std::nullopt;
      }
      gatherer.restart();
    }
    switch (gatherer.add((*record)->record)) {
      case State::done:
        return gatherer.take();
      case State::broken:
        report(gatherer.error(), "skerry board registers shows the board's settings and faults.");
        return std::nullopt;
      case State::waiting:
        progress.show("waiting for the antenna to pass the ARP");
        break;
      case State::gathering:
        progress.show(
            fmt::format("recording: {:.1f} of {:.1f} s", gatherer.seconds(), plan.seconds));
        break;
    }
  }
}

std::map<board::Line, std::uint64_t> count_edges(const SignalRecording& recording) {
  std::map<board::Line, std::uint64_t> counts;
  for (const board::Edge& edge : recording.edges) ++counts[edge.line];
  return counts;
}

std::uint64_t count_video_samples(const SignalRecording& recording) {
  std::uint64_t count = 0;
  for (const board::Sweep& sweep : recording.sweeps) {
    count += sweep.samples[0].size() + sweep.samples[1].size();
  }
  return count;
}

// Writes the files one after another; false if Ctrl-C ended one early.
class FileWriter {
 public:
  FileWriter(const SignalOptions& options, const SignalPlan& plan, const SignalRecording& recording)
      : options_(options), plan_(plan), recording_(recording), heeds_interrupts_(!interrupted()) {}

  bool write() {
    // Whatever a rate makes impossible shows before a file is written.
    std::optional<Waveform> waveform;
    if (!options_.wav.empty() || !options_.sigmf.empty()) {
      waveform.emplace(recording_, plan_.channels, plan_.rate_hz);
    }
    if (!options_.vcd.empty()) {
      finish(options_.vcd,
             write_vcd(options_.vcd, recording_, options_.vcd_video, asker(options_.vcd)));
    }
    if (complete_ && !options_.wav.empty()) {
      finish(options_.wav, write_wav(options_.wav, recording_, *waveform, asker(options_.wav)));
    }
    if (complete_ && !options_.sigmf.empty()) {
      const SigmfFiles files = write_sigmf(options_.sigmf, recording_, plan_.channels,
                                           plan_.rate_hz, asker(options_.sigmf));
      finish(files.paths.back(), files.data);
    }
    return complete_;
  }

 private:
  GoOn asker(const std::string& path) {
    return [this, path](double done) {
      progress_.show(fmt::format("writing {}: {:.0f} %", path, 100 * done));
      return !(heeds_interrupts_ && interrupted());
    };
  }

  void finish(const std::string& path, const SignalFile& file) {
    complete_ = file.complete;
    write_out(fmt::format("{}: {}, {} {}{}\n", path, size_text(file.bytes), file.samples,
                          path == options_.vcd ? "ticks" : "samples",
                          file.complete ? "" : ", ended early"));
  }

  const SignalOptions& options_;
  const SignalPlan& plan_;
  const SignalRecording& recording_;
  bool heeds_interrupts_;
  bool complete_ = true;
  Progress progress_;
};

void write_summary(const SignalRecording& recording, const SignalPlan& plan) {
  auto counts = count_edges(recording);
  write_out(
      fmt::format("{:.6f} s from tick {}: {} triggers, {} ACP, {} ARP, {} heading, {} "
                  "sweeps\n",
                  recording.seconds(), recording.from_tick, counts[board::Line::trigger],
                  counts[board::Line::acp], counts[board::Line::arp], counts[board::Line::heading],
                  recording.sweeps.size()));
  const std::uint64_t triggers = counts[board::Line::trigger];
  if (plan.sweeps && recording.sweeps.size() < triggers) {
    fmt::print(stderr,
               "skerry: {} triggers have no sweep (blanked, or the board was too slow); their "
               "video is at rest\n",
               triggers - recording.sweeps.size());
  }
}

int run_signals(const SignalOptions& options) {
  auto client = options.place.connect();
  if (!client) return report_board(client.error());
  const auto facts = read_facts(*client, options.place);
  if (!facts) return report_board(facts.error());
  const auto plan = make_plan(options, *facts);
  if (!plan) return report(plan.error());
  const double samples = facts->samples[0] + facts->samples[1];
  const auto expected = [&](double per_second) {
    return static_cast<std::uint64_t>(per_second * plan->seconds);
  };
  const auto sizes =
      room_for(options, *plan, expected(facts->sample_clock_hz), facts->sample_clock_hz,
               expected(facts->triggers_per_second + facts->turns_per_second * facts->acp_per_turn),
               expected(facts->triggers_per_second * samples));
  if (!sizes) return kExitFailure;
  fmt::print(stderr, "# {:.1f} s, about: {}\n", plan->seconds, sizes->text);

  const auto begun = options.place.start(
      *client, plan->sweeps ? BoardStreamKind::records : BoardStreamKind::signals);
  if (!begun) return report_board(begun.error());
  auto recording = gather(*client, options, *plan);
  if (!recording) return kExitFailure;
  const bool cut = interrupted();
  if (cut) {
    fmt::print(stderr,
               "skerry: interrupted after {:.1f} of {:.1f} s; the files are whole, but "
               "shorter\n",
               recording->seconds(), plan->seconds);
  }
  const auto since = static_cast<std::int64_t>(recording->from_tick - facts->clocks);
  recording->utc_ns =
      facts->utc_ns + static_cast<std::uint64_t>(static_cast<std::int64_t>(
                          static_cast<double>(since) * 1e9 / facts->sample_clock_hz));
  recording->source = facts->source;
  if (!room_for(options, *plan, recording->ticks(), recording->sample_clock_hz,
                recording->edges.size(), count_video_samples(*recording))) {
    return kExitFailure;
  }
  write_summary(*recording, *plan);
  return FileWriter(options, *plan, *recording).write() && !cut ? kExitOk : kExitFailure;
}

}  // namespace

Command make_board_signals_command(CLI::App& board) {
  auto options = std::make_shared<SignalOptions>();
  CLI::App* command = board.add_subcommand(
      "signals", "Writes trigger, ACP, ARP, heading and video as files for bench generators");
  options->place.add_options(*command);
  options->place.add_stream_option(*command);
  CLI::Option* turns =
      command
          ->add_option("--turns", options->turns,
                       "Whole turns, from ARP to ARP; each begins a sample before its ARP")
          ->check(CLI::Range(1, 1000))
          ->capture_default_str();
  command->add_option("--seconds", options->seconds, "So long instead, from now on")
      ->check(number_within(1e-6, 3600.0))
      ->excludes(turns);
  command->add_option("--vcd", options->vcd,
                      "Value change dump of the digital lines, tick by tick");
  command->add_option("--wav", options->wav, "WAV (RF64 above 4 GiB), a channel for each signal");
  command->add_option("--sigmf", options->sigmf,
                      "SigMF: NAME-CHANNEL.sigmf-meta and -data, NAME.sigmf-collection");
  command->add_flag("--vcd-video", options->vcd_video, "The bits of video in the VCD too");
  command
      ->add_option("--rate", options->rate_hz,
                   "Samples per second of WAV and SigMF: 2MHz, 48kHz, 44100; default: the "
                   "sample clock.  Lower rates keep every pulse and the strongest echo")
      ->transform(CLI::AsNumberWithUnit(
          std::map<std::string, double>{{"hz", 1.0}, {"khz", 1e3}, {"mhz", 1e6}},
          CLI::AsNumberWithUnit::CASE_INSENSITIVE))
      ->check(number_within(1000.0, 1e9));
  command
      ->add_option("--channels", options->channels,
                   "Of WAV and SigMF: video_a, video_b, trigger, acp, arp, heading; default: all "
                   "that are on")
      ->delimiter(',')
      ->check(CLI::IsMember({"video_a", "video_b", "trigger", "acp", "arp", "heading"}));
  command->footer(
      "At least one of --vcd, --wav and --sigmf is needed.\n"
      "Samples have 16 bits: a line is 0 or 32767, video is the converter's code moved up below\n"
      "the sign (12 bits: times 8), and between sweeps the code of no echo.  Pulses last 1 us.\n"
      "Ctrl-C ends it early; the files are then whole, but shorter.\n"
      "Examples:\n"
      "  skerry board signals --vcd turn.vcd\n"
      "  sigrok-cli -I vcd:downsample=50 -i turn.vcd -O csv\n"
      "  skerry board signals --turns 2 --vcd f.vcd --wav f.wav --sigmf f --rate 2MHz\n"
      "  skerry board signals --seconds 0.1 --wav lines.wav --channels trigger,acp,arp\n"
      "  inspectrum f-video_a.sigmf-meta\n");
  command->callback([options] {
    if (options->vcd.empty() && options->wav.empty() && options->sigmf.empty()) {
      throw CLI::RequiredError("At least one of --vcd, --wav and --sigmf");
    }
  });
  return {command, [options] { return run_signals(*options); }};
}

}  // namespace skerry::client

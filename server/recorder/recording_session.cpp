#include "server/recorder/recording_session.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

#include "protocol/recording/inputs.pb.h"
#include "protocol/recording/recording.pb.h"
#include "server/recorder/traffic_message.hpp"

namespace skerry::server {
namespace {

using recording::Event;
using recording::Item;
using recording::Kind;
using recording::Topic;

constexpr int kSectorsAtOnce = 64;  // of a ring, before others have their turn
constexpr int kLastRounds = 16;
// While the disk is full; what is beyond is missing by its numbers, and marks have the other half.
constexpr std::size_t kMostEntriesKept = SeriesWriter::kMaxKept / 2;
constexpr std::chrono::seconds kShipsEvery{1};
constexpr std::chrono::seconds kRateTime{3};
// A playback may stand still; what is noted meanwhile is of about that time.
constexpr std::chrono::seconds kStandstill{1};

std::span<const std::uint8_t> bytes_of(const std::string& text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

// The present time of the video's source.
UtcTime present(RadarHost& host) {
  if (const PlaybackPort* playback = host.playback()) {
    const wire::PlaybackState state = playback->state();
    if (!state.current_timestamps()) {
      return UtcTime(Duration(static_cast<std::int64_t>(state.begin_utc_ns())) +
                     seconds_as_duration(state.position_s()));
    }
  }
  // An exercise's own, which follows the system's clock a moment later, or slowly.
  if (host.exercise() != nullptr) {
    return UtcTime(Duration(static_cast<std::int64_t>(host.own_ship(0).utc_ns())));
  }
  return std::chrono::time_point_cast<Duration>(std::chrono::system_clock::now());
}

}  // namespace

RecordingSession::RecordingSession(RadarHost& host, const RecorderConfig& config, DiskWriter& disk,
                                   Plan plan, const std::function<void()>& wake, Steady now)
    : host_(host),
      disk_(disk),
      plan_(std::move(plan)),
      begun_(now),
      now_(now),
      zero_(host.exercise() == nullptr ? std::nullopt : host.exercise()->zero()),
      clock_(present(host), now,
             host.playback() == nullptr ? Duration::max() : Duration(kStandstill),
             zero_ ? std::optional(zero_->now) : std::nullopt),
      readers_(host, {plan_.radars, plan_.all_views, config.format}, wake),
      writer_(config, disk, additions()) {
  writer_.begin(plan_.name, now);
  add_event(
      Event::STARTED,
      fmt::format("by {}: radars {}{}{}", plan_.origin, fmt::join(plan_.radars, ", "),
                  plan_.inputs_only ? ", inputs only" : "", plan_.all_views ? ", all views" : ""));
}

SeriesWriter::Additions RecordingSession::additions() {
  return {.file_begins = [this] { begin_file(); },
          .chunk_ends =
              [this] {
                const ExerciseInputs* exercise = host_.exercise();
                if (exercise == nullptr) return;
                // First: what comes between belongs to sectors beyond it.
                const std::vector<std::string> reached = exercise->reached();
                inputs_in_file_ = inputs_in_chunks_;
                add_inputs();
                inputs_in_chunks_ = inputs_next_;
                for (const std::string& input : reached) {
                  writer_.add({{Kind::input}, item_time(), bytes_of(input)});
                }
              },
          .quiet =
              [this] {
                // An exercise says with every chunk how far its inputs are known.
                if (host_.exercise() == nullptr) add_own_ships();
              },
          .chunk_lost =
              [this] {
                state_is_lost_ = true;
                for (const auto& reader : readers_) reader->settings_told = false;
                inputs_next_ = inputs_in_chunks_ = inputs_in_file_;
              }};
}

void RecordingSession::begin_file() {
  wire::Hello hello = host_.hello();
  auto* radars = hello.mutable_radars();
  radars->erase(std::remove_if(radars->begin(), radars->end(),
                               [&](const wire::RadarInfo& info) {
                                 return std::find(plan_.radars.begin(), plan_.radars.end(),
                                                  info.radar()) == plan_.radars.end();
                               }),
                radars->end());
  file_begins_ = true;
  readers_.file_begins();
  const UtcTime now = item_time();
  add({Kind::hello}, now, hello);
  if (const ExerciseInputs* exercise = host_.exercise()) {
    for (const ExerciseDocument& document : exercise->documents()) {
      writer_.attach({document.name, document.media_type, now, document.bytes});
    }
  }
  inputs_next_ = inputs_in_chunks_ = inputs_in_file_ = 0;
  add_inputs();
  if (zero_ && zero_->now != zero_->then) {
    recording::Input zero;
    zero.mutable_zero()->set_utc_ns(
        static_cast<std::uint64_t>(zero_->now.time_since_epoch().count()));
    add({Kind::input}, now, zero);
  }
  add_changes(true);
  add_ships();
  file_begins_ = false;
}

UtcTime RecordingSession::item_time() const {
  return file_begins_ ? clock_.before() : clock_.at(now_);
}

void RecordingSession::add(const Topic& topic, UtcTime time,
                           const google::protobuf::MessageLite& message) {
  message.SerializeToString(&bytes_);
  writer_.add({topic, time, bytes_of(bytes_)});
}

void RecordingSession::add_inputs() {
  const ExerciseInputs* exercise = host_.exercise();
  if (exercise == nullptr) return;
  for (auto some = exercise->since(inputs_next_); !some.empty();
       some = exercise->since(inputs_next_)) {
    for (const std::string& input : some) {
      writer_.add({{Kind::input}, item_time(), bytes_of(input)});
      ++inputs_next_;
    }
  }
}

void RecordingSession::add_changes(bool all) {
  if (plan_.inputs_only) return;
  const std::uint64_t settings = host_.settings_version(), world = host_.world_version();
  const UtcTime now = item_time();
  if (all || settings != settings_version_) {
    for (const auto& reader : readers_) add_settings(*reader, now);
  }
  if (all || world != world_version_) add({Kind::world}, now, host_.world());
  settings_version_ = settings;
  world_version_ = world;
}

void RecordingSession::add_settings(RingReader& reader, UtcTime time) {
  const wire::Settings settings = host_.settings(reader.radar(), reader.view());
  const VideoChannelPtr channel = host_.find_channel(reader.radar(), reader.view());
  if (channel == nullptr || !reader.is_of(*channel)) return;
  // Unless their chunk is lost.
  reader.settings_told = reader.settings_told || time <= clock_.before();
  add({Kind::settings, reader.radar(), reader.view()}, time, settings);
}

void RecordingSession::add_ships() {
  if (plan_.inputs_only) return;
  ships_told_ = now_;
  add_own_ships();
  add({Kind::traffic}, item_time(), traffic_message(host_.traffic()));
  if (auto exercise = host_.exercise_state()) {
    exercise->clear_played_marks();  // of the recording that is recorded anew: its, not this one's
    add_exercise(*exercise);
  }
}

void RecordingSession::add_own_ships() {
  for (const std::uint32_t radar : plan_.radars) {
    add({Kind::own_ship, radar}, item_time(), host_.own_ship(radar));
  }
}

void RecordingSession::add_targets() {
  const TargetPort* port = host_.targets();
  if (plan_.inputs_only || port == nullptr) return;
  for (const auto& reader : readers_) {
    const auto news = target_news_.take(*port, reader->radar(), reader->view());
    if (news.list) add({Kind::targets, reader->radar(), reader->view()}, item_time(), *news.list);
    if (news.plots) add({Kind::plots, reader->radar(), reader->view()}, item_time(), *news.plots);
  }
}

void RecordingSession::add_exercise(const wire::ExerciseState& exercise) {
  add({Kind::exercise}, item_time(), exercise);
  for (const wire::ExerciseMark& mark : exercise_marks_.take(exercise)) {
    Event event;
    event.set_kind(Event::MARK);
    event.set_text(mark.text());
    event.set_mark_kind(mark.kind());
    event.SerializeToString(&bytes_);
    writer_.keep({{Kind::event}, item_time(), bytes_of(bytes_)});
  }
}

void RecordingSession::add_event(Event::Kind kind, std::string text, const RingReader* of,
                                 std::uint64_t count) {
  Event event;
  event.set_kind(kind);
  event.set_text(std::move(text));
  event.set_count(count);
  if (of != nullptr) {
    event.set_radar(of->radar());
    event.set_view(of->view());
  }
  event.SerializeToString(&bytes_);
  writer_.keep({{Kind::event}, item_time(), bytes_of(bytes_)});
}

void RecordingSession::add_step(Duration by) {
  Event event;
  event.set_kind(Event::MARK);
  event.set_mark_kind("clock");
  event.set_text(fmt::format("the system's clock was set by {:+.3f} s", in_seconds(by)));
  event.SerializeToString(&bytes_);
  writer_.keep({{Kind::event}, item_time(), bytes_of(bytes_)});
}

bool RecordingSession::step(Steady now) {
  now_ = now;
  writer_.look_at_clock(now, clock_.at(now));
  look_at_views();
  const bool more = take_spokes();
  add_inputs();
  add_changes(std::exchange(state_is_lost_, false));
  if (now - ships_told_ >= kShipsEvery) add_ships();
  add_targets();
  writer_.look_at_clock(now, clock_.at(now));
  keep_rate(now);
  return more;
}

void RecordingSession::look_at_views() {
  readers_.look({
      .opened =
          [this](RingReader& reader) {
            add_settings(reader, clock_.before());
            add_event(Event::OTHER, "view opened", &reader);
          },
      .closed =
          [this](RingReader& reader) {
            // The view is closed, so this loop ends.
            while (take_spokes(reader, kSectorsAtOnce)) continue;
            add_event(Event::OTHER, "view closed", &reader);
          },
      .left_out =
          [this](std::uint32_t radar, std::uint32_t view) {
            add_event(Event::OTHER,
                      fmt::format("radar {} view {} and later ones are not in this file: it has "
                                  "{} views, which is the most",
                                  radar, view, ViewReaders::kMaxInFile));
          },
  });
}

bool RecordingSession::take_spokes() {
  bool more = false;
  for (const auto& reader : readers_) more = take_spokes(*reader, kSectorsAtOnce) || more;
  return more;
}

bool RecordingSession::take_spokes(RingReader& reader, int sectors) {
  for (; sectors > 0; --sectors) {
    const EncodedSectorPtr sector = reader.take();
    if (sector == nullptr) return false;
    take_sector(reader, *sector);
  }
  return true;
}

void RecordingSession::take_sector(RingReader& reader, const EncodedSector& sector) {
  if (const std::uint64_t lost = reader.newly_lost()) {
    lost_in_rings_ += lost;
    add_event(Event::LOST, "overwritten before they were taken", &reader, lost);
  }
  std::size_t begin = sector.begin;
  const std::span<const std::uint8_t> bytes(sector.bytes);
  for (const std::uint32_t end : sector.spoke_ends) {
    const auto spoke = framed_spoke(bytes.subspan(begin, end - begin));
    begin = end;
    if (!spoke) continue;
    const UtcTime time =
        clock_.saw({reader.radar(), reader.view()}, spoke->utc, spoke->scenario, now_);
    if (const auto step = clock_.stepped()) add_step(*step);
    if (!plan_.inputs_only) {
      if (!std::exchange(reader.settings_told, true)) add_settings(reader, time);
      writer_.add_spoke({Kind::spoke, reader.radar(), reader.view()}, time, spoke->bytes);
      continue;
    }
    ++spokes_hashed_;
    if (const auto checkpoint = checkpoints_.add(reader.radar(), reader.view(), *spoke)) {
      checkpoint->SerializeToString(&bytes_);
      writer_.keep({{Kind::input}, item_time(), bytes_of(bytes_)});
    }
  }
}

void RecordingSession::mark(const std::string& name, Steady now) {
  now_ = now;
  ++marks_;
  add_event(Event::MARK, name.empty() ? fmt::format("mark {}", marks_) : name);
}

void RecordingSession::log(int level, const std::string& text, Steady now) {
  now_ = now;
  recording::Log line;
  line.set_level(static_cast<std::uint32_t>(level));
  line.set_text(text);
  add({Kind::log}, clock_.at(now), line);
}

void RecordingSession::control_changed(const std::string& text, Steady now) {
  now_ = now;
  add_event(Event::CONTROL, text);
}

void RecordingSession::audit(const recording::AuditEntry& entry, Steady now) {
  now_ = now;
  entry.SerializeToString(&bytes_);
  writer_.keep({{Kind::audit}, item_time(), bytes_of(bytes_)}, kMostEntriesKept);
}

void RecordingSession::stop(const std::string& origin, Steady now) {
  now_ = now;
  look_at_views();
  for (int round = 0; round < kLastRounds && take_spokes(); ++round) continue;
  while (const auto checkpoint = checkpoints_.take()) {
    checkpoint->SerializeToString(&bytes_);
    writer_.keep({{Kind::input}, item_time(), bytes_of(bytes_)});
  }
  add_event(Event::STOPPED, "by " + origin);
  writer_.end(clock_.at(now));
}

void RecordingSession::keep_rate(Steady now) {
  if (!written_.empty() && now - written_.back().first < std::chrono::milliseconds(250)) return;
  written_.emplace_back(now, disk_.state().total_bytes);
  while (written_.size() > 2 && now - written_.front().first > kRateTime) written_.pop_front();
}

wire::RecorderState RecordingSession::state(Steady now) const {
  const DiskState disk = disk_.state();
  wire::RecorderState state;
  state.set_phase(disk.failed    ? wire::RecorderState::FAILED
                  : disk.is_full ? wire::RecorderState::DISK_FULL
                                 : wire::RecorderState::RECORDING);
  state.set_file(disk.file);
  state.set_file_bytes(disk.file_bytes);
  state.set_total_bytes(disk.total_bytes);
  state.set_problem(disk.problem);
  state.set_seconds(std::chrono::duration<double>(now - begun_).count());
  if (written_.size() > 1) {
    const auto& [from, from_bytes] = written_.front();
    const auto& [to, to_bytes] = written_.back();
    state.set_bytes_per_second(static_cast<double>(to_bytes - from_bytes) /
                               std::chrono::duration<double>(to - from).count());
  }
  const std::uint64_t dropped = writer_.spokes_dropped() + disk.spokes_lost;
  const std::uint64_t given = plan_.inputs_only ? spokes_hashed_ : writer_.spokes();
  state.set_spokes(given - std::min(given, dropped));
  state.set_spokes_lost(lost_in_rings_ + dropped);
  state.set_marks(marks_);
  state.set_inputs_only(plan_.inputs_only);
  state.set_all_views(plan_.all_views);
  return state;
}

}  // namespace skerry::server

#include "server/playback/play_request.hpp"

#include <fmt/format.h>
#include <google/protobuf/unknown_field_set.h>

#include <algorithm>
#include <cmath>

#include "server/relayed/sendable_text.hpp"

namespace skerry::server {
namespace {

constexpr double kSeekRounding = 1e-6;  // s: who was told the length may seek to it
constexpr std::size_t kMarksNamed = 8;  // in a refusal

Failure<wire::Reply> refuse(wire::Reply::Code code, std::string text) {
  wire::Reply reply;
  reply.set_code(code);
  reply.set_text(std::move(text));
  return Failure{std::move(reply)};
}

std::string marks_text(const recording::Summary& summary) {
  if (summary.marks.empty()) return "it has no marks";
  std::string text = "its marks:";
  const std::size_t named = std::min(summary.marks.size(), kMarksNamed);
  for (std::size_t i = 0; i < named; ++i) {
    text += fmt::format("{} \"{}\"", i == 0 ? "" : ",", sendable(summary.marks[i].name, 100));
  }
  if (named < summary.marks.size())
    text += fmt::format(" and {} more", summary.marks.size() - named);
  return text;
}

}  // namespace

std::string place_text(Duration since_begin) {
  const auto tenths = std::llround(in_seconds(since_begin) * 10.0);
  return fmt::format("{}:{:02}:{:02}.{}", tenths / 36'000, tenths / 600 % 60, tenths / 10 % 60,
                     tenths % 10);
}

Result<PlayOrder, wire::Reply> play_order(const wire::Playback& request,
                                          const recording::Summary& summary) {
  const auto& unknown = request.GetReflection()->GetUnknownFields(request);
  if (!unknown.empty()) {
    return refuse(wire::Reply::UNKNOWN, fmt::format("playback: this server knows no field {}",
                                                    unknown.field(0).number()));
  }
  const double length_s = in_seconds(summary.end - summary.begin);
  PlayOrder order;
  if (request.has_playing()) order.playing = request.playing();
  if (request.has_loop()) order.loop = request.loop();
  if (request.has_rate()) {
    // Written so that a NaN fails.
    if (!(request.rate() >= kSlowestRate && request.rate() <= kFastestRate)) {
      return refuse(wire::Reply::OUT_OF_RANGE,
                    fmt::format("rate: {} is out of range; allowed: {} to {}", request.rate(),
                                kSlowestRate, kFastestRate));
    }
    order.rate = request.rate();
  }
  if (request.has_position_s() && request.has_mark()) {
    return refuse(wire::Reply::OUT_OF_RANGE,
                  "playback: position_s and mark at once; expected one of them");
  }
  if (request.has_position_s()) {
    if (!(request.position_s() >= 0.0 && request.position_s() <= length_s + kSeekRounding)) {
      return refuse(wire::Reply::OUT_OF_RANGE,
                    fmt::format("position: {} s is out of range; the recording is {} s long",
                                request.position_s(), length_s));
    }
    order.seek = std::min(summary.begin + seconds_as_duration(request.position_s()), summary.end);
  }
  if (request.has_mark()) {
    const auto mark =
        std::find_if(summary.marks.begin(), summary.marks.end(),
                     [&](const recording::Mark& each) { return each.name == request.mark(); });
    if (mark == summary.marks.end()) {
      return refuse(wire::Reply::UNKNOWN,
                    fmt::format("mark: there is no \"{}\" in the recording; {}",
                                sendable(request.mark(), 100), marks_text(summary)));
    }
    order.seek = std::clamp(mark->time, summary.begin, summary.end);
  }
  if (request.has_step_turns()) {
    const int turns = request.step_turns();
    if (turns < -kMostSteps || turns > kMostSteps) {
      return refuse(wire::Reply::OUT_OF_RANGE,
                    fmt::format("step: {} turns are out of range; allowed: {} to {}", turns,
                                -kMostSteps, kMostSteps));
    }
    if (turns != 0 && request.playing()) {
      return refuse(wire::Reply::OUT_OF_RANGE,
                    "playback: a step ends in a pause; leave out one of step_turns and playing");
    }
    order.steps = turns;
  }
  return order;
}

}  // namespace skerry::server

#include "clients/recording/position.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "protocol/wire/printable_text.hpp"

namespace skerry::client {
namespace {

// Marks named in a refusal.
constexpr std::size_t kMarksInRefusal = 8;

std::string marks_text(const recording::Summary& summary) {
  if (summary.marks.empty()) return "it has no marks";
  std::string text = "its marks are";
  for (std::size_t i = 0; i < std::min(summary.marks.size(), kMarksInRefusal); ++i) {
    text += fmt::format("{} \"{}\"", i == 0 ? "" : ",", printable(summary.marks[i].name, 100));
  }
  if (summary.marks.size() > kMarksInRefusal) {
    text += fmt::format(" and {} more", summary.marks.size() - kMarksInRefusal);
  }
  return text;
}

}  // namespace

Result<UtcTime, std::string> find_position(std::string_view text,
                                           const recording::Summary& summary) {
  const auto position = recording::parse_position(text);
  if (!position) return Failure{printable(position.error())};
  if (position->is_mark()) {
    const auto mark = std::find_if(summary.marks.begin(), summary.marks.end(),
                                   [&](const auto& each) { return each.name == position->mark; });
    if (mark != summary.marks.end()) return mark->time;
    return Failure{fmt::format("{} has no mark \"{}\"; {}", printable(summary.file),
                               printable(position->mark, 100), marks_text(summary))};
  }
  if (const Duration length = summary.end - summary.begin; position->since_begin > length) {
    return Failure{fmt::format("position {} lies behind the end of {}, which is at {}",
                               playing_time_text(position->since_begin), printable(summary.file),
                               playing_time_text(length))};
  }
  return summary.begin + position->since_begin;
}

std::string playing_time_text(Duration since_begin) {
  const auto ms = std::chrono::duration_cast<std::chrono::milliseconds>(since_begin).count();
  const auto minutes = ms / 60'000;
  const double seconds = static_cast<double>(ms % 60'000) * 1e-3;
  if (minutes < 60) return fmt::format("{}:{:06.3f}", minutes, seconds);
  return fmt::format("{}:{:02}:{:06.3f}", minutes / 60, minutes % 60, seconds);
}

}  // namespace skerry::client

#include "protocol/recording/open_recording.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "protocol/recording/packed_spokes.hpp"

namespace skerry::recording {
namespace {

// The summary's, or what a search finds.  Error: it is no recording, or was given up.
Result<FileIndex, RecordingError> index_of(const InputFile& file,
                                           const RecordingReader::Progress& progress) {
  const auto beginning = read_beginning(file);
  auto summary = read_summary(file);
  if (summary) {
    if (!beginning) summary.value().damage = beginning.error();
    return summary;
  }
  if (!beginning && beginning.error().offset == 0) return Failure{beginning.error()};
  auto found = search(file, progress);
  if (!found) return found;
  if (!found.value().damage) {
    found.value().damage = beginning ? summary.error() : beginning.error();
  }
  return found;
}

UtcTime bounded(UtcTime time) { return std::clamp(time, UtcTime(), kLatestTime); }

}  // namespace

OpenRecording::OpenRecording(InputFile the_file, FileIndex the_index)
    : file(std::move(the_file)), index(std::move(the_index)) {
  for (const auto& [number, kind] : index.channels) {
    if (kind.packed) packed_span = kMaxPackedSpan.count();
  }
  by_start.resize(index.chunks.size());
  std::iota(by_start.begin(), by_start.end(), 0U);
  std::stable_sort(by_start.begin(), by_start.end(), [&](std::uint32_t a, std::uint32_t b) {
    return index.chunks[a].start < index.chunks[b].start;
  });
  std::int64_t furthest = 0;
  for (const std::uint32_t number : by_start) {
    furthest = std::max(furthest, reach(number));
    reaches.push_back(furthest);
  }
}

std::int64_t OpenRecording::reach(std::size_t number) const {
  constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();
  const std::int64_t end = index.chunks[number].end;
  return end > kMost - packed_span ? kMost : end + packed_span;
}

bool OpenRecording::has(std::size_t number, const std::set<Topic>& topics) const {
  if (topics.empty()) return true;
  const auto channels = index.channels_of(index.chunks[number]);
  // Without an index of its messages there may be anything.
  return channels.empty() || std::any_of(channels.begin(), channels.end(), [&](std::uint16_t id) {
           const auto kind = index.channels.find(id);
           return kind != index.channels.end() && topics.contains(kind->second.topic);
         });
}

std::size_t OpenRecording::first_reaching(std::int64_t time) const {
  return static_cast<std::size_t>(std::lower_bound(reaches.begin(), reaches.end(), time) -
                                  reaches.begin());
}

Result<std::shared_ptr<const OpenRecording>, RecordingError> open_recording(
    const std::string& path, const RecordingReader::Progress& progress) {
  auto file = InputFile::open(path);
  if (!file) return Failure{file.error()};
  auto index = index_of(*file, progress);
  if (!index) return Failure{index.error()};
  const auto recording =
      std::make_shared<OpenRecording>(std::move(file.value()), std::move(index.value()));
  if (auto error = summarise(*recording, progress)) return Failure{*std::move(error)};
  Summary& made = recording->summary;
  made.begin = bounded(made.begin);
  made.end = bounded(made.end);
  for (Mark& mark : made.marks) mark.time = bounded(mark.time);
  return std::shared_ptr<const OpenRecording>(recording);
}

}  // namespace skerry::recording

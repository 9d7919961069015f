#include "server/plotter/judge/judging.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "server/plotter/judge/baselines/mayara.hpp"
#include "server/plotter/judge/baselines/radar_pi.hpp"
#include "server/plotter/judge/own_tracker.hpp"
#include "server/plotter/judge/scans_jsonl.hpp"
#include "server/plotter/judge/target_log.hpp"
#include "server/plotter/judge/tracks_csv.hpp"
#include "server/plotter/judge/truth_csv.hpp"

namespace skerry::server {
namespace {

std::string text_of_file(const std::string& file) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> in(std::fopen(file.c_str(), "rb"),
                                                           std::fclose);
  const auto fail = [&](int number) {
    throw std::runtime_error(
        fmt::format("cannot read {}: {}", file, std::generic_category().message(number)));
  };
  if (!in) fail(errno);
  std::string text;
  std::string part(1 << 20, '\0');
  errno = 0;
  while (const std::size_t size = std::fread(part.data(), 1, part.size(), in.get())) {
    text.append(part, 0, size);
    if (text.size() > kMostFileOctets)
      throw std::runtime_error(fmt::format("{}: more than {} MB; expected a shorter part of it",
                                           file, kMostFileOctets >> 20));
  }
  if (std::ferror(in.get()) != 0) fail(errno);
  return text;
}

void require_known(const std::vector<std::string>& baselines) {
  for (const std::string& name : baselines) {
    if (std::find(std::begin(kBaselines), std::end(kBaselines), name) == std::end(kBaselines))
      throw std::invalid_argument(
          fmt::format("no baseline \"{}\"; expected {}", name, fmt::join(kBaselines, ", ")));
  }
}

}  // namespace

bool is_tracks_csv(std::string_view text, std::string_view file) {
  if (file.ends_with(".csv") || file.ends_with(".CSV")) return true;
  const std::string_view first = text.substr(0, text.find('\n'));
  return first.find("utc_s") != std::string_view::npos ||
         first.find("lat_deg") != std::string_view::npos;
}

Judged judge_trackers(const JudgeRequest& request) {
  require_known(request.baselines);
  if (request.truth.empty() && request.scans.empty())
    throw std::invalid_argument("no truth; expected a file of truth, or scans with it");
  if (request.scans.empty() && !request.baselines.empty())
    throw std::invalid_argument("baselines need scans; expected a file of scans for them");
  if (request.told.empty() && request.baselines.empty())
    throw std::invalid_argument("nothing to judge; expected a file of tracks, or baselines");
  Judged out;
  ReadScans scans;
  if (!request.scans.empty()) {
    scans = read_scans_jsonl(text_of_file(request.scans), request.scans);
    out.notes.push_back(fmt::format("{}: {}", request.scans, scans.notes.text()));
    out.truth = scans.truth;
  }
  if (!request.truth.empty()) {
    ReadTruth read = read_truth_csv(text_of_file(request.truth), request.truth);
    out.notes.push_back(fmt::format("{}: {}", request.truth, read.notes.text()));
    out.truth = std::move(read.truth);
  }
  for (const std::string& file : request.told) {
    const std::string text = text_of_file(file);
    if (is_tracks_csv(text, file)) {
      ReadTracks read = read_tracks_csv(text, file);
      out.notes.push_back(fmt::format("{}: {}", file, read.notes.text()));
      std::move(read.told.begin(), read.told.end(), std::back_inserter(out.told));
    } else {
      ReadTargets read = read_target_log(text, file, out.truth);
      out.notes.push_back(fmt::format("{}: {}", file, read.notes.text()));
      out.told.push_back(std::move(read.told));
      // Without a truth of own ship its own log is the next best for CPA.
      if (out.truth.own_ship.empty()) out.truth.own_ship = std::move(read.own_ship);
    }
  }
  for (const std::string& name : request.baselines)
    out.told.push_back(name == "skerry"   ? skerry_tracks(scans.scans)
                       : name == "mayara" ? baseline_mayara(scans.scans)
                                          : baseline_radar_pi(scans.scans));
  for (const Told& told : out.told)
    out.scores.push_back(track_score(out.truth, told, request.rule));
  return out;
}

}  // namespace skerry::server

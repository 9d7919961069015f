#include "server/net/outputs/target_reports.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>

#include "protocol/quantity/speed.hpp"

namespace skerry::server {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

std::optional<Duration> time_of_day_at(std::uint64_t utc_ns) {
  if (utc_ns == 0) return std::nullopt;
  return asterix_time_of_day(UtcTime(Duration(static_cast<std::int64_t>(utc_ns))));
}

AsterixVector vector_of(double length, double direction_deg) {
  return {length * std::sin(direction_deg * kDegree), length * std::cos(direction_deg * kDegree)};
}

// One target in the words that the categories share.
struct TrackWords {
  AsterixPolar polar;
  PlanePoint plane;  // from the radar
  GeoPoint place;
  std::optional<AsterixVelocity> velocity;  // over ground
  std::optional<AsterixVector> plane_velocity;
  double place_sigma_m, speed_sigma_mps;
  double course_sigma_deg;  // 0 without a velocity
  std::optional<AsterixSize> size;
  bool is_tentative;
  bool is_extrapolated;  // not where it was seen in this turn
};

TrackWords words_of(const ReportedTrack& track, const ReportedTargets& news) {
  const wire::Target& target = track.target;
  TrackWords words{.polar = {target.range_m(), target.bearing_deg()},
                   .plane = {},
                   .place = {target.latitude_deg(), target.longitude_deg()},
                   .velocity = {},
                   .plane_velocity = {},
                   .place_sigma_m = target.place_sigma_m(),
                   .speed_sigma_mps = target.speed_sigma_kn() * kKnot,
                   .course_sigma_deg = 0.0,
                   .size = {},
                   .is_tentative = target.state() == wire::TARGET_ACQUIRING,
                   .is_extrapolated = track.is_ended || target.state() == wire::TARGET_FROZEN ||
                                      target.age_s() > news.extrapolated_after_s};
  const AsterixVector from_radar = vector_of(target.range_m(), target.bearing_deg());
  words.plane = {from_radar.east, from_radar.north};
  if (news.list->stabilisation() == wire::STABILISATION_GROUND && target.has_course_deg() &&
      target.has_speed_kn()) {
    const double speed_mps = target.speed_kn() * kKnot;
    words.velocity = {speed_mps, target.course_deg()};
    words.plane_velocity = vector_of(speed_mps, target.course_deg());
    words.course_sigma_deg = std::atan2(words.speed_sigma_mps, speed_mps) / kDegree;
  }
  // Whither its bow points is not known, so there is no width either.
  if (target.length_m() > 0.0) words.size = AsterixSize{.length_m = target.length_m()};
  return words;
}

AsterixPolar polar_of(const wire::TargetPlot& plot) { return {plot.range_m(), plot.bearing_deg()}; }

Cat048Report cat048_plot(const wire::TargetPlot& plot, const ReportedTargets& news) {
  Cat048Report report{.source = news.source,
                      .time_of_day = time_of_day_at(plot.utc_ns()),
                      .measured = polar_of(plot)};
  if (plot.length_m() > 0.0 && plot.range_m() > 0.0) {
    report.run_length_deg = 2.0 * std::atan2(plot.length_m() / 2.0, plot.range_m()) / kDegree;
  }
  return report;
}

Cat048Report cat048_track(const ReportedTrack& track, const ReportedTargets& news) {
  const TrackWords words = words_of(track, news);
  Cat048Report report{
      .source = news.source,
      .time_of_day = time_of_day_at(news.list->utc_ns()),
      .detection = words.is_extrapolated ? Cat048Detection::none : Cat048Detection::primary,
      .is_test = track.target.is_test(),
      .measured = words.polar,
      .track_number = track.number,
      .position = words.plane,
      .velocity = words.velocity,
      .status = Cat048TrackStatus{.is_tentative = words.is_tentative, .is_ended = track.is_ended}};
  if (words.velocity && words.place_sigma_m > 0.0) {
    report.quality = Cat048Quality{words.place_sigma_m, words.place_sigma_m, words.speed_sigma_mps,
                                   words.course_sigma_deg};
  }
  return report;
}

Cat062Report cat062_track(const ReportedTrack& track, const ReportedTargets& news) {
  const TrackWords words = words_of(track, news);
  Cat062Report report{.source = news.source,
                      .time_of_day = time_of_day_at(news.list->utc_ns()),
                      .place = words.place,
                      .velocity = words.plane_velocity,
                      .track_number = static_cast<std::uint16_t>(track.number),
                      .status = {.is_tentative = words.is_tentative,
                                 .is_ended = track.is_ended,
                                 .is_new = track.is_new,
                                 .is_coasting = words.is_extrapolated},
                      .track_age_s = track.target.tracked_s(),
                      .primary_age_s = track.target.age_s(),
                      .size = words.size};
  if (words.place_sigma_m > 0.0) {
    report.position_deviation = AsterixVector{words.place_sigma_m, words.place_sigma_m};
  }
  if (words.velocity && words.speed_sigma_mps > 0.0) {
    report.velocity_deviation = AsterixVector{words.speed_sigma_mps, words.speed_sigma_mps};
  }
  return report;
}

Cat010Report cat010_message(Cat010Kind kind, const ReportedTargets& news) {
  return {.source = news.source, .kind = kind, .time_of_day = time_of_day_at(news.list->utc_ns())};
}

Cat010Report cat010_plot(const wire::TargetPlot& plot, const ReportedTargets& news) {
  Cat010Report report{
      .source = news.source,
      .time_of_day = time_of_day_at(plot.utc_ns()),
      .place = GeoPoint{plot.latitude_deg(), plot.longitude_deg()},
      .measured = polar_of(plot),
      .amplitude = static_cast<std::uint8_t>(std::min<std::uint32_t>(plot.level(), 255))};
  const double length_m = std::max(plot.length_m(), plot.width_m());
  if (length_m > 0.0) report.size = AsterixSize{.length_m = length_m};
  return report;
}

Cat010Report cat010_track(const ReportedTrack& track, const ReportedTargets& news) {
  const TrackWords words = words_of(track, news);
  Cat010Report report{.source = news.source,
                      .is_test = track.target.is_test(),
                      .time_of_day = time_of_day_at(news.list->utc_ns()),
                      .place = words.place,
                      .measured = words.polar,
                      .position = words.plane,
                      .velocity = words.velocity,
                      .plane_velocity = words.plane_velocity,
                      .track_number = track.number,
                      .status = Cat010TrackStatus{.is_tentative = words.is_tentative,
                                                  .is_ended = track.is_ended,
                                                  .extrapolation = words.is_extrapolated
                                                                       ? Cat010Extrapolation::missed
                                                                       : Cat010Extrapolation::none},
                      .size = words.size};
  if (words.place_sigma_m > 0.0) {
    report.deviation = Cat010Deviation{words.place_sigma_m, words.place_sigma_m, 0.0};
  }
  return report;
}

// A report of each plot, if `of_plot` is given, and of each track.
template <typename Report>
void append_reports(const ReportedTargets& news,
                    Report (*of_plot)(const wire::TargetPlot&, const ReportedTargets&),
                    Report (*of_track)(const ReportedTrack&, const ReportedTargets&),
                    std::vector<Report>& out) {
  if (news.plots != nullptr) {
    for (const wire::TargetPlot& plot : news.plots->plots()) out.push_back(of_plot(plot, news));
  }
  if (news.list == nullptr) return;
  for (const ReportedTrack& track : news.tracks) out.push_back(of_track(track, news));
}

}  // namespace

std::vector<ReportedTrack> ToldTracks::next(const wire::TargetList& list) {
  std::vector<ReportedTrack> tracks;
  std::set<std::uint32_t> listed;
  for (const wire::Target& target : list.targets()) {
    listed.insert(target.number());
    const auto before = told_.find(target.number());
    const bool is_known = before != told_.end() && !before->second.is_ended;
    const bool is_lost = target.state() == wire::TARGET_LOST;
    if (is_lost && !is_known) continue;
    Told& told = told_[target.number()];
    if (told.number == 0) told.number = free_number(target.number());
    told.is_ended = is_lost;
    told.target = target;
    tracks.push_back({target, told.number, !is_known, is_lost});
  }
  for (auto it = told_.begin(); it != told_.end();) {
    if (listed.contains(it->first)) {
      ++it;
      continue;
    }
    if (!it->second.is_ended) {
      tracks.push_back({std::move(it->second.target), it->second.number, false, true});
    }
    it = told_.erase(it);
  }
  return tracks;
}

unsigned ToldTracks::free_number(std::uint32_t number) const {
  std::set<unsigned> taken;
  for (const auto& [of, told] : told_) taken.insert(told.number);
  unsigned wrapped = (number - 1) % most_ + 1;
  for (unsigned tried = 0; taken.contains(wrapped) && tried < most_; ++tried) {
    wrapped = wrapped % most_ + 1;
  }
  return wrapped;
}

std::vector<Cat048Report> cat048_reports(const ReportedTargets& news) {
  std::vector<Cat048Report> reports;
  append_reports(news, cat048_plot, cat048_track, reports);
  return reports;
}

std::vector<Cat062Report> cat062_reports(const ReportedTargets& news) {
  std::vector<Cat062Report> reports;
  if (news.list == nullptr) return reports;
  for (const ReportedTrack& track : news.tracks) {
    if (!track.target.is_test()) reports.push_back(cat062_track(track, news));
  }
  return reports;
}

std::vector<Cat010Report> cat010_reports(const ReportedTargets& news) {
  std::vector<Cat010Report> reports;
  if (news.list != nullptr) {
    reports.push_back(cat010_message(Cat010Kind::turn, news));
    Cat010Report status = cat010_message(Cat010Kind::periodic_status, news);
    constexpr std::uint8_t kWorks = 0, kDegraded = 1;
    status.system_status =
        Cat010SystemStatus{.release = news.list->problem().empty() ? kWorks : kDegraded};
    reports.push_back(status);
  }
  append_reports(news, cat010_plot, cat010_track, reports);
  return reports;
}

}  // namespace skerry::server

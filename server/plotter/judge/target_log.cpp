#include "server/plotter/judge/target_log.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "protocol/nmea/gnss_sentences.hpp"
#include "protocol/nmea/log_line.hpp"
#include "protocol/nmea/position_sentences.hpp"
#include "protocol/nmea/radar_sentences.hpp"
#include "protocol/nmea/tracked_target_data.hpp"
#include "protocol/quantity/angle.hpp"
#include "protocol/quantity/length.hpp"
#include "server/plotter/judge/place_series.hpp"

namespace skerry::server {
namespace {

constexpr double kDay_s = 86'400.0;
constexpr double kNewTrack_s = 60.0;  // untold for so long, a number is free again
constexpr double kFixHolds_s = 5.0;   // before the first fix and after the last
constexpr double kSameTold_s = 0.5;   // TTM and TLL of one state

// A target as it was told: its place, or where it is from own ship.
struct Heard {
  unsigned number = 0;
  ToldPoint point;
  bool has_place = false;
  double range_m = 0.0, bearing_deg = 0.0;
  std::size_t line = 0;
};

ToldStatus status_heard(nmea::TargetStatus status) {
  switch (status) {
    case nmea::TargetStatus::lost:
      return ToldStatus::lost;
    case nmea::TargetStatus::acquiring:
      return ToldStatus::tentative;
    case nmea::TargetStatus::tracking:
      break;
  }
  return ToldStatus::tracked;
}

// Nothing for a target that is not there.
std::optional<ToldStatus> status_heard(nmea::TtdStatus status) {
  switch (status) {
    case nmea::TtdStatus::acquiring:
      return ToldStatus::tentative;
    case nmea::TtdStatus::lost:
      return ToldStatus::lost;
    case nmea::TtdStatus::tracking:
    case nmea::TtdStatus::tracking_alarm:
    case nmea::TtdStatus::tracking_confirmed:
      return ToldStatus::tracked;
    case nmea::TtdStatus::not_tracking:
      break;
  }
  return std::nullopt;
}

class TargetLog {
 public:
  explicit TargetLog(const Truth& truth) : truth_(truth) {
    if (!truth.own_ship.empty()) clock_s_ = truth.own_ship.front().utc_s;
    for (const TruthTarget& target : truth.targets)
      if (!target.points.empty() && !clock_s_) clock_s_ = target.points.front().utc_s;
  }

  void line(std::string_view text, std::size_t number) {
    if (text.empty()) return;
    out_.notes.line();
    line_ = number;
    const auto line = nmea::parse_log_line(text);
    if (!line) return leave_out("", line.error());
    if (line->utc) clock_s_ = in_seconds(line->utc->time_since_epoch());
    const auto sentence = nmea::parse_sentence(line->sentence);
    if (!sentence) return leave_out("", sentence.error());
    if (sentence->formatter == "TTM") return ttm(*sentence);
    if (sentence->formatter == "TLL") return tll(*sentence);
    if (sentence->formatter == "TTD") return ttd(*sentence);
    if (sentence->formatter == "RMC") return rmc(*sentence);
    if (sentence->formatter == "GGA") return fix(*sentence, nmea::decode_gga(*sentence));
    if (sentence->formatter == "GLL") return fix(*sentence, nmea::decode_gll(*sentence));
    if (sentence->formatter == "GNS") return fix(*sentence, nmea::decode_gns(*sentence));
    if (sentence->formatter == "ZDA") return zda(*sentence);
    out_.notes.leave_out("sentences of other kinds", number, text);
  }

  ReadTargets finish(std::string_view file) {
    place_all();
    out_.told.name = file;
    for (auto& [key, track] : tracks_) out_.told.tracks.push_back(std::move(track));
    if (out_.told.tracks.empty())
      throw std::runtime_error(
          fmt::format("{}:1: no target; expected TTM, TLL or TTD sentences with times, and RMC, "
                      "GGA or GLL or an own ship in the truth for ranges and bearings ({})",
                      file, out_.notes.text()));
    return std::move(out_);
  }

 private:
  void leave_out(std::string_view formatter, const WireError& error) {
    const std::string kind =
        formatter.empty() ? fmt::format("lines that are no sentence, {}", name_of(error.kind))
                          : fmt::format("{} {}", formatter, name_of(error.kind));
    out_.notes.leave_out(kind, line_, error.text);
  }

  // That of the sentence, on the day that is nearest to the clock.
  std::optional<double> time_of(std::optional<Duration> of_day) {
    if (!of_day || !clock_s_) return clock_s_;
    const double midnight_s = std::floor(*clock_s_ / kDay_s) * kDay_s;
    double utc_s = midnight_s + in_seconds(*of_day);
    if (utc_s - *clock_s_ > kDay_s / 2.0) utc_s -= kDay_s;
    if (*clock_s_ - utc_s > kDay_s / 2.0) utc_s += kDay_s;
    clock_s_ = utc_s;
    return utc_s;
  }

  void hear(Heard heard, std::optional<double> utc_s) {
    if (!utc_s) {
      out_.notes.leave_out("targets before any time", line_);
      return;
    }
    if (heard_.size() >= kMostPoints) {
      out_.notes.leave_out("targets beyond the most", line_);
      return;
    }
    heard.point.utc_s = *utc_s;
    heard.line = line_;
    heard_.push_back(heard);
  }

  void ttm(const nmea::Sentence& sentence) {
    const auto ttm = nmea::decode_ttm(sentence);
    if (!ttm) return leave_out("TTM", ttm.error());
    Heard heard{ttm->number,      {}, false, nautical_miles(ttm->range_nm).in_metres(),
                ttm->bearing_deg, 0};
    heard.point.status = status_heard(ttm->status);
    if (ttm->speed_kn && ttm->course_deg) {
      heard.point.speed_kn = ttm->speed_kn;
      heard.point.course_deg = ttm->course_deg;
    }
    heard.point.cpa_nm = ttm->cpa_nm;
    heard.point.tcpa_min = ttm->tcpa_min;
    hear(heard, time_of(ttm->time_of_day));
  }

  void tll(const nmea::Sentence& sentence) {
    const auto tll = nmea::decode_tll(sentence);
    if (!tll) return leave_out("TLL", tll.error());
    Heard heard{tll->number, {}, true, 0.0, 0.0, 0};
    heard.point.status = status_heard(tll->status);
    heard.point.place = tll->position;
    hear(heard, time_of(tll->time_of_day));
  }

  void ttd(const nmea::Sentence& sentence) {
    const auto targets = nmea::decode_ttd(sentence);
    if (!targets) return leave_out("TTD", targets.error());
    for (const nmea::TtdTarget& target : *targets) {
      const auto status = status_heard(target.status);
      if (!status || !target.range_nm || !target.bearing_deg) {
        out_.notes.leave_out("TTD targets without a place", line_);
        continue;
      }
      Heard heard{target.number,       {}, false, nautical_miles(*target.range_nm).in_metres(),
                  *target.bearing_deg, 0};
      heard.point.status = *status;
      if (target.speed_kn && target.course_deg) {
        heard.point.speed_kn = target.speed_kn;
        heard.point.course_deg = target.course_deg;
      }
      hear(heard, clock_s_);
    }
  }

  void fixed(std::optional<double> utc_s, const std::optional<GeoPoint>& position, bool valid) {
    if (utc_s && position && valid && out_.own_ship.size() < kMostPoints) {
      out_.own_ship.push_back({*utc_s, *position, {}, {}});
      out_.notes.use();
    } else {
      out_.notes.leave_out("positions that are not valid or have no time", line_);
    }
  }

  void rmc(const nmea::Sentence& sentence) {
    const auto rmc = nmea::decode_rmc(sentence);
    if (!rmc) return leave_out("RMC", rmc.error());
    if (rmc->utc) clock_s_ = in_seconds(rmc->utc->time_since_epoch());
    fixed(clock_s_, rmc->position, rmc->valid);
  }

  void zda(const nmea::Sentence& sentence) {
    const auto zda = nmea::decode_zda(sentence);
    if (!zda) return leave_out("ZDA", zda.error());
    if (zda->utc) clock_s_ = in_seconds(zda->utc->time_since_epoch());
    out_.notes.use();
  }

  static bool is_valid(const nmea::Gga& gga) { return gga.quality != 0; }
  static bool is_valid(const nmea::Gll& gll) { return gll.valid; }
  static bool is_valid(const nmea::Gns& gns) {
    return gns.modes.find_first_not_of('N') != std::string::npos;
  }
  template <typename Fix>
  void fix(const nmea::Sentence& sentence, const Result<Fix, WireError>& decoded) {
    if (!decoded) return leave_out(sentence.formatter, decoded.error());
    fixed(time_of(decoded->time_of_day), decoded->position, is_valid(*decoded));
  }

  void place_all() {
    const GeoPoint about = !out_.own_ship.empty()     ? out_.own_ship.front().place
                           : !truth_.own_ship.empty() ? truth_.own_ship.front().place
                                                      : GeoPoint{};
    const echo::LocalPlane plane(about);
    const TruthSeries own(out_.own_ship, plane, kFixHolds_s);
    const TruthSeries true_own(truth_.own_ship, plane, kFixHolds_s);
    for (Heard& heard : heard_) {
      if (!heard.has_place) {
        auto from = own.at(heard.point.utc_s);
        if (!from) from = true_own.at(heard.point.utc_s);
        if (!from) {
          out_.notes.leave_out("ranges and bearings without own ship's place", heard.line);
          continue;
        }
        const double bearing = heard.bearing_deg * kRadiansPerDegree;
        const PlanePoint away = PlanePoint{std::sin(bearing), std::cos(bearing)} * heard.range_m;
        heard.point.place = echo::LocalPlane(plane.to_geo(from->place)).to_geo(away);
      }
      add(heard);
    }
  }

  void add(const Heard& heard) {
    Number& number = numbers_[heard.number];
    const double since_s = heard.point.utc_s - number.last_s;
    const bool again = number.uses > 0 && std::fabs(since_s) <= kSameTold_s;
    if (number.uses == 0 || since_s > kNewTrack_s || (number.lost && !again)) {
      if (tracks_.size() >= kMostTracks) {
        out_.notes.leave_out("tracks beyond the most", heard.line);
        return;
      }
      ++number.uses;
      number.lost = false;
    }
    ToldTrack& track = tracks_[{heard.number, number.uses}];
    track.number = number.uses == 1 ? fmt::format("{}", heard.number)
                                    : fmt::format("{}/{}", heard.number, number.uses);
    out_.notes.use();
    number.lost = number.lost || heard.point.status == ToldStatus::lost;
    // TTM and TLL of one state: the place with more digits, and the motion.
    if (again && !track.points.empty()) {
      ToldPoint& told = track.points.back();
      if (heard.has_place) told.place = heard.point.place;
      if (heard.point.speed_kn) {
        told.speed_kn = heard.point.speed_kn;
        told.course_deg = heard.point.course_deg;
      }
      if (heard.point.cpa_nm) told.cpa_nm = heard.point.cpa_nm;
      if (heard.point.tcpa_min) told.tcpa_min = heard.point.tcpa_min;
      told.status = heard.point.status;
      return;
    }
    track.points.push_back(heard.point);
    number.last_s = heard.point.utc_s;
  }

  struct Number {
    double last_s = -std::numeric_limits<double>::infinity();
    std::size_t uses = 0;
    bool lost = false;
  };

  const Truth& truth_;
  std::optional<double> clock_s_;
  std::size_t line_ = 0;
  std::vector<Heard> heard_;
  std::map<unsigned, Number> numbers_;
  std::map<std::pair<unsigned, std::size_t>, ToldTrack> tracks_;
  ReadTargets out_;
};

}  // namespace

ReadTargets read_target_log(std::string_view text, std::string_view file, const Truth& truth) {
  TargetLog log(truth);
  for_each_line(text, [&](std::string_view line, std::size_t number) { log.line(line, number); });
  return log.finish(file);
}

}  // namespace skerry::server

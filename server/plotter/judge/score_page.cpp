#include "server/plotter/judge/score_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "server/page/html_text.hpp"
#include "server/page/page_frame.hpp"
#include "server/page/plot_figure.hpp"
#include "server/plotter/judge/scene_figure.hpp"

namespace skerry::server {
namespace {

constexpr std::size_t kMostPlotCurves = 8, kMostRows = 500;
// Between two errors so far apart the target had no track, s.
constexpr double kUntracked_s = 12.0;

std::string cell_of(std::optional<double> value, int decimals) {
  return value ? fmt::format("{:.{}f}", *value, decimals) : "–";
}

class PageOfScores {
 public:
  PageOfScores(const ScorePage& page, const Truth& truth, std::span<const Told> told,
               std::span<const SceneScore> scores)
      : page_(page), truth_(truth), told_(told), scores_(scores) {
    for (const SceneScore& score : scores) {
      first_s_ = std::min(first_s_, score.first_s);
      for (const StepScore& step : score.steps) last_s_ = std::max(last_s_, step.utc_s);
    }
  }

  std::string html() {
    out_ = fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
        "content=\"width=device-width,initial-scale=1\"><title>{}</title><style>{}</style></head>"
        "<body>\n<h1>{}</h1>\n",
        escaped(page_.title), kPageStyle, escaped(page_.title));
    for (const std::string& note : page_.notes)
      out_ += fmt::format("<p class=\"soft\">{}</p>\n", escaped(note));
    out_ += "<section><h2>Trackers</h2>\n";
    trackers();
    distances();
    out_ += "</section>\n";
    for (std::size_t i = 0; i < scores_.size(); ++i) tracker(i);
    return out_ + fmt::format("<script>{}</script>\n</body></html>\n", kPageScript);
  }

 private:
  void trackers() {
    HtmlTable table({"tracker", "#OSPA m", "#GOSPA m", "#missed", "#made up", "#tracked %",
                     "#untracked", "#swaps", "#breaks", "#false/h", "#false %", "#5 of 10 %"});
    for (const SceneScore& score : scores_) {
      table.begin_row();
      table.add_html("<span style=\"white-space:nowrap\">" + escaped(short_name(score.name, 40)) +
                     "</span>");
      table.add(cell_of(score.mean_ospa_m, 1));
      table.add(cell_of(score.mean_gospa_m, 1));
      table.add(cell_of(score.mean_missed, 2));
      table.add(cell_of(score.mean_made_up, 2));
      table.add(cell_of(100.0 * score.tracked_share, 1));
      table.add(fmt::format("{} of {}", score.never_tracked, score.targets.size()));
      table.add(fmt::format("{}", score.swaps));
      table.add(fmt::format("{}", score.breaks));
      table.add(cell_of(score.false_per_hour, 1));
      table.add(cell_of(100.0 * score.false_share, 1));
      table.add(kept(score.five_of_ten));
    }
    out_ += table.html();
    if (scores_.empty()) return;
    out_ += fmt::format(
        "<p class=\"soft\">OSPA and GOSPA with a cut of {:g} m and order {:g}, means over {} "
        "steps. "
        "Missed and made up: targets at a time.  False: tracks that never were a target, and the "
        "share of what was shown that was none.  5 of 10: steps with a track of those at which a "
        "target that had one was seen in five of its last ten turns.</p>\n",
        scores_[0].rule.cut_m, scores_[0].rule.order, scores_[0].steps.size());
  }

  static std::string kept(const std::optional<FiveOfTen>& rule) {
    if (!rule || rule->due == 0) return "–";
    return fmt::format("{:.1f}",
                       100.0 * static_cast<double>(rule->kept) / static_cast<double>(rule->due));
  }

  PlotFrame frame(const char* title, const char* unit) const {
    PlotFrame frame;
    frame.title = title;
    frame.unit = unit;
    frame.end_s = std::max(1.0, last_s_ - first_s_);
    frame.height_px = 170.0;
    return frame;
  }

  // Its end, as names of files differ there.
  static std::string short_name(const std::string& text, std::size_t most = 20) {
    return text.size() > most ? ".." + text.substr(text.size() - most + 2) : text;
  }

  void distance(const char* title, double StepScore::*value) {
    std::vector<PlotCurve> curves;
    for (std::size_t i = 0; i < std::min(scores_.size(), kMostPlotCurves); ++i) {
      PlotCurve& curve = curves.emplace_back();
      curve.name = short_name(scores_[i].name);
      curve.colour = static_cast<int>(i);
      for (const StepScore& step : scores_[i].steps)
        curve.points.push_back({step.utc_s - first_s_, step.*value, false});
    }
    PlotFrame plot = frame(title, "m");
    plot.least = 0.0;
    out_ += plot_figure(plot, curves, {});
  }

  void distances() {
    distance("OSPA", &StepScore::ospa_m);
    distance("GOSPA", &StepScore::gospa_m);
  }

  void tracker(std::size_t index) {
    const SceneScore& score = scores_[index];
    out_ += fmt::format("<section><h2>{}</h2>\n", escaped(score.name));
    out_ += scene_figure(truth_, told_[index]);
    targets(score);
    errors(score, "Error of place", "m", 10.0,
           [](const TrackError& e) { return std::optional(e.place_m); });
    const auto plain = [](std::optional<double> TrackError::*member) {
      return [member](const TrackError& e) { return e.*member; };
    };
    errors(score, "Error of course", "deg", 10.0, plain(&TrackError::course_deg));
    errors(score, "Error of speed", "kn", 1.0, plain(&TrackError::speed_kn));
    errors(score, "Error of CPA", "NM", 0.1, plain(&TrackError::cpa_nm));
    errors(score, "Error of TCPA", "min", 1.0, plain(&TrackError::tcpa_min));
    out_ += "</section>\n";
  }

  void targets(const SceneScore& score) {
    HtmlTable table({"target", "#steps", "#first s", "#tracked %", "#cont. %", "#tracks", "#breaks",
                     "#swaps", "#RMS m", "#95 % m", "#course °", "#speed kn", "#CPA NM",
                     "#TCPA min"});
    std::size_t rows = 0;
    for (const TargetScore& target : score.targets) {
      if (++rows > kMostRows) break;
      table.begin_row();
      table.add(target.id);
      table.add(fmt::format("{}", target.steps));
      table.add(cell_of(target.initiation_s, 1));
      table.add(cell_of(100.0 * target.tracked_share, 1));
      table.add(cell_of(100.0 * target.continuity, 1));
      table.add(fmt::format("{}", target.numbers));
      table.add(fmt::format("{}", target.breaks));
      table.add(fmt::format("{}", target.swaps));
      table.add(cell_of(target.place_rms_m, 1));
      table.add(cell_of(target.place_95_m, 1));
      table.add(cell_of(target.course_95_deg, 1));
      table.add(cell_of(target.speed_95_kn, 2));
      table.add(cell_of(target.cpa_95_nm, 3));
      table.add(cell_of(target.tcpa_95_min, 2));
    }
    out_ += table.html();
    out_ +=
        "<p class=\"soft\">First: seconds from when it was seen or began to its first track.  "
        "Errors "
        "of course, speed, CPA and TCPA: 95 % of their amounts; CPA only while both ships keep "
        "on.</p>\n";
    accuracy(score);
  }

  void accuracy(const SceneScore& score) {
    HtmlTable table({"target", "steady for", "#steps", "#relative course °", "#relative speed kn",
                     "#course °", "#speed kn", "#CPA NM", "#TCPA min", "limits"});
    const auto row = [&](const TargetScore& target, const char* after, const Accuracy& accuracy) {
      if (accuracy.steps == 0) return;
      table.begin_row();
      table.add(target.id);
      table.add(after);
      table.add(fmt::format("{}", accuracy.steps));
      table.add(cell_of(accuracy.relative_course_95_deg, 1));
      table.add(cell_of(accuracy.relative_speed_95_kn, 2));
      table.add(cell_of(accuracy.course_95_deg, 1));
      table.add(cell_of(accuracy.speed_95_kn, 2));
      table.add(cell_of(accuracy.cpa_95_nm, 3));
      table.add(cell_of(accuracy.tcpa_95_min, 2));
      table.add_html(accuracy.exceeded == 0
                         ? std::string("<span class=\"good\">kept</span>")
                         : fmt::format("<span class=\"bad\">{} over</span>", accuracy.exceeded));
    };
    for (std::size_t i = 0; i < std::min(score.targets.size(), kMostRows); ++i) {
      row(score.targets[i], "1 min", score.targets[i].after_one_minute);
      row(score.targets[i], "3 min", score.targets[i].after_three_minutes);
    }
    if (table.is_empty()) return;
    out_ += table.html();
    out_ +=
        "<p class=\"soft\">95 % of the errors while one track has been the target's for so long "
        "and "
        "both ships kept on, against the limits of MSC.192(79) table 3.</p>\n";
  }

  template <typename Value>
  void errors(const SceneScore& score, const char* title, const char* unit, double least_span,
              const Value& value) {
    std::vector<PlotCurve> curves;
    for (std::size_t i = 0; i < std::min(score.targets.size(), kMostPlotCurves); ++i) {
      PlotCurve curve;
      curve.name = short_name(score.targets[i].id);
      curve.colour = static_cast<int>(i);
      double last_s = -1e300;
      for (const TrackError& error : score.targets[i].errors) {
        const std::optional<double> now = value(error);
        if (!now) continue;
        curve.points.push_back({error.utc_s - first_s_, *now, error.utc_s - last_s > kUntracked_s});
        last_s = error.utc_s;
      }
      if (!curve.points.empty()) curves.push_back(std::move(curve));
    }
    if (curves.empty()) return;
    PlotFrame plot = frame(title, unit);
    plot.least_span = least_span;
    out_ += plot_figure(plot, curves, {});
  }

  const ScorePage& page_;
  const Truth& truth_;
  std::span<const Told> told_;
  std::span<const SceneScore> scores_;
  double first_s_ = 1e300, last_s_ = -1e300;
  std::string out_;
};

}  // namespace

std::string score_page(const ScorePage& page, const Truth& truth, std::span<const Told> told,
                       std::span<const SceneScore> scores) {
  return PageOfScores(page, truth, told, scores).html();
}

}  // namespace skerry::server

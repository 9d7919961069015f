#include "server/plotter/judge/score_text.hpp"

#include <fmt/format.h>

#include <optional>
#include <string_view>

#include "server/page/csv_table.hpp"
#include "server/plotter/judge/read_notes.hpp"

namespace skerry::server {
namespace {

constexpr std::size_t kNameWidth = 26;

std::string fixed_or_dash(std::optional<double> value, int decimals) {
  return value ? fmt::format("{:.{}f}", *value, decimals) : "-";
}

std::optional<double> kept_percent(const std::optional<FiveOfTen>& rule) {
  if (!rule || rule->due == 0) return std::nullopt;
  return 100.0 * static_cast<double>(rule->kept) / static_cast<double>(rule->due);
}

std::string name_cell(std::string_view name) {
  std::string text = shown_text(name, 2 * kNameWidth);
  if (text.size() > kNameWidth) text = ".." + text.substr(text.size() - kNameWidth + 2);
  return text;
}

std::size_t steady_minutes(Settled settled) {
  return settled == Settled::three_minutes ? 3 : settled == Settled::one_minute ? 1 : 0;
}

CsvTable& operator<<(CsvTable& csv, const Accuracy& accuracy) {
  return csv << accuracy.steps << accuracy.relative_course_95_deg << accuracy.relative_speed_95_kn
             << accuracy.course_95_deg << accuracy.speed_95_kn << accuracy.cpa_95_nm
             << accuracy.tcpa_95_min << accuracy.exceeded;
}
CsvTable& operator<<(CsvTable& csv, const std::optional<FiveOfTen>& rule) {
  return rule ? csv << rule->due << rule->kept
              : csv << ""
                    << "";
}

std::string scenes_csv(std::span<const SceneScore> scores) {
  CsvTable csv(
      "tracker,cut_m,order,hours,steps,mean_ospa_m,mean_gospa_m,mean_missed,mean_made_up,"
      "tracked_share,never_tracked,swaps,breaks,false_tracks,false_per_hour,false_share,"
      "five_of_ten_due,five_of_ten_kept");
  for (const SceneScore& score : scores) {
    csv << score.name << score.rule.cut_m << score.rule.order << score.hours << score.steps.size()
        << score.mean_ospa_m << score.mean_gospa_m << score.mean_missed << score.mean_made_up
        << score.tracked_share << score.never_tracked << score.swaps << score.breaks
        << score.false_tracks << score.false_per_hour << score.false_share;
    csv << score.five_of_ten;
    csv.end();
  }
  return csv.take();
}

std::string target_scores_csv(std::span<const SceneScore> scores) {
  CsvTable csv(
      "tracker,target,steps,tracked,initiation_s,tracked_share,continuity,numbers,breaks,swaps,"
      "place_rms_m,place_95_m,course_95_deg,speed_95_kn,cpa_95_nm,tcpa_95_min,forecasts,"
      "five_of_ten_due,five_of_ten_kept,"
      "min1_steps,min1_relative_course_95_deg,min1_relative_speed_95_kn,min1_course_95_deg,"
      "min1_speed_95_kn,min1_cpa_95_nm,min1_tcpa_95_min,min1_limits_exceeded,"
      "min3_steps,min3_relative_course_95_deg,min3_relative_speed_95_kn,min3_course_95_deg,"
      "min3_speed_95_kn,min3_cpa_95_nm,min3_tcpa_95_min,min3_limits_exceeded");
  for (const SceneScore& score : scores) {
    for (const TargetScore& target : score.targets) {
      csv << score.name << target.id << target.steps << target.tracked << target.initiation_s
          << target.tracked_share << target.continuity << target.numbers << target.breaks
          << target.swaps << target.place_rms_m << target.place_95_m << target.course_95_deg
          << target.speed_95_kn << target.cpa_95_nm << target.tcpa_95_min << target.forecasts;
      csv << target.five_of_ten << target.after_one_minute << target.after_three_minutes;
      csv.end();
    }
  }
  return csv.take();
}

std::string track_scores_csv(std::span<const SceneScore> scores) {
  CsvTable csv("tracker,track,steps,paired,targets");
  for (const SceneScore& score : scores) {
    for (const ToldScore& track : score.tracks) {
      csv << score.name << track.number << track.steps << track.paired << track.targets;
      csv.end();
    }
  }
  return csv.take();
}

std::string steps_csv(std::span<const SceneScore> scores) {
  CsvTable csv(
      "tracker,utc_s,truth,told,ospa_m,gospa_m,errors_part,missed_part,made_up_part,missed,"
      "made_up");
  for (const SceneScore& score : scores) {
    for (const StepScore& step : score.steps) {
      (csv << score.name).fixed(step.utc_s, 3)
          << step.truth << step.told << step.ospa_m << step.gospa_m << step.errors_part
          << step.missed_part << step.made_up_part << step.missed << step.made_up;
      csv.end();
    }
  }
  return csv.take();
}

std::string errors_csv(std::span<const SceneScore> scores) {
  CsvTable csv(
      "tracker,utc_s,target,track,steady_min,place_m,course_deg,speed_kn,relative_course_deg,"
      "relative_speed_kn,cpa_nm,tcpa_min");
  for (const SceneScore& score : scores) {
    for (const TargetScore& target : score.targets) {
      for (const TrackError& error : target.errors) {
        (csv << score.name).fixed(error.utc_s, 3)
            << target.id << score.tracks[error.track].number << steady_minutes(error.settled)
            << error.place_m << error.course_deg << error.speed_kn << error.relative_course_deg
            << error.relative_speed_kn << error.cpa_nm << error.tcpa_min;
        csv.end();
      }
    }
  }
  return csv.take();
}

// Errors of settled tracks against the limits of MSC.192, if there are any.
std::string accuracy_table(const SceneScore& score) {
  std::string rows;
  const auto row = [&rows](const std::string& name, const char* after, const Accuracy& accuracy) {
    if (accuracy.steps == 0) return;
    rows += fmt::format(
        "{:<26} {:>6} {:>6} {:>8} {:>7} {:>7} {:>7} {:>7} {:>8} {:>9}\n", name, after,
        accuracy.steps, fixed_or_dash(accuracy.relative_course_95_deg, 1),
        fixed_or_dash(accuracy.relative_speed_95_kn, 2), fixed_or_dash(accuracy.course_95_deg, 1),
        fixed_or_dash(accuracy.speed_95_kn, 2), fixed_or_dash(accuracy.cpa_95_nm, 3),
        fixed_or_dash(accuracy.tcpa_95_min, 2),
        accuracy.exceeded == 0 ? "kept" : fmt::format("{} over", accuracy.exceeded));
  };
  for (const TargetScore& target : score.targets) {
    const std::string name = "  " + name_cell(target.id).substr(0, kNameWidth - 2);
    row(name, "1 min", target.after_one_minute);
    row(name, "3 min", target.after_three_minutes);
  }
  if (rows.empty()) return rows;
  return fmt::format("{:<26} {:>6} {:>6} {:>8} {:>7} {:>7} {:>7} {:>7} {:>8} {:>9}\n",
                     "  steady track, 95 %", "after", "steps", "rel crs", "rel spd", "crs deg",
                     "spd kn", "cpa NM", "tcpa min", "MSC.192") +
         rows;
}

}  // namespace

std::string score_table(std::span<const SceneScore> scores) {
  std::string out = fmt::format(
      "{:<26} {:>7} {:>8} {:>6} {:>7} {:>8} {:>5} {:>6} {:>7} {:>7} {:>7}\n", "tracker", "OSPA m",
      "GOSPA m", "missed", "made up", "tracked%", "swaps", "breaks", "false/h", "false%", "5of10%");
  for (const SceneScore& score : scores) {
    out += fmt::format(
        "{:<26} {:>7.1f} {:>8.1f} {:>6.2f} {:>7.2f} {:>8.1f} {:>5} {:>6} {:>7} {:>7.1f} {:>7}\n",
        name_cell(score.name), score.mean_ospa_m, score.mean_gospa_m, score.mean_missed,
        score.mean_made_up, 100.0 * score.tracked_share, score.swaps, score.breaks,
        fixed_or_dash(score.false_per_hour, 1), 100.0 * score.false_share,
        fixed_or_dash(kept_percent(score.five_of_ten), 1));
  }
  for (const SceneScore& score : scores) {
    out += fmt::format("\n{}\n", shown_text(score.name, 200));
    out += fmt::format(
        "{:<26} {:>6} {:>6} {:>8} {:>6} {:>6} {:>6} {:>5} {:>6} {:>6} {:>7} {:>7} {:>7} {:>8}\n",
        "  target", "steps", "init s", "tracked%", "cont.%", "tracks", "breaks", "swaps", "rms m",
        "95% m", "crs deg", "spd kn", "cpa NM", "tcpa min");
    for (const TargetScore& target : score.targets) {
      out += fmt::format(
          "{:<26} {:>6} {:>6} {:>8.1f} {:>6.1f} {:>6} {:>6} {:>5} {:>6} {:>6} {:>7} {:>7} {:>7} "
          "{:>8}\n",
          "  " + name_cell(target.id).substr(0, kNameWidth - 2), target.steps,
          fixed_or_dash(target.initiation_s, 1), 100.0 * target.tracked_share,
          100.0 * target.continuity, target.numbers, target.breaks, target.swaps,
          fixed_or_dash(target.place_rms_m, 1), fixed_or_dash(target.place_95_m, 1),
          fixed_or_dash(target.course_95_deg, 1), fixed_or_dash(target.speed_95_kn, 2),
          fixed_or_dash(target.cpa_95_nm, 3), fixed_or_dash(target.tcpa_95_min, 2));
    }
    out += accuracy_table(score);
  }
  return out;
}

std::vector<std::pair<std::string, std::string>> score_csv_files(
    std::span<const SceneScore> scores) {
  return {{"scenes.csv", scenes_csv(scores)},
          {"targets.csv", target_scores_csv(scores)},
          {"tracks.csv", track_scores_csv(scores)},
          {"steps.csv", steps_csv(scores)},
          {"errors.csv", errors_csv(scores)}};
}

}  // namespace skerry::server

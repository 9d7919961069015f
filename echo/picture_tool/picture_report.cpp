#include "echo/picture_tool/picture_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "echo/tool_console/text_table.hpp"

namespace skerry::echo {
namespace {

std::string number(double value, int digits) {
  return std::isfinite(value) ? fmt::format("{:.{}f}", value, digits) : "-";
}

// "1.23~0.04", the spread only where it can be seen.
std::string with_spread(const SpreadStatistics& side, const StatisticRow& row) {
  std::string text = number(side.mean.*row.of, row.digits);
  const double spread = side.spread.*row.of;
  if (text != "-" && std::isfinite(spread) && spread >= 0.5 * std::pow(10.0, -row.digits))
    text += fmt::format("~{}", number(spread, row.digits));
  return text;
}

std::string auc(const std::optional<TellingApart>& call) {
  return call ? fmt::format("{:.2f}", call->auc) : "-";
}

std::string auc_with_folds(const std::optional<TellingApart>& call) {
  return call ? fmt::format("{:.2f} ({:.2f}-{:.2f})", call->auc, call->least, call->most) : "-";
}

std::string size_of(const SpreadStatistics& side) {
  return fmt::format("{} turn{} of {} place{}", side.turns, side.turns == 1 ? "" : "s", side.places,
                     side.places == 1 ? "" : "s");
}

// Why a statistic of the mean is not there; empty where it is.
std::string missing_because(const SpreadStatistics& side, const StatisticRow& row) {
  if (std::isfinite(side.mean.*row.of)) return {};
  if (side.empty())
    return fmt::format("only {:.2g} % of the cells echo", 100.0 * side.mean.occupancy);
  const bool of_turns =
      row.of == &PictureStatistics::turn_lag1 || row.of == &PictureStatistics::bow_seam;
  if (of_turns) return "no two turns that follow each other and echo";
  const bool of_outline =
      row.of == &PictureStatistics::outline_below || row.of == &PictureStatistics::outline_above;
  if (of_outline) return "no outline, or the beam is too few picture elements wide";
  return "nothing echoes";
}

// Statistics that are missing for one reason together.
std::vector<std::string> missing_notes(const SpreadStatistics& side, const char* name) {
  std::map<std::string, std::vector<std::string_view>> by_reason;
  for (const StatisticRow& row : statistic_rows()) {
    const std::string reason = missing_because(side, row);
    if (!reason.empty()) by_reason[reason].push_back(row.key);
  }
  std::vector<std::string> notes;
  for (const auto& [reason, keys] : by_reason)
    notes.push_back(fmt::format("the {} has no {}: {}", name, fmt::join(keys, ", "), reason));
  return notes;
}

std::string notes_text(const PictureReport& report) {
  std::string text;
  for (const std::string& note : notes_of(report)) text += fmt::format("note: {}\n", note);
  return text;
}

// The features that one by one tell most, with the median of either side; nothing where there was
// no call.
std::string features_text(const PictureReport& report, std::size_t most) {
  const auto& told = report.calls.real_ours.all;
  if (!told || most == 0) return {};
  TextTable table;
  table.begin("tells, one by one");
  table.add("AUC"), table.add("first"), table.add("second");
  for (std::size_t i = 0; i < std::min(most, told->features.size()); ++i) {
    const TellingFeature& feature = told->features[i];
    table.begin(std::string(feature.name));
    table.add(number(feature.auc, 2)), table.add(number(feature.first, 3));
    table.add(number(feature.second, 3));
  }
  return table.text();
}

}  // namespace

std::array<const Call*, 5> all_calls(const Calls& calls) {
  return {&calls.real_ours, &calls.real_real, &calls.ours_ours, &calls.one_others, &calls.null};
}

std::vector<std::string> notes_of(const PictureReport& report) {
  std::vector<std::string> notes = report.notes;
  const auto add = [&](const std::string& note) {
    if (!note.empty() && std::find(notes.begin(), notes.end(), note) == notes.end())
      notes.push_back(note);
  };
  for (const std::string& note : missing_notes(report.real, "first")) add(note);
  for (const std::string& note : missing_notes(report.ours, "second")) add(note);
  for (const Call* call : all_calls(report.calls)) {
    if (!call->why_not.empty()) add(fmt::format("{}: {}", call->name, call->why_not));
  }
  if (report.calls.leaks)
    add(
        fmt::format("the null is not within {} to {}: the folds leak or there are too few patches, "
                    "so the other calls say nothing",
                    kNullLeast, kNullMost));
  return notes;
}

std::string report_text(const PictureReport& report, std::size_t features) {
  std::string text =
      fmt::format("first   {}, {}\nsecond  {}, {}\nbeam    {:g} deg\n\n", report.real_name,
                  size_of(report.real), report.ours_name, size_of(report.ours), report.beam_deg);
  TextTable figures;
  figures.begin("");
  figures.add("first"), figures.add("second");
  for (const StatisticRow& row : statistic_rows()) {
    figures.begin(std::string(row.name));
    figures.add(with_spread(report.real, row)), figures.add(with_spread(report.ours, row));
  }
  text += figures.text() + "\n";
  TextTable calls;
  calls.begin("classifier, AUC (folds)");
  calls.add("mask"), calls.add("all features"), calls.add("patches of each");
  for (const Call* call : all_calls(report.calls)) {
    calls.begin(call->name);
    calls.add(auc_with_folds(call->mask)), calls.add(auc_with_folds(call->all));
    calls.add(call->mask ? fmt::format("{}", call->mask->patches) : "-");
  }
  text += calls.text();
  const std::string told = features_text(report, features);
  return text + (told.empty() ? "" : "\n") + told + notes_text(report);
}

std::string short_report_head() {
  return fmt::format("{:36} {:>9} {:>14} {:>10} {:>10} {:>5} {:>5} {:>5}\n", "", "D", "ribbon m",
                     "spoke lag", "range lag", "turn", "seam", "occ.");
}

std::string short_report_text(const PictureReport& report, std::size_t features) {
  std::string text;
  const auto line = [&](const std::string& name, const PictureStatistics& s) {
    text += fmt::format("{:36} {:>9} {:>14} {:>10} {:>10} {:>5} {:>5} {:>5}\n", name,
                        number(s.outline_below, 2) + "/" + number(s.outline_above, 2),
                        number(s.ribbon_p10_m, 0) + "/" + number(s.ribbon_p50_m, 0) + "/" +
                            number(s.ribbon_p90_m, 0),
                        number(s.spoke_lag1, 3) + "/" + number(s.spoke_lag4, 2),
                        number(s.range_lag1, 3) + "/" + number(s.range_lag4, 2),
                        number(s.turn_lag1, 2), number(s.bow_seam, 2), number(s.occupancy, 3));
  };
  line(fmt::format("{} x{}", report.real_name, report.real.turns), report.real.mean);
  line(fmt::format("   {}, {} places", report.ours_name, report.ours.places), report.ours.mean);
  for (const Call* call : all_calls(report.calls)) {
    text +=
        fmt::format("   {:12} mask {:>4} all {:>4}", call->name, auc(call->mask), auc(call->all));
    if (call->mask) text += fmt::format("  ({} patches)", call->mask->patches);
    text += '\n';
  }
  return text + features_text(report, features) + notes_text(report);
}

}  // namespace skerry::echo

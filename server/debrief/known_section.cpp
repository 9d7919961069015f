#include "server/debrief/known_section.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "server/debrief/words.hpp"
#include "server/page/html_text.hpp"

namespace skerry::server {
namespace {

constexpr std::size_t kMostTargetRows = 300, kMostAlertRows = 300, kMostSections = 16;

std::string paragraph(const char* kind, const std::string& text) {
  return fmt::format("<p class=\"{}\">{}</p>\n", kind, escaped(text));
}

std::string minutes_text(const std::optional<double>& minutes) {
  return minutes ? fmt::format("{:.1f} min", *minutes) : "";
}

std::string targets_html(const Debrief& debrief, const KnownView& view) {
  if (view.targets.empty()) return paragraph("", "It tracked nothing.");
  HtmlTable table(moment_columns(debrief, {"#target", "by AIS", "#until", "then", "#least CPA told",
                                           "#TCPA then", "#told at"}));
  const std::size_t shown = std::min(view.targets.size(), kMostTargetRows);
  for (std::size_t i = 0; i < shown; ++i) {
    const KnownTarget& target = view.targets[i];
    table.begin_row();
    add_moment(debrief, target.first, table);
    table.add(fmt::format("{}", target.number));
    table.add(target.name);
    table.add(clock_text(target.last.at_s));
    table.add(ending_text(target));
    const bool has_cpa = target.least_cpa_nm.has_value();
    table.add(has_cpa ? fmt::format("{:.2f} NM", *target.least_cpa_nm) : "none");
    table.add(minutes_text(target.tcpa_min));
    table.add(has_cpa ? clock_text(target.least_when.at_s) : "");
  }
  std::string html = table.html();
  if (view.targets.size() > shown) {
    html += paragraph(
        "soft", fmt::format("{} more are in known_targets.csv.", view.targets.size() - shown));
  }
  return html;
}

std::string alerts_html(const Debrief& debrief, const KnownView& view) {
  if (view.alerts.empty()) return paragraph("", "It raised no alert.");
  HtmlTable table(
      moment_columns(debrief, {"what", "title", "in words", "#acknowledged", "#after", "#ended"}));
  const std::size_t shown = std::min(view.alerts.size(), kMostAlertRows);
  for (std::size_t i = 0; i < shown; ++i) {
    const KnownAlert& alert = view.alerts[i];
    table.begin_row(alert.priority == "alarm" ? "collision" : "");
    add_moment(debrief, alert.raised, table);
    table.add(alert.priority);
    table.add(alert.title);
    table.add(alert.text);
    table.add(alert.acknowledged ? clock_text(alert.acknowledged->at_s) : "never");
    const auto after_s = alert.reaction_s();
    table.add(after_s ? fmt::format("{:.0f} s", *after_s) : "");
    table.add(alert.ended ? clock_text(alert.ended->at_s) : "");
  }
  std::string html = table.html();
  if (view.alerts.size() > shown) {
    html += paragraph("soft",
                      fmt::format("{} more are in known_alerts.csv.", view.alerts.size() - shown));
  }
  return html;
}

}  // namespace

std::string known_section(const Debrief& debrief) {
  std::string html = paragraph(
      "soft",
      "The tracked targets and alerts that displays were told, with the errors of their video and "
      "sensors: not the truth. Lists are recorded once a second, so times are right to a second. "
      "Least CPA: while it lay ahead. Ended: its cause was gone, or its target, before anybody "
      "acknowledged it.");
  const std::size_t shown = std::min(debrief.known.size(), kMostSections);
  for (std::size_t i = 0; i < shown; ++i) {
    const KnownView& view = debrief.known[i];
    html += fmt::format(
        "<h3>{}{}{}</h3>\n", view.own_name.empty() ? "" : escaped(view.own_name) + ", ",
        escaped(view.radar), view.view == 0 ? "" : fmt::format(", console view {}", view.view));
    html += targets_html(debrief, view) + alerts_html(debrief, view);
    if (view.left_out > 0) {
      html +=
          paragraph("bad", fmt::format("{} targets and alerts more are left out.", view.left_out));
    }
  }
  if (debrief.known.size() > shown) {
    html += paragraph(
        "soft", fmt::format("{} more views are in the CSV files.", debrief.known.size() - shown));
  }
  return html;
}

}  // namespace skerry::server

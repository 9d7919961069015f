#include "server/debrief/debrief_page.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <map>
#include <set>

#include "server/debrief/chart_figure.hpp"
#include "server/debrief/deeds.hpp"
#include "server/debrief/known_section.hpp"
#include "server/debrief/words.hpp"
#include "server/page/html_text.hpp"
#include "server/page/page_frame.hpp"
#include "server/page/plot_figure.hpp"

namespace skerry::server {
namespace {

constexpr std::size_t kMostCurves = 8;      // of one plot
constexpr std::size_t kMostPassings = 200;  // of the table
constexpr std::size_t kMostMishaps = 1000;  // of the table and of marks on plots

PlotFrame plot_of(const char* title, const char* unit, double least_span) {
  PlotFrame frame;
  frame.title = title;
  frame.unit = unit;
  frame.least_span = least_span;
  return frame;
}

class Page {
 public:
  Page(const Debrief& debrief, const std::optional<wire::Coastline>& coast)
      : debrief_(debrief), coast_(coast) {
    for (std::size_t i = 0; i < std::min(debrief.contacts.size(), kMostMishaps); ++i) {
      const Contact& contact = debrief.contacts[i];
      marks_.push_back({debrief.contact_moments[i].at_s, kind_of(contact), words_for(contact)});
    }
    for (const HappenedLine& line : debrief.happened) {
      if (line.kind != "event" && line.kind != "fault") continue;
      marks_.push_back({line.when.at_s, line.kind, line.kind + ": " + line.text});
    }
  }

  std::string html() {
    head();
    part("chart", "Tracks", [&] { tracks(); });
    part("passings", "How near ships came", [&] { passings(); });
    part("mishaps", "Collisions and groundings", [&] { mishaps(); });
    if (!debrief_.checks.empty()) part("checks", "Checks of the sheet", [&] { checks(); });
    part("reactions", "Reaction times", [&] { reactions(); });
    if (!debrief_.known.empty()) {
      part("known", "What the set knew", [&] { out_ += known_section(debrief_); });
    }
    part("ships", "Helm, engine, heading and speed", [&] { ships(); });
    part("timeline", "Time line", [&] { timeline(); });
    if (!debrief_.deeds.empty()) {
      part("deeds", "Who did what", [&] { out_ += deeds_section(debrief_); });
    }
    out_ += fmt::format("<script>{}</script>\n</body></html>\n", kPageScript);
    return std::move(out_);
  }

 private:
  template <typename Fill>
  void part(const char* id, const char* title, const Fill& fill) {
    out_ += fmt::format("<section id=\"{}\"><h2>{}</h2>\n", id, title);
    fill();
    out_ += "</section>\n";
  }
  std::vector<std::string> columns(std::vector<std::string> more) const {
    return moment_columns(debrief_, std::move(more));
  }
  void add(HtmlTable& table, const Moment& when) const { add_moment(debrief_, when, table); }
  void fact(const char* name, const std::string& value) {
    if (!value.empty()) out_ += fmt::format("<span>{} <b>{}</b></span>", name, escaped(value));
  }
  void say(const char* kind, const std::string& text) {
    out_ += fmt::format("<p class=\"{}\">{}</p>\n", kind, escaped(text));
  }

  void head() {
    const std::string name = escaped(debrief_.exercise);
    out_ = fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>{}: "
        "debrief</title>\n<meta name=\"viewport\" content=\"width=device-width\"><meta "
        "http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src "
        "'unsafe-inline'; script-src 'unsafe-inline'\"><meta name=\"generator\" content=\"skerry "
        "exercise report\">\n<style>{}</style></head><body>\n<h1>{}</h1>\n",
        name, kPageStyle, name);
    if (!debrief_.goal.empty()) say("goal", debrief_.goal);
    out_ += "<div class=\"facts\">";
    const std::time_t began =
        std::chrono::duration_cast<std::chrono::seconds>(debrief_.began.time_since_epoch()).count();
    fact("began", fmt::format("{:%Y-%m-%d %H:%M:%S} UTC", fmt::gmtime(began)));
    fact("length", clock_text(debrief_.end.at_s));
    if (!debrief_.has_one_clock) fact("of the exercise", clock_text(debrief_.end.exercise_s));
    fact("made by", debrief_.server);
    fact("chart", debrief_.chart);
    out_ += "</div>\n";
    if (debrief_.differs) {
      say("bad", "The world refused an input of this recording (" + *debrief_.differs +
                     "): what follows is not what was sailed.");
    }
    if (debrief_.incomplete) {
      say("bad", "Inputs are missing at the recording's end: what follows holds until there.");
    }
    if (!debrief_.briefing.empty()) say("briefing", debrief_.briefing);
    if (!debrief_.answers.empty()) {
      out_ += "<p>What is expected:</p><ul>";
      for (const std::string& answer : debrief_.answers) out_ += "<li>" + escaped(answer) + "</li>";
      out_ += "</ul>\n";
    }
    summary();
    out_ += fmt::format(
        "<nav><a href=\"#chart\">Tracks</a><a href=\"#passings\">Passings</a><a "
        "href=\"#mishaps\">Collisions and groundings</a><a href=\"#reactions\">Reactions</a>{}<a "
        "href=\"#ships\">Ships</a><a href=\"#timeline\">Time line</a></nav>\n",
        debrief_.known.empty() ? "" : "<a href=\"#known\">What the set knew</a>");
  }

  void summary() {
    std::size_t collisions = 0, failed = 0, judged = 0;
    for (const Contact& each : debrief_.contacts) {
      if (each.kind == Contact::Kind::collision) ++collisions;
    }
    for (const JudgedCheck& check : debrief_.checks) {
      if (check.reached) ++judged;
      if (check.reached && !check.passed) ++failed;
    }
    const std::size_t groundings = debrief_.contacts.size() - collisions;
    say(debrief_.contacts.empty() ? "good" : "bad",
        fmt::format("Collisions: {}, groundings: {}.", collisions, groundings));
    if (judged > 0) {
      say(failed == 0 ? "good" : "bad",
          fmt::format("{} of {} checks passed.", judged - failed, judged));
    }
    if (!debrief_.passings.empty()) {
      const ShipPassing& nearest = debrief_.passings.front();
      say("", fmt::format("Nearest: {} and {}, {} at {}.", nearest.own_name, nearest.other_name,
                          miles_text(nearest.closest_m), clock_text(nearest.when.at_s)));
    }
  }

  void tracks() {
    out_ += chart_figure(debrief_, coast_);
    say("soft",
        fmt::format(
            "Times are since the server began. Targets that came nearer than {:g} NM are dashed; "
            "ships stand where they were last. {}{}",
            debrief_.limits.near_nm,
            debrief_.known.empty() ? "" : "Thin lines: what sets tracked. ",
            coast_ ? "The coast is the chart's, before it is refined; not for navigation."
                   : "No coast: the exercise's chart is not here."));
  }

  void passings() {
    HtmlTable table(columns({"own ship", "other", "#least range", "#bearing", "passed",
                             "#CPA forecast under limit", "#for", "#least forecast"}));
    std::size_t shown = 0;
    for (const ShipPassing& passing : debrief_.passings) {
      if (++shown > kMostPassings) break;
      table.begin_row();
      add(table, passing.when);
      table.add(passing.own_name);
      table.add(passing.other_name);
      table.add(miles_text(passing.closest_m));
      table.add(bearing_text(passing.bearing_deg));
      table.add(side_text(passing));
      table.add(passing.first_under ? "from " + clock_text(passing.first_under->at_s) : "never");
      table.add(passing.first_under ? clock_text(passing.under_limit_s) : "");
      table.add(passing.first_under ? miles_text(passing.least_forecast_m) : "");
    }
    if (table.is_empty()) {
      say("", fmt::format("No ship came nearer than {:g} NM.", debrief_.limits.near_nm));
      return;
    }
    out_ += table.html();
    say("soft",
        fmt::format("Ranges are between the ships' middles. The limit: a CPA under {:g} NM within "
                    "{:g} min, if both keep course and speed. Passed: own ship's side, hers. "
                    "For: by the exercise's clock.{}",
                    debrief_.limits.cpa_nm, debrief_.limits.tcpa_min,
                    debrief_.passings.size() > kMostPassings
                        ? fmt::format(" {} more pairs are in the CSV files.",
                                      debrief_.passings.size() - kMostPassings)
                        : ""));
    for (const ShipTrack& track : debrief_.own_ships) ranges_of(track);
  }

  void ranges_of(const ShipTrack& track) {
    std::vector<PlotCurve> curves;
    double most_nm = 2.0 * debrief_.limits.cpa_nm;
    for (const ShipPassing& passing : debrief_.passings) {
      const bool hers = passing.own_ship == track.number;
      if (!hers && !(passing.other_own && passing.other == track.number)) continue;
      if (curves.size() == kMostCurves || passing.ranges.size() < 2) continue;
      PlotCurve& curve = curves.emplace_back();
      curve.name = hers ? passing.other_name : passing.own_name;
      if (curve.name.size() > 18) curve.name = shortened(curve.name, 16);
      curve.colour = static_cast<int>(curves.size() - 1);
      double last_s = -1e9;
      for (const ShipPassing::Range& each : passing.ranges) {
        curve.points.push_back({each.at_s, each.range_nm, each.at_s > last_s + 30.0});
        last_s = each.at_s;
        most_nm = std::max(most_nm, each.range_nm);
      }
    }
    if (curves.empty()) return;
    PlotFrame frame;
    frame.title = "Range of others from " + track.name;
    frame.unit = "NM";
    frame.end_s = debrief_.end.at_s;
    frame.height_px = 240.0;
    frame.least = 0.0;
    frame.most = std::min(most_nm, 2.0 * debrief_.limits.near_nm);
    frame.limit = debrief_.limits.cpa_nm;
    out_ += plot_figure(frame, curves, marks_);
  }

  void mishaps() {
    if (debrief_.contacts.empty()) return say("good", "None.");
    HtmlTable table(columns({"#on the chart", "what", "own ship", "with", "position", "#kn"}));
    const std::size_t count = debrief_.contacts.size(), shown = std::min(count, kMostMishaps);
    for (std::size_t i = 0; i < shown; ++i) {
      const Contact& contact = debrief_.contacts[i];
      table.begin_row(kind_of(contact));
      add(table, debrief_.contact_moments[i]);
      table.add(fmt::format("{}", i + 1));
      table.add(kind_of(contact));
      table.add(contact.own_name);
      table.add(contact.kind == Contact::Kind::collision ? contact.other_name : contact.why);
      table.add(place_text(contact.position));
      table.add(fmt::format("{:.1f}", contact.relative_mps * 3600.0 / 1852.0));
    }
    out_ += table.html();
    if (count > shown) {
      say("bad", fmt::format("These are the first {} of {}; all of them are in mishaps.csv.", shown,
                             count));
    }
    say("soft", "kn: of one ship as seen from the other; of a grounding, over ground.");
  }

  void checks() {
    HtmlTable table({"#at", "check", "result", "in detail"});
    for (const JudgedCheck& check : debrief_.checks) {
      table.begin_row();
      table.add(clock_text(check.when.exercise_s));
      table.add(check.says);
      table.add_html(!check.reached ? "<span class=\"soft\">not reached</span>"
                     : check.passed ? "<span class=\"good\">passed</span>"
                                    : "<span class=\"bad\">failed</span>");
      std::string detail;
      for (const auto& [passed, text] : check.lines) {
        detail += fmt::format("<div class=\"{}\">{}</div>", passed ? "soft" : "bad", escaped(text));
      }
      table.add_html(detail);
    }
    out_ += table.html();
    say("soft", "At: on the exercise's clock. Pictures are judged with the scenario's controls.");
  }

  void reactions() {
    HtmlTable table(columns(
        {"own ship", "what called for it", "#helm after", "#engine after", "#setting after"}));
    const auto after = [](const std::optional<double>& seconds) {
      return seconds ? fmt::format("{:.0f} s", *seconds) : std::string("none");
    };
    for (const Reaction& reaction : debrief_.reactions) {
      table.begin_row();
      add(table, reaction.when);
      table.add(reaction.own_name);
      table.add(reaction.stimulus);
      table.add(after(reaction.helm_s));
      table.add(after(reaction.engine_s));
      table.add(after(reaction.setting_s));
    }
    if (table.is_empty()) return say("", "Nothing called for any.");
    out_ += table.html();
    say("soft", fmt::format("The next order of each kind aboard her within {:.0f} min, whatever it "
                            "was for. Seconds are of the recording.",
                            Reaction::kLongest_s / 60.0));
  }

  // One value of a ship's track as a plot; none if she does not have it.
  template <typename Value>
  void plot(const ShipTrack& track, PlotFrame frame, bool wraps, const Value& value) {
    PlotCurve curve;
    curve.colour = static_cast<int>(track.number % kMostCurves);
    for (const TrackPoint& point : track.points) {
      const std::optional<double> now = value(point);
      if (!now) continue;
      const bool wrapped =
          wraps && !curve.points.empty() && std::fabs(curve.points.back().value - *now) > 180.0;
      curve.points.push_back({point.when.at_s, *now, wrapped});
    }
    if (curve.points.empty()) return;
    frame.end_s = debrief_.end.at_s;
    out_ += plot_figure(frame, {curve}, marks_);
  }

  void ships() {
    for (const ShipTrack& track : debrief_.own_ships) {
      out_ += fmt::format("<div class=\"ship\"><h3>{}</h3><p class=\"soft\">{}{:g} m by {:g} m</p>",
                          escaped(track.name),
                          track.ship_class.empty() ? "" : escaped(track.ship_class) + ", ",
                          track.length_m, track.beam_m);
      PlotFrame compass = plot_of("Heading", "degrees true", 360.0);
      compass.least = 0.0;
      compass.most = 360.0;
      compass.tick = 90.0;
      plot(track, compass, true,
           [](const TrackPoint& point) { return std::optional(point.heading_deg); });
      plot(track, plot_of("Rudder", "degrees, starboard up", 20.0), false,
           [](const TrackPoint& point) { return point.rudder_deg; });
      plot(track, plot_of("Speed over ground", "kn", 4.0), false,
           [](const TrackPoint& point) { return std::optional(point.speed_kn); });
      plot(track, plot_of("Shaft", "turns/min", 20.0), false,
           [](const TrackPoint& point) { return point.shaft_rpm; });
      out_ += "</div>\n";
    }
    say("soft", "Lines across all plots: events and faults, dashed; collisions and groundings.");
  }

  void timeline() {
    std::map<std::string, std::size_t> kinds;
    for (const HappenedLine& line : debrief_.happened) ++kinds[line.kind];
    out_ += "<div class=\"kinds\">";
    for (const auto& [kind, count] : kinds) {
      out_ += fmt::format("<label><input type=\"checkbox\" value=\"{}\" checked> {} ({})</label>",
                          class_of(kind), escaped(kind), count);
    }
    out_ += "</div>\n";
    HtmlTable table(columns({"what", "who", "in words"}), "happened");
    for (const HappenedLine& line : debrief_.happened) {
      table.begin_row(class_of(line.kind));
      add(table, line.when);
      table.add(line.kind);
      table.add(line.who);
      table.add(line.text);
    }
    if (table.is_empty()) return say("", "Nothing was ordered, and nothing happened.");
    out_ += table.html();
  }

  const Debrief& debrief_;
  const std::optional<wire::Coastline>& coast_;
  std::vector<PlotMark> marks_;
  std::string out_;
};

}  // namespace

std::string debrief_page(const Debrief& debrief, const std::optional<wire::Coastline>& coast) {
  return Page(debrief, coast).html();
}

}  // namespace skerry::server

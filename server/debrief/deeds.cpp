#include "server/debrief/deeds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "protocol/recording/audit_text.hpp"
#include "server/debrief/words.hpp"
#include "server/page/csv_table.hpp"
#include "server/page/html_text.hpp"

namespace skerry::server {
namespace {

constexpr std::size_t kMostDeedRows = 2000;

}  // namespace

void read_deeds(const recording::RecordingReader& reader, UtcTime epoch, double end_s,
                const std::function<double(double)>& exercise_at, Debrief& debrief) {
  const recording::Topic topic{recording::Kind::audit};
  if (!reader.summary().items.contains(topic)) return;
  recording::ItemCursor items = reader.items({topic});
  while (const auto item = items.next()) {
    const double at_s = in_seconds(item->time - epoch);
    if (at_s > end_s) break;
    Deed deed;
    if (!deed.entry.ParseFromArray(item->bytes.data(), static_cast<int>(item->bytes.size()))) {
      continue;
    }
    if (debrief.deeds.size() == kMostDeeds) {
      ++debrief.deeds_left_out;
      continue;
    }
    deed.when = {at_s, exercise_at(at_s)};
    debrief.deeds.push_back(std::move(deed));
  }
}

std::string deeds_section(const Debrief& debrief) {
  std::string html =
      "<p class=\"soft\">As the server's audit has it: changes, orders, sign-ins and refusals, at "
      "the time when they were written down. Changes of one control within a second are one "
      "line. Nobody: who had not said who she is.</p>\n";
  HtmlTable table(moment_columns(debrief, {"what", "who", "in words"}));
  const std::size_t shown = std::min(debrief.deeds.size(), kMostDeedRows);
  for (std::size_t i = 0; i < shown; ++i) {
    const Deed& deed = debrief.deeds[i];
    const bool by_server = deed.entry.kind() == "server";
    table.begin_row(class_of(deed.entry.kind()));
    add_moment(debrief, deed.when, table);
    table.add(deed.entry.kind());
    table.add(!deed.entry.who().empty() ? deed.entry.who() : by_server ? "the server" : "nobody");
    table.add(recording::audit_text(deed.entry));
  }
  html += table.html();
  if (debrief.deeds.size() > shown) {
    html += fmt::format("<p class=\"soft\">{} more are in deeds.csv.</p>\n",
                        debrief.deeds.size() - shown);
  }
  if (debrief.deeds_left_out > 0) {
    html += fmt::format("<p class=\"bad\">{} more are left out.</p>\n", debrief.deeds_left_out);
  }
  return html;
}

std::string deeds_csv(const Debrief& debrief) {
  CsvTable csv("at_s,exercise_s,n,utc,kind,who,from,what,before,after,times,result");
  for (const auto& [when, entry] : debrief.deeds) {
    csv.fixed(when.at_s, 3).fixed(when.exercise_s, 3)
        << std::size_t{entry.n()} << entry.utc() << entry.kind() << entry.who() << entry.from()
        << entry.what() << entry.before() << entry.after()
        << std::size_t{std::max(entry.times(), 1U)} << entry.result();
    csv.end();
  }
  return csv.take();
}

}  // namespace skerry::server

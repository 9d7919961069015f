#include "echo/picture_tool/report_files.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace skerry::echo {
namespace {

std::string value_text(double value, const char* none) {
  return std::isfinite(value) ? fmt::format("{:.6g}", value) : none;
}

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (static_cast<unsigned char>(c) < 0x20) {
      out += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    } else {
      out += c;
    }
  }
  return out + '"';
}

std::string list_json(const std::vector<std::string>& texts) {
  std::string out = "[";
  for (const std::string& text : texts) {
    if (out.size() > 1) out += ", ";
    out += quoted(text);
  }
  return out + "]";
}

std::string features_json(const std::vector<TellingFeature>& features) {
  std::string out = "[";
  for (const TellingFeature& feature : features) {
    if (out.size() > 1) out += ", ";
    out +=
        fmt::format(R"({{"name": {}, "auc": {:.6g}, "first": {:.6g}, "second": {:.6g}}})",
                    quoted(std::string(feature.name)), feature.auc, feature.first, feature.second);
  }
  return out + "]";
}

std::string call_json(const std::optional<TellingApart>& call) {
  if (!call) return "null";
  return fmt::format(R"({{"auc": {:.6g}, "least": {:.6g}, "most": {:.6g}, "patches": {}, )"
                     R"("folds": {}, "features": {}}})",
                     call->auc, call->least, call->most, call->patches, call->folds,
                     features_json(call->features));
}

}  // namespace

std::string report_csv(const PictureReport& report) {
  std::string text = "kind,name,measure,value\n";
  for (const StatisticRow& row : statistic_rows()) {
    const std::pair<const char*, double> values[] = {{"first", report.real.mean.*row.of},
                                                     {"first_spread", report.real.spread.*row.of},
                                                     {"second", report.ours.mean.*row.of},
                                                     {"second_spread", report.ours.spread.*row.of}};
    for (const auto& [measure, value] : values)
      text += fmt::format("statistic,{},{},{}\n", row.key, measure, value_text(value, ""));
  }
  for (const Call* call : all_calls(report.calls)) {
    for (const bool mask : {true, false}) {
      const auto& told = mask ? call->mask : call->all;
      const TellingApart t = told.value_or(TellingApart{});
      const auto line = [&](const char* measure, double value) {
        text += fmt::format("call,{},{}_{},{}\n", call->name, mask ? "mask" : "all", measure,
                            told ? value_text(value, "") : "");
      };
      line("auc", t.auc), line("least", t.least), line("most", t.most);
    }
  }
  return text;
}

std::string report_json(const PictureReport& report) {
  std::string text = fmt::format(
      "{{\n  \"first\": {},\n  \"second\": {},\n  \"beam_deg\": {:g},\n  \"turns\": [{}, {}],\n"
      "  \"statistics\": {{",
      quoted(report.real_name), quoted(report.ours_name), report.beam_deg, report.real.turns,
      report.ours.turns);
  const char* comma = "";
  for (const StatisticRow& row : statistic_rows()) {
    text += fmt::format(
        "{}\n    \"{}\": {{\"first\": {}, \"first_spread\": {}, \"second\": {}, "
        "\"second_spread\": {}}}",
        std::exchange(comma, ","), row.key, value_text(report.real.mean.*row.of, "null"),
        value_text(report.real.spread.*row.of, "null"),
        value_text(report.ours.mean.*row.of, "null"),
        value_text(report.ours.spread.*row.of, "null"));
  }
  text += "\n  },\n  \"calls\": {";
  comma = "";
  for (const Call* call : all_calls(report.calls)) {
    text += fmt::format("{}\n    {}: {{\"mask\": {}, \"all\": {}}}", std::exchange(comma, ","),
                        quoted(call->name), call_json(call->mask), call_json(call->all));
  }
  return text + fmt::format("\n  }},\n  \"leaks\": {},\n  \"notes\": {}\n}}\n",
                            report.calls.leaks ? "true" : "false", list_json(notes_of(report)));
}

}  // namespace skerry::echo

#include "server/net/http/metrics_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>
#include <utility>

#include "protocol/wire/utf8.hpp"

namespace skerry::server {
namespace {

constexpr std::size_t kEndBytes = 512;  // of the last family and the end
static_assert(kEndBytes < MetricsText::kMaxBytes);

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlank = " \t";
  const auto begin = text.find_first_not_of(kBlank);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlank) + 1 - begin);
}

// Up to the separator, which is taken off with it.
std::string_view take_part(std::string_view& text, char separator) {
  const auto end = text.find(separator);
  const std::string_view part = trimmed(text.substr(0, end));
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  return part;
}

bool equal_without_case(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](unsigned char x, unsigned char y) {
    return std::tolower(x) == std::tolower(y);
  });
}

// One of the media ranges of an Accept header.  Source: RFC 9110, 12.5.1.
struct MediaRange {
  std::string_view type, version;
  double quality = 1.0;  // 0 .. 1; 0: not wanted
};

MediaRange read_media_range(std::string_view text) {
  MediaRange range{.type = take_part(text, ';'), .version = {}};
  while (!text.empty()) {
    std::string_view value = take_part(text, ';');
    const std::string_view name = take_part(value, '=');
    value = trimmed(value);
    if (value.size() >= 2 && value.front() == '"' && value.back() == '"') {
      value = value.substr(1, value.size() - 2);
    }
    if (equal_without_case(name, "version")) range.version = value;
    if (!equal_without_case(name, "q")) continue;
    const auto [end, error] =
        std::from_chars(value.data(), value.data() + value.size(), range.quality);
    const bool read = error == std::errc() && end == value.data() + value.size();
    if (!read || !(range.quality >= 0.0 && range.quality <= 1.0)) range.quality = 0.0;
  }
  return range;
}

std::string number_text(MetricValue value) {
  if (const auto* count = std::get_if<std::uint64_t>(&value)) return fmt::to_string(*count);
  const double number = std::get<double>(value);
  if (std::isnan(number)) return "NaN";
  if (std::isinf(number)) return number > 0 ? "+Inf" : "-Inf";
  return fmt::format("{}", number);
}

void append_escaped(std::string& out, std::string_view value) {
  for (std::size_t length = 0; !value.empty() && length < kMaxLabel; ++length) {
    const std::string_view from = value;
    const auto point = take_code_point(value);
    if (!point) value.remove_prefix(1);
    if (!point || (is_control_character(*point) && *point != '\n')) {
      out += '?';
    } else if (*point == '\n') {
      out += "\\n";
    } else {
      if (*point == '"' || *point == '\\') out += '\\';
      out += from.substr(0, from.size() - value.size());
    }
  }
}

std::string_view unit_of(std::string_view name) {
  const std::string_view word = name.substr(name.rfind('_') + 1);
  constexpr std::array<std::string_view, 3> kUnits = {"seconds", "bytes", "ratio"};
  return std::find(kUnits.begin(), kUnits.end(), word) == kUnits.end() ? std::string_view() : word;
}

}  // namespace

MetricsFormat metrics_format(std::string_view accept) {
  double openmetrics = 0.0;
  std::optional<double> plain, any_text, any;
  const auto keep = [](std::optional<double>& best, double quality) {
    best = std::max(best.value_or(0.0), quality);
  };
  while (!accept.empty()) {
    const MediaRange range = read_media_range(take_part(accept, ','));
    if (equal_without_case(range.type, "application/openmetrics-text")) {
      const bool known = range.version.empty() || range.version == "1.0.0";
      if (known) openmetrics = std::max(openmetrics, range.quality);
    } else if (equal_without_case(range.type, "text/plain")) {
      keep(plain, range.quality);
    } else if (equal_without_case(range.type, "text/*")) {
      keep(any_text, range.quality);
    } else if (range.type == "*/*") {
      keep(any, range.quality);
    }
  }
  const double text = plain.value_or(any_text.value_or(any.value_or(0.0)));
  return openmetrics > 0.0 && openmetrics >= text ? MetricsFormat::openmetrics
                                                  : MetricsFormat::prometheus;
}

std::string_view metrics_mime(MetricsFormat format) {
  return format == MetricsFormat::openmetrics
             ? "application/openmetrics-text; version=1.0.0; charset=utf-8"
             : "text/plain; version=0.0.4; charset=utf-8";
}

std::string metric_labels(std::initializer_list<MetricLabel> labels) {
  if (labels.size() == 0) return {};
  std::string out;
  for (const MetricLabel& label : labels) {
    out += out.empty() ? '{' : ',';
    out += label.name;
    out += "=\"";
    append_escaped(out, label.value);
    out += '"';
  }
  return out + '}';
}

void MetricsText::family(std::string_view name, MetricKind kind, std::string_view help) {
  name_ = name;
  kind_ = kind;
  help_ = help;
  begun_ = false;
}

std::string_view MetricsText::suffix() const {
  if (kind_ == MetricKind::counter) return "_total";
  if (kind_ == MetricKind::info) return "_info";
  return {};
}

std::string MetricsText::header() const {
  if (format_ == MetricsFormat::prometheus) {  // which knows neither units nor the last two kinds
    const std::string_view type = kind_ == MetricKind::counter ? "counter" : "gauge";
    return fmt::format("# HELP {0}{1} {2}\n# TYPE {0}{1} {3}\n", name_, suffix(), help_, type);
  }
  constexpr std::array<std::string_view, 4> kTypes = {"counter", "gauge", "info", "stateset"};
  std::string text =
      fmt::format("# TYPE {} {}\n", name_, kTypes.at(static_cast<std::size_t>(kind_)));
  if (const auto unit = unit_of(name_); !unit.empty()) {
    text += fmt::format("# UNIT {} {}\n", name_, unit);
  }
  return text + fmt::format("# HELP {} {}\n", name_, help_);
}

void MetricsText::add(std::string_view labels, MetricValue value) {
  std::string text = begun_ ? std::string() : header();
  text += fmt::format("{}{}{} {}\n", name_, suffix(), labels, number_text(value));
  if (body_.size() + text.size() + kEndBytes > kMaxBytes) {
    ++left_out_;
    return;
  }
  begun_ = true;
  body_ += text;
}

std::string MetricsText::finish() && {
  family("skerry_metrics_left_out", MetricKind::gauge, "Samples that this page had no room for.");
  body_ += header() + fmt::format("{} {}\n", name_, left_out_);
  if (format_ == MetricsFormat::openmetrics) body_ += "# EOF\n";
  return std::move(body_);
}

}  // namespace skerry::server

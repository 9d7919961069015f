// MetricsText: the two text formats that Prometheus and its kin read.
// Source: Prometheus "Exposition formats", text 0.0.4; OpenMetrics 1.0.0.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <variant>

namespace skerry::server {

enum class MetricsFormat { prometheus, openmetrics };

// The format that an Accept header asks for (several headers are joined by commas): OpenMetrics
// where it is named and not less wanted than plain text, otherwise the older format, which
// everything reads.
MetricsFormat metrics_format(std::string_view accept);
std::string_view metrics_mime(MetricsFormat format);

// A counter only grows, but may begin again at 0.
enum class MetricKind { counter, gauge, info, state_set };

// Counts are written exactly.
using MetricValue = std::variant<std::uint64_t, double>;

struct MetricLabel {
  std::string_view name;
  std::string_view value;
};

// `{radar="0",name="Tern"}`, as add() takes it; nothing without labels.  Values may be any bytes:
// what is no UTF-8 or a control character becomes '?', and kMaxLabel characters are kept.
std::string metric_labels(std::initializer_list<MetricLabel> labels);
inline constexpr std::size_t kMaxLabel = 100;

// A page in the making, one family after the other.
class MetricsText {
 public:
  // Samples beyond it are left out and counted in the page's last family.
  static constexpr std::size_t kMaxBytes = 1024 * 1024;

  explicit MetricsText(MetricsFormat format) : format_(format) {}

  // Begins a family; one without samples is not written.  `name` is new and without _total and
  // _info; its last word is its unit if that is seconds, bytes or ratio.  `help` has no line
  // breaks, quotes or backslashes.  Both outlive the family's samples.
  void family(std::string_view name, MetricKind kind, std::string_view help);
  // Labels that the family does not have yet; an info is 1.
  void add(std::string_view labels, MetricValue value);

  std::string finish() &&;

 private:
  std::string header() const;
  std::string_view suffix() const;  // of a sample's name

  MetricsFormat format_;
  std::string body_;
  std::string_view name_, help_;
  MetricKind kind_ = MetricKind::gauge;
  bool begun_ = false;  // the family's header is written
  std::uint64_t left_out_ = 0;
};

}  // namespace skerry::server

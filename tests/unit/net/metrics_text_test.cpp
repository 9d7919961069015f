// The text formats of /metrics: which one, names, labels, numbers, and how much.
#include "server/net/http/metrics_text.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <string_view>

namespace skerry::server {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(MetricsFormat, IsOpenMetricsForThoseWhoAskForIt) {
  for (const char* accept :
       {"application/openmetrics-text", "application/openmetrics-text; version=1.0.0",
        "Application/OpenMetrics-Text;Version=\"1.0.0\" ; charset=utf-8",
        "application/openmetrics-text,*/*", "text/html, application/openmetrics-text;q=0.1",
        // Prometheus 2.45 and 3.
        "application/openmetrics-text;version=1.0.0,application/"
        "openmetrics-text;version=0.0.1;q=0.75,"
        "text/plain;version=0.0.4;q=0.5,*/*;q=0.1",
        "application/openmetrics-text;version=1.0.0;escaping=allow-utf-8;q=0.6,"
        "text/plain;version=1.0.0;escaping=allow-utf-8;q=0.4,text/plain;version=0.0.4;q=0.3,*/"
        "*;q=0.2",
        "text/plain;q=0, */*, application/openmetrics-text;q=0.9"}) {
    EXPECT_EQ(metrics_format(accept), MetricsFormat::openmetrics) << accept;
  }
}

TEST(MetricsFormat, IsTheOlderOneForEverybodyElse) {
  for (const char* accept :
       {"", "*/*", "text/plain", "text/html,application/xhtml+xml,*/*;q=0.8", ",;,=;;,", "q=1",
        "application/openmetrics-text;q=0", "application/openmetrics-text;q=0.0",
        "application/openmetrics-text;q=2", "application/openmetrics-text;q=-1",
        "application/openmetrics-text;q=nan", "application/openmetrics-text;q=0.5x",
        "application/openmetrics-text;version=0.0.1", "application/openmetrics-text;version=2.0.0",
        "application/openmetrics-text;q=0.4, text/plain;q=0.5",
        "application/openmetrics-text;q=0.4, text/*", "application/openmetrics-text;q=0.4, */*"}) {
    EXPECT_EQ(metrics_format(accept), MetricsFormat::prometheus) << accept;
  }
}

TEST(MetricLabels, AreEscaped) {
  EXPECT_EQ(metric_labels({}), "");
  EXPECT_EQ(metric_labels({{"name", "Tern"}}), "{name=\"Tern\"}");
  EXPECT_EQ(metric_labels({{"a", ""}, {"b", "} x{,="}}), "{a=\"\",b=\"} x{,=\"}");
  EXPECT_EQ(metric_labels({{"a", "say \"no\"\\\nnever"}}), R"({a="say \"no\"\\\nnever"})");
  EXPECT_EQ(metric_labels({{"a", "\\n"}}), R"({a="\\n"})") << "no line break, before or after";
}

TEST(MetricLabels, AreAlwaysUtf8WithoutControlCharacters) {
  EXPECT_EQ(metric_labels({{"a", "Fj\u00f8rd \u6d77 \U0001F6A2"}}),
            "{a=\"Fj\u00f8rd \u6d77 \U0001F6A2\"}");
  EXPECT_EQ(metric_labels({{"a", "a\x80z"}}), "{a=\"a?z\"}");
  EXPECT_EQ(metric_labels({{"a", "\xc3"}}), "{a=\"?\"}");
  EXPECT_EQ(metric_labels({{"a", "\xc0\xaf"}}), "{a=\"??\"}") << "longer than it need be";
  EXPECT_EQ(metric_labels({{"a", "\xed\xa0\x80"}}), "{a=\"???\"}") << "a surrogate";
  EXPECT_EQ(metric_labels({{"a", std::string_view("\r\0\x1b\x7f\xc2\x85", 6)}}), "{a=\"?????\"}");
}

TEST(MetricLabels, AreCutAtACharacterAfterSoMany) {
  const auto label_of = [](const std::string& value) { return metric_labels({{"a", value}}); };
  EXPECT_EQ(label_of(std::string(5000, 'x')), "{a=\"" + std::string(kMaxLabel, 'x') + "\"}");
  std::string two_bytes, escaped;
  for (std::size_t i = 0; i < kMaxLabel; ++i) {
    two_bytes += "\u00f8";
    escaped += R"(\")";
  }
  EXPECT_EQ(label_of(two_bytes + "\u00f8"), "{a=\"" + two_bytes + "\"}");
  EXPECT_EQ(label_of(std::string(5000, '"')), "{a=\"" + escaped + "\"}");
}

constexpr std::string_view kNothingLeftOut =
    "# HELP skerry_metrics_left_out Samples that this page had no room for.\n"
    "# TYPE skerry_metrics_left_out gauge\n"
    "skerry_metrics_left_out 0\n";

void write_each_kind(MetricsText& text) {
  text.family("a_sent_bytes", MetricKind::counter, "Sent.");
  text.add("{to=\"b\"}", std::uint64_t{18'446'744'073'709'551'615u});
  text.add("{to=\"c\"}", std::uint64_t{0});
  text.family("a_never", MetricKind::gauge, "Of this there is none.");
  text.family("a_seconds", MetricKind::gauge, "Up.");
  text.add("", 0.1);
  text.family("a_build", MetricKind::info, "What it is.");
  text.add("{is=\"x\"}", std::uint64_t{1});
  text.family("a_phase", MetricKind::state_set, "Where it is.");
  text.add("{a_phase=\"on\"}", std::uint64_t{1});
}

TEST(MetricsText, WritesThePrometheusFormat) {
  MetricsText text(MetricsFormat::prometheus);
  write_each_kind(text);
  EXPECT_EQ(std::move(text).finish(),
            "# HELP a_sent_bytes_total Sent.\n"
            "# TYPE a_sent_bytes_total counter\n"
            "a_sent_bytes_total{to=\"b\"} 18446744073709551615\n"
            "a_sent_bytes_total{to=\"c\"} 0\n"
            "# HELP a_seconds Up.\n"
            "# TYPE a_seconds gauge\n"
            "a_seconds 0.1\n"
            "# HELP a_build_info What it is.\n"
            "# TYPE a_build_info gauge\n"
            "a_build_info{is=\"x\"} 1\n"
            "# HELP a_phase Where it is.\n"
            "# TYPE a_phase gauge\n"
            "a_phase{a_phase=\"on\"} 1\n" +
                std::string(kNothingLeftOut));
}

TEST(MetricsText, WritesOpenMetrics) {
  MetricsText text(MetricsFormat::openmetrics);
  write_each_kind(text);
  EXPECT_EQ(std::move(text).finish(),
            "# TYPE a_sent_bytes counter\n"
            "# UNIT a_sent_bytes bytes\n"
            "# HELP a_sent_bytes Sent.\n"
            "a_sent_bytes_total{to=\"b\"} 18446744073709551615\n"
            "a_sent_bytes_total{to=\"c\"} 0\n"
            "# TYPE a_seconds gauge\n"
            "# UNIT a_seconds seconds\n"
            "# HELP a_seconds Up.\n"
            "a_seconds 0.1\n"
            "# TYPE a_build info\n"
            "# HELP a_build What it is.\n"
            "a_build_info{is=\"x\"} 1\n"
            "# TYPE a_phase stateset\n"
            "# HELP a_phase Where it is.\n"
            "a_phase{a_phase=\"on\"} 1\n"
            "# TYPE skerry_metrics_left_out gauge\n"
            "# HELP skerry_metrics_left_out Samples that this page had no room for.\n"
            "skerry_metrics_left_out 0\n"
            "# EOF\n");
}

TEST(MetricsText, NumbersThatAreNoneAreNamed) {
  MetricsText text(MetricsFormat::prometheus);
  text.family("a", MetricKind::gauge, "Any.");
  text.add("{b=\"1\"}", std::nan(""));
  text.add("{b=\"2\"}", std::numeric_limits<double>::infinity());
  text.add("{b=\"3\"}", -std::numeric_limits<double>::infinity());
  text.add("{b=\"4\"}", -1e-9);
  EXPECT_THAT(std::move(text).finish(),
              HasSubstr("a{b=\"1\"} NaN\na{b=\"2\"} +Inf\na{b=\"3\"} -Inf\na{b=\"4\"} -1e-09\n"));
}

TEST(MetricsText, IsBoundedAndSaysWhatIsMissing) {
  for (const auto format : {MetricsFormat::prometheus, MetricsFormat::openmetrics}) {
    MetricsText text(format);
    text.family("a", MetricKind::counter, "Many.");
    const std::size_t added = 20'000;  // of over 100 bytes each
    for (std::size_t i = 0; i < added; ++i) {
      text.add(metric_labels({{"n", std::to_string(i)}, {"x", std::string(200, 'x')}}),
               std::uint64_t{i});
    }
    text.family("b", MetricKind::gauge,
                std::string_view("One that comes too late, however short it is."));
    text.add(metric_labels({{"x", std::string(200, 'x')}}), 1.0);
    const std::string page = std::move(text).finish();
    EXPECT_LE(page.size(), MetricsText::kMaxBytes);
    EXPECT_GT(page.size(), MetricsText::kMaxBytes - 2000);
    std::size_t samples = 0;
    for (auto at = page.find("\na_total{"); at != std::string::npos;
         at = page.find("\na_total{", at + 1)) {
      ++samples;
    }
    EXPECT_THAT(
        page, HasSubstr("\nskerry_metrics_left_out " + std::to_string(added + 1 - samples) + "\n"));
    EXPECT_THAT(page, Not(HasSubstr("too late"))) << "no header without a sample";
    const bool ends = format == MetricsFormat::openmetrics;
    EXPECT_EQ(page.ends_with("\n# EOF\n"), ends);
  }
}

}  // namespace
}  // namespace skerry::server

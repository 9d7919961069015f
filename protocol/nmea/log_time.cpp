#include "protocol/nmea/log_time.hpp"

#include <cstdint>

namespace skerry::nmea {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;

// Reads a text from its begin on; once something is not there, nothing more is.
class TimeText {
 public:
  explicit TimeText(std::string_view text) : text_(text) {}

  bool good() const { return good_; }
  std::size_t at() const { return at_; }

  // Of just that many digits.
  std::int64_t digits(std::size_t count) {
    std::int64_t value = 0;
    for (std::size_t i = 0; i < count; ++i) {
      if (!is_digit(at_)) return fail();
      value = value * 10 + (text_[at_++] - '0');
    }
    return value;
  }
  std::int64_t digits(std::size_t count, std::int64_t least, std::int64_t most) {
    const std::int64_t value = digits(count);
    return good_ && (value < least || value > most) ? fail() : value;
  }
  void one_of(std::string_view allowed) {
    if (at_ >= text_.size() || allowed.find(text_[at_]) == std::string_view::npos) fail();
    if (good_) ++at_;
  }
  bool next_is(std::string_view allowed) const {
    return good_ && at_ < text_.size() && allowed.find(text_[at_]) != std::string_view::npos;
  }
  // ".25" as nanoseconds; 0 if there is none.
  std::int64_t fraction_ns() {
    if (!next_is(".") || !is_digit(at_ + 1)) return 0;
    ++at_;
    std::int64_t value = 0, scale = kSecond_ns;
    for (; is_digit(at_); ++at_) {
      if (scale > 1) {
        scale /= 10;
        value += scale * (text_[at_] - '0');
      }
    }
    return value;
  }
  std::size_t digits_ahead() const {
    std::size_t end = at_;
    while (is_digit(end)) ++end;
    return end - at_;
  }

 private:
  bool is_digit(std::size_t at) const {
    return good_ && at < text_.size() && text_[at] >= '0' && text_[at] <= '9';
  }
  std::int64_t fail() {
    good_ = false;
    return 0;
  }

  std::string_view text_;
  std::size_t at_ = 0;
  bool good_ = true;
};

std::optional<LogTime> within(std::int64_t seconds, std::int64_t ns, std::size_t length) {
  // In whole seconds: a year before 1678 or after 2262 has no nanoseconds since 1970.
  constexpr auto seconds_of = [](UtcTime utc) {
    return std::chrono::floor<std::chrono::seconds>(utc.time_since_epoch()).count();
  };
  if (seconds < seconds_of(kFirstLogTime) || seconds >= seconds_of(kAfterLogTimes)) {
    return std::nullopt;
  }
  return LogTime{UtcTime(Duration(seconds * kSecond_ns + ns)), length};
}

std::optional<LogTime> epoch(std::string_view text) {
  TimeText in(text);
  const std::size_t count = in.digits_ahead();
  if (count != 9 && count != 10 && count != 13) return std::nullopt;
  const std::int64_t value = in.digits(count);
  if (count == 13) return within(value / 1000, value % 1000 * 1'000'000, in.at());
  const std::int64_t ns = in.fraction_ns();
  return within(value, ns, in.at());
}

std::optional<LogTime> calendar(std::string_view text, bool year_first) {
  TimeText in(text);
  std::int64_t year = 0, month = 0, day = 0;
  if (year_first) {
    year = in.digits(4);
    in.one_of("-/");
    month = in.digits(2, 1, 12);
    in.one_of("-/");
    day = in.digits(2, 1, 31);
    in.one_of("T ");
  } else {
    day = in.digits(2, 1, 31);
    in.one_of("/");
    month = in.digits(2, 1, 12);
    in.one_of("/");
    year = in.digits(4);
    in.one_of(" T");
  }
  const std::int64_t hour = in.digits(2, 0, 23);
  in.one_of(":");
  const std::int64_t minute = in.digits(2, 0, 59);
  in.one_of(":");
  const std::int64_t second = in.digits(2, 0, 60);  // 60: a leap second
  const std::int64_t ns = in.fraction_ns();
  std::int64_t zone_s = 0;
  if (in.next_is("Z")) {
    in.one_of("Z");
  } else if (in.next_is("+-")) {
    const std::int64_t sign = in.next_is("-") ? -1 : 1;
    in.one_of("+-");
    zone_s = sign * 3600 * in.digits(2, 0, 14);
    if (in.next_is(":")) in.one_of(":");
    zone_s += sign * 60 * in.digits(2, 0, 59);
  }
  if (!in.good()) return std::nullopt;
  const std::chrono::year_month_day date{std::chrono::year(static_cast<int>(year)),
                                         std::chrono::month(static_cast<unsigned>(month)),
                                         std::chrono::day(static_cast<unsigned>(day))};
  if (!date.ok()) return std::nullopt;
  const std::int64_t days = std::chrono::sys_days(date).time_since_epoch().count();
  return within(days * 86'400 + hour * 3600 + minute * 60 + second - zone_s, ns, in.at());
}

}  // namespace

std::optional<LogTime> read_log_time(std::string_view text) {
  if (auto time = calendar(text, true)) return time;
  if (auto time = calendar(text, false)) return time;
  return epoch(text);
}

std::optional<UtcTime> log_time_of(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  const auto time = read_log_time(text);
  if (!time || time->length != text.size()) return std::nullopt;
  return time->utc;
}

}  // namespace skerry::nmea

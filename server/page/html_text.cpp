#include "server/page/html_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "protocol/quantity/angle.hpp"

namespace skerry::server {
namespace {

// Octets of the well-formed UTF-8 sequence at `at`; 0 if there is none.
std::size_t sequence_at(std::string_view text, std::size_t at) {
  const auto octet = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = octet(at);
  std::size_t length = 0;
  unsigned char least = 0x80, most = 0xBF;  // of the second
  if (first < 0x80) return 1;
  if (first >= 0xC2 && first <= 0xDF) length = 2;
  if (first >= 0xE0 && first <= 0xEF) {
    length = 3;
    if (first == 0xE0) least = 0xA0;
    if (first == 0xED) most = 0x9F;
  }
  if (first >= 0xF0 && first <= 0xF4) {
    length = 4;
    if (first == 0xF0) least = 0x90;
    if (first == 0xF4) most = 0x8F;
  }
  if (length == 0 || at + length > text.size()) return 0;
  if (octet(at + 1) < least || octet(at + 1) > most) return 0;
  for (std::size_t i = 2; i < length; ++i) {
    if (octet(at + i) < 0x80 || octet(at + i) > 0xBF) return 0;
  }
  return length;
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = sequence_at(text, i);
    const char c = text[i];
    if (length == 0 ||
        (length == 1 && static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t') ||
        c == 0x7F) {
      out += "\xEF\xBF\xBD";
      ++i;
      continue;
    }
    if (c == '&') {
      out += "&amp;";
    } else if (c == '<') {
      out += "&lt;";
    } else if (c == '>') {
      out += "&gt;";
    } else if (c == '"') {
      out += "&quot;";
    } else if (c == '\'') {
      out += "&#39;";
    } else {
      out.append(text, i, length);
    }
    i += length;
  }
  return out;
}

std::string clock_text(double seconds) {
  const auto whole = static_cast<std::int64_t>(std::floor(std::max(0.0, seconds) + 1e-6));
  if (whole < 3600) return fmt::format("{}:{:02}", whole / 60, whole % 60);
  return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

std::string bearing_text(double degrees) {
  return fmt::format("{:03.0f}°", std::fmod(std::round(wrapped_degrees(degrees)), 360.0));
}

HtmlTable::HtmlTable(const std::vector<std::string>& columns, std::string_view id) {
  text_ = id.empty() ? std::string("<div class=\"wide\"><table><thead><tr>")
                     : fmt::format("<div class=\"wide\"><table id=\"{}\"><thead><tr>", id);
  for (const std::string& column : columns) {
    const bool number = column.starts_with('#');
    numbers_.push_back(number);
    text_ += fmt::format("<th{}>{}</th>", number ? " class=\"n\"" : "",
                         escaped(number ? column.substr(1) : column));
  }
  text_ += "</tr></thead><tbody>";
}

void HtmlTable::begin_row(std::string_view kind) {
  if (rows_++ > 0) text_ += "</tr>";
  text_ += kind.empty() ? std::string("\n<tr>") : fmt::format("\n<tr class=\"{}\">", kind);
  column_ = 0;
}

void HtmlTable::add_html(std::string_view html) {
  const bool number = column_ < numbers_.size() && numbers_[column_];
  ++column_;
  text_ += number ? "<td class=\"n\">" : "<td>";
  text_ += html;
  text_ += "</td>";
}

std::string HtmlTable::html() const {
  return text_ + (rows_ > 0 ? "</tr>" : "") + "</tbody></table></div>\n";
}

}  // namespace skerry::server

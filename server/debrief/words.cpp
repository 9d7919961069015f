#include "server/debrief/words.hpp"

#include <fmt/format.h>

#include <cmath>

namespace skerry::server {

std::string miles_text(double metres) {
  const double miles = metres / 1852.0;
  if (miles >= 0.1) return fmt::format("{:.2f} NM", miles);
  return fmt::format("{:.2f} NM ({:.0f} m)", miles, metres);
}

std::string place_text(GeoPoint place) {
  return fmt::format("{:.5f}, {:.5f}", place.latitude_deg, place.longitude_deg);
}

const char* kind_of(const Contact& contact) {
  return contact.kind == Contact::Kind::collision ? "collision" : "grounding";
}

std::string words_for(const Contact& contact) {
  return contact.kind == Contact::Kind::collision
             ? fmt::format("collision of {} and {}", contact.own_name, contact.other_name)
             : fmt::format("{} aground: {}", contact.own_name, contact.why);
}

std::string side_text(const ShipPassing& passing) {
  const auto side = [](double relative_deg) {
    if (std::fabs(relative_deg) <= 20.0) return "ahead";
    if (std::fabs(relative_deg) >= 160.0) return "astern";
    return relative_deg > 0.0 ? "starboard" : "port";
  };
  return fmt::format("{} to {}", side(passing.own_side_deg), side(passing.other_side_deg));
}

const char* ending_text(const KnownTarget& target) {
  if (target.lost) return "lost";
  return target.to_the_end ? "told to the end" : "let go";
}

std::vector<std::string> moment_columns(const Debrief& debrief, std::vector<std::string> more) {
  std::vector<std::string> all = {"#time"};
  if (!debrief.has_one_clock) all.emplace_back("#exercise");
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

void add_moment(const Debrief& debrief, const Moment& when, HtmlTable& table) {
  table.add(clock_text(when.at_s));
  if (!debrief.has_one_clock) table.add(clock_text(when.exercise_s));
}

std::string class_of(std::string_view kind) {
  std::string letters;
  for (const char c : kind) {
    if ((c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z')) letters += c;
  }
  return letters;
}

std::string shortened(std::string_view text, std::size_t octets) {
  if (text.size() <= octets) return std::string(text);
  while (octets > 0 && (static_cast<unsigned char>(text[octets]) & 0xC0) == 0x80) --octets;
  return std::string(text.substr(0, octets)) + "...";
}

}  // namespace skerry::server

#include "server/plotter/tracks/tracker.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <string_view>
#include <utility>

#include "server/plotter/tracks/book.hpp"

namespace skerry::server {
namespace {

void check(double value, double least, double most, std::string_view name) {
  if (!(value >= least && value <= most)) {
    throw std::invalid_argument(fmt::format("{}: {} is not {} to {}", name, value, least, most));
  }
}

void check_rule(const Tracker::Rule& rule) {
  check(rule.most_tracks, 1, 1000, "most_tracks");
  check(rule.least_speed_kn, 0, 20, "least_speed_kn");
  check(rule.fastest_kn, 10, 200, "fastest_kn");
  check(rule.furthest_nm, 0.1, 120, "furthest_nm");
  check(rule.sure_bits, 3, 24, "sure_bits");
  check(rule.least_hits, 3, 20, "least_hits");
  check(rule.bearing_sigma_deg, 0, 5, "bearing_sigma_deg");
  check(rule.range_sigma_m, 0, 200, "range_sigma_m");
}

}  // namespace

Tracker::Tracker(const Rule& rule) {
  check_rule(rule);
  book_ = std::make_unique<Book>(rule);
}
Tracker::~Tracker() = default;
Tracker::Tracker(Tracker&&) noexcept = default;
Tracker& Tracker::operator=(Tracker&&) noexcept = default;

void Tracker::add(const Plot& plot) { book_->add(plot); }
void Tracker::pass(const AntennaPass& antenna) { book_->pass(antenna); }
std::vector<PlottedTrack> Tracker::tracks() const { return book_->tracks(); }
std::vector<PlottedTrack> Tracker::take_lost() { return book_->take_lost(); }
std::uint32_t Tracker::acquire(GeoPoint place, double within_m) {
  return book_->acquire(place, within_m);
}
void Tracker::change(const Rule& rule) {
  check_rule(rule);
  book_->change(rule);
}
void Tracker::set_areas(std::vector<Area> areas) { book_->set_areas(std::move(areas)); }
bool Tracker::cancel(std::uint32_t number) { return book_->cancel(number); }
Tracker::Counts Tracker::counts() const { return book_->counts(); }

}  // namespace skerry::server

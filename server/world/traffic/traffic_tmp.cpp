#include "server/world/traffic/new_target.hpp"
#include "server/world/traffic/traffic.hpp"
#include "server/world/radar_sets.hpp"
#include "server/world/target_track.hpp"
namespace skerry::server {
struct Traffic::Ship { TargetTrack way; std::size_t number; RadarSetPtr radar; };
class Traffic::Kept {};
Traffic::Traffic(const scenario::Scenario& s) { for (int i=0;i<s.targets_size();++i) if (s.targets(i).kind()==scenario::Target::ship) {
  RadarSetPtr radar; if (s.targets(i).has_radar()) radar = std::make_shared<const echo::RadarSet>(*shipped_set(s.targets(i).radar()));
  ships_[static_cast<std::size_t>(i)] = std::make_shared<Ship>(Ship{TargetTrack(s.targets(i)), static_cast<std::size_t>(i), radar}); } }
Traffic::~Traffic() = default; Traffic::Traffic(const Traffic&)=default; Traffic& Traffic::operator=(const Traffic&)=default;
void Traffic::step(Duration, Duration, const std::vector<ShipState>&, const Environment&) {}
std::vector<ShipState> Traffic::states(Duration now) const { std::vector<ShipState> out; for (auto& [n,s] : ships_) { out.push_back(s->way.at(now)); out.back().number=n; out.back().radar=s->radar; } return out; }
std::optional<std::string> Traffic::fault_of(const wire::TargetChange& c) const { if (has(c.target())) return std::nullopt; return "target: none"; }
void Traffic::order(const wire::TargetChange&, Duration) {}
void Traffic::add(const scenario::Target& t, std::size_t n, Duration) { ships_[n] = std::make_shared<Ship>(Ship{TargetTrack(t), n, nullptr}); }
void Traffic::tell(std::size_t, Duration, wire::ExerciseShip&) const {}
bool Traffic::has(std::size_t n) const { return ships_.contains(n); }
std::shared_ptr<const Traffic::Kept> Traffic::keep(std::size_t) const { return std::make_shared<const Kept>(); }
void Traffic::put_back(const Kept&) {}
std::optional<std::string> fault_of(const wire::NewTarget&) { return std::nullopt; }
scenario::Target target_of(const wire::NewTarget& w) { scenario::Target t; t.set_name(w.name()); t.mutable_position()->set_lat(w.latitude_deg()); t.mutable_position()->set_lon(w.longitude_deg()); t.set_course_deg(w.course_deg()); t.set_speed_kn(w.speed_kn()); t.set_length_m(60); t.set_beam_m(11); t.set_height_m(10); return t; }
}

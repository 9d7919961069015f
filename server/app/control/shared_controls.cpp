// What of the desk's work hosts of a fleet share.
#include <algorithm>
#include <initializer_list>
#include <set>
#include <utility>
#include <vector>

#include "server/app/control/control_desk.hpp"
#include "server/app/control/controls_message.hpp"

namespace skerry::server {
namespace {

using google::protobuf::FieldDescriptor;

// Unlike the controls of a fresh radar in all of them.  A control that is added to RadarControls
// must be added here, or hosts of a fleet do not share it where it is set to what a fresh radar
// has.
const echo::RadarControls kOther{.transmit = false,
                                 .pulse = echo::PulseChoice::short_pulse,
                                 .tune_auto = false,
                                 .tune = 1.0,
                                 .rotation_rpm = 1.0,
                                 .bearing_alignment_deg = 1.0,
                                 .antenna_height_m = 1.0,
                                 .blanked = {{}}};

bool is_one_of(const FieldDescriptor& field, std::initializer_list<int> numbers) {
  return std::find(numbers.begin(), numbers.end(), field.number()) != numbers.end();
}

// Where it goes and who asks.
bool is_address(const FieldDescriptor& field) {
  return is_one_of(field, {wire::Set::kRadarFieldNumber, wire::Set::kViewFieldNumber,
                           wire::Set::kTokenFieldNumber, wire::Set::kInstructorFieldNumber});
}
bool is_of_ship_or_world(const FieldDescriptor& field) {
  return is_one_of(field, {wire::Set::kCourseDegFieldNumber, wire::Set::kSpeedKnFieldNumber,
                           wire::Set::kConFieldNumber, wire::Set::kWorldFieldNumber,
                           wire::Set::kExerciseFieldNumber, wire::Set::kLockFieldNumber,
                           wire::Set::kUnlockFieldNumber});
}

// `one` has a single control.  It is a radar's if it changes a fresh radar's controls or kOther's,
// which differ in each: a value can equal only one of the two.  A view's control changes neither.
bool changes_a_radar(const wire::Set& one) {
  const auto changes = [&](const echo::RadarControls& before) {
    echo::RadarControls after = before;
    change_radar(one, after);
    return after != before;
  };
  return changes({}) || changes(kOther);
}

std::vector<const FieldDescriptor*> fields_of(const google::protobuf::Message& message) {
  std::vector<const FieldDescriptor*> fields;
  message.GetReflection()->ListFields(message, &fields);
  return fields;
}

// Both begin as `set`.  Leaves in `shared` what is of radars, own ships and the world, in `own`
// what is of a view.
void split(const wire::Set& set, wire::Set& shared, wire::Set& own) {
  for (const FieldDescriptor* field : fields_of(set)) {
    if (is_address(*field) || field->number() == wire::Set::kControlsFieldNumber) continue;
    wire::Set one = set;
    for (const FieldDescriptor* other : fields_of(set)) {
      if (other != field) one.GetReflection()->ClearField(&one, other);
    }
    const bool is_shared = is_of_ship_or_world(*field) || changes_a_radar(one);
    wire::Set& without = is_shared ? own : shared;
    without.GetReflection()->ClearField(&without, field);
  }
  for (const FieldDescriptor* field : fields_of(set.controls())) {
    wire::Set one;
    *one.mutable_controls() = set.controls();
    for (const FieldDescriptor* other : fields_of(set.controls())) {
      if (other != field) one.controls().GetReflection()->ClearField(one.mutable_controls(), other);
    }
    wire::Set& without = changes_a_radar(one) ? own : shared;
    without.controls().GetReflection()->ClearField(without.mutable_controls(), field);
  }
  for (wire::Set* each : {&shared, &own}) {
    if (each->has_controls() && fields_of(each->controls()).empty()) each->clear_controls();
  }
}

std::optional<wire::Set> unless_empty(wire::Set set) {
  const auto fields = fields_of(set);
  const bool says = std::any_of(fields.begin(), fields.end(),
                                [](const FieldDescriptor* field) { return !is_address(*field); });
  return says ? std::optional(std::move(set)) : std::nullopt;
}

}  // namespace

bool ControlDesk::has_a_con(const std::string& origin) const {
  const std::lock_guard lock(mutex_);
  for (std::size_t ship = 0; ship < cons_.size(); ++ship) {
    if (cons_.holder(ship) == origin) return true;
  }
  return false;
}

void ControlDesk::leave_all(const std::string& ending) {
  std::set<std::string> origins;
  {
    const std::lock_guard lock(mutex_);
    for (std::size_t ship = 0; ship < cons_.size(); ++ship) {
      if (cons_.holder(ship).ends_with(ending)) origins.insert(cons_.holder(ship));
    }
  }
  for (const std::string& origin : origins) leave(origin);
}

ControlDesk::Parts ControlDesk::parts_of(const wire::Set& set) const {
  wire::Set shared = set;
  shared.clear_token();
  const RadarViewPtr view = set.view() != 0 && set.radar() < units_.size()
                                ? units_[set.radar()]->views().find(set.view())
                                : RadarViewPtr();
  if (set.view() == 0) return {std::move(shared), std::nullopt};
  if (!view) return {std::nullopt, set};  // which is refused
  wire::Set own = set;
  shared.clear_view();
  if (view->follows() && view->followed->number == 0) {
    // All but its own instrumented range is the shared view's.
    own.Clear();
    own.set_radar(set.radar());
    own.set_view(set.view());
    own.set_instructor(set.instructor());
    if (set.has_instrumented_range_m()) own.set_instrumented_range_m(set.instrumented_range_m());
    shared.clear_instrumented_range_m();
  } else {
    split(set, shared, own);
  }
  Parts parts{unless_empty(std::move(shared)), unless_empty(std::move(own))};
  if (!parts.shared && !parts.own) parts.own = set;
  return parts;
}

ControlDesk::Kept ControlDesk::kept() const {
  const std::lock_guard lock(mutex_);
  Kept kept{cons_, locks_.all(), {}, {}};
  for (const RadarUnit* unit : units_) {
    kept.views.push_back(*unit->views().get()->front()->controls.get());
    kept.radars.push_back(unit->radar_controls());
  }
  return kept;
}

void ControlDesk::restore(const Kept& kept) {
  const std::lock_guard lock(mutex_);
  cons_ = kept.cons;
  locks_.set_all(kept.locks);
  for (std::size_t radar = 0; radar < units_.size(); ++radar) {
    put_view(*units_[radar], *units_[radar]->views().get()->front(), kept.views[radar]);
    units_[radar]->set_radar_controls(kept.radars[radar]);
  }
  settings_version_.fetch_add(1);
  world_version_.fetch_add(1);
}

}  // namespace skerry::server

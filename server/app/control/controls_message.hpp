// The controls of views and radars as messages have them.
#pragma once

#include "echo/receiver/controls.hpp"
#include "protocol/wire/radar.pb.h"
#include "protocol/wire/spoke_message.hpp"

namespace skerry::server {

// Changes what is present in `set` and is of a view; the rest stays.  Requires numbers that
// refusal_of() lets through.  Another range scale without an instrumented range takes the
// instrumented range with it: it stays the same multiple of the range scale.
void change_view(const wire::Set& set, echo::ViewControls& controls);

// The same of a radar.
void change_radar(const wire::Set& set, echo::RadarControls& controls);

// The other way round: every field of Settings that a Set can change.
void tell_view(const echo::ViewControls& controls, wire::Settings& settings);
// `set`: what holds where the controls leave it to the set.
void tell_radar(const echo::RadarControls& controls, const echo::RadarSet& set,
                wire::Settings& settings);

// The same multiple of another range scale.
double carried_range_m(double instrumented_range_m, RangeScale from, RangeScale to);
bool is_instrumented_range(double range_m, RangeScale scale);

}  // namespace skerry::server

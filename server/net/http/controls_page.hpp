// The page /controls.json: the schema of controls as the web console builds its panel and messages
// from it.
#pragma once

#include <string>

#include "protocol/wire/schema.hpp"

namespace skerry::server {

// {"controls": [...], "artefacts": [...], "faults": [...]}, one object for each field of the three
// schemas, in their order; members that say nothing are left out.
//   name, field   the field's name as JSON has it and as locks have it: "rangeNm", "range_nm"
//   number        in the schema's message; set, settings: that of the field of its own which Set
//   and Settings
//                 (WorldChange and World) have, absent where it travels in their message `controls`
//                 (`artefacts`)
//   type          "number", "switch", "choice" or "message"
//   min, max, oneOf, default, step, unit; choices: [{value, label}]
//   label, title (a tooltip), panel, row, lock; automaticOf: the control that this switch makes
//   automatic; group, of faults: what aboard is at fault
std::string controls_page(const wire::Descriptor& controls, const wire::Descriptor& artefacts,
                          const wire::Descriptor& faults);

// The page of wire::Controls, wire::Artefacts and wire::Faults.
const std::string& controls_page();

}  // namespace skerry::server

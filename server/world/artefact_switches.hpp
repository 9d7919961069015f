// The echo's artefact switches <-> messages that carry them: a scenario, World, WorldChange.
#pragma once

#include "echo/scene/artefacts.hpp"
#include "protocol/wire/controls.pb.h"
#include "protocol/wire/schema.hpp"

namespace skerry::server {

// Calls visit(row, field of the schema) for every switch.  Held complete by control_schema_test.
template <typename Visit>
void for_each_artefact(Visit visit,
                       const wire::Descriptor& schema = *wire::Artefacts::descriptor()) {
  for (const echo::ArtefactRow& row : echo::kArtefactRows) {
    const auto* const field = schema.FindFieldByName(std::string(row.name));
    if (field != nullptr) visit(row, *field);
  }
}

// Changes the switches that are present in the message.
inline void change_artefacts(const wire::Message& message, echo::Artefacts& artefacts) {
  for_each_artefact([&](const echo::ArtefactRow& row, const wire::FieldDescriptor& field) {
    if (const auto on = wire::value_of(message, field)) artefacts.*row.on = *on != 0.0;
  });
}

inline void tell_artefacts(const echo::Artefacts& artefacts, wire::Message& message) {
  for_each_artefact([&](const echo::ArtefactRow& row, const wire::FieldDescriptor& field) {
    wire::put_value(message, field, artefacts.*row.on ? 1.0 : 0.0);
  });
}

}  // namespace skerry::server

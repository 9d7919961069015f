// import.json: what a recording says of the capture it was made of.
#pragma once

#include "protocol/captures/importer.hpp"

namespace skerry::captures {

inline constexpr const char* kImportNotes = "import.json";

recording::Attachment import_notes(const ImportReport& report, const std::string& capture,
                                   UtcTime time);

}  // namespace skerry::captures

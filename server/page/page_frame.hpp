// The page's style and script.
#pragma once

namespace skerry::server {

extern const char* const kPageStyle;
extern const char* const kPageScript;

}  // namespace skerry::server

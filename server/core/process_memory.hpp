// Memory of this process, for the status message.
#pragma once

namespace skerry::server {

// Resident set of this process in MiB; 0 where /proc/self/statm cannot be read.  Thread: any.
double resident_mib();

}  // namespace skerry::server

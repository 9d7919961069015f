// A file that is whole gets its name.
#pragma once

#include <string>

namespace skerry::recording {

// Renames `part` to `place`, in the same folder.  What is there already stays unless `replace`: at
// once and whatever others do where the file system can (RENAME_NOREPLACE); on others (FAT, NFS,
// FUSE) it is looked for just before.  0, or errno: then `part` is still there; EEXIST: `place` is.
// Thread: any.
int put_in_place(const std::string& part, const std::string& place, bool replace);

}  // namespace skerry::recording

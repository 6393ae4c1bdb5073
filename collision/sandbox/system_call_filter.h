// Takes rights from a process that reads a stranger's file.
#pragma once

namespace twinarm {

// From here on this process can start no program or process, open no connection, and create, change
// or remove no file: such system calls fail with EPERM. It may read files and write to what is
// open. Cannot be undone. (seccomp(2); our own filter, as a library for it would become a
// dependency of all who link this one.)
void forbid_side_effects();

}  // namespace twinarm

// The seccomp filter of a confined process. It lists what is refused, so that interpreters of any kind run; system
// calls that are newer than this list are unknown to the process (ENOSYS), as on an older kernel.
#pragma once

namespace passo {

// Filters the system calls of this process and of those that it starts. Needs PR_SET_NO_NEW_PRIVS. Returns false if the
// kernel refuses; errno then has the reason.
bool filter_system_calls(bool may_start_processes);

}  // namespace passo

"""Peak memory of a process."""

import resource
import sys
from pathlib import Path


def peak():
    """The most memory that this process has ever held, in kB.

    Linux's ``ru_maxrss`` counts what its parent held when it was started, and so would hide what is looked for.
    """
    status = Path("/proc/self/status")
    if status.exists():
        return int(status.read_text().split("VmHWM:")[1].split()[0])
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss // (1024 if sys.platform == "darwin" else 1)

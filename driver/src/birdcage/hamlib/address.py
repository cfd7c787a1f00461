"""Where a rotctld is: `rotctl://host:port`, and what is dialled for it."""

from __future__ import annotations

from urllib.parse import urlsplit

from birdcage.base.errors import LinkError
from birdcage.base.reason import Reason

SCHEME = "rotctl"
DEFAULT_PORT = 4533
"""Of Hamlib's rotctld (`docs/reference/rotctl.md`, *Address*)."""


def dialled(address: str) -> str:
    """Return what to open for an address: `socket://host:port` for one of this scheme, any other port as it is.

    LinkError for an address without a host, or with a port that is none.
    """
    if not address.lower().startswith(f"{SCHEME}:"):
        return address
    try:
        parts = urlsplit(address)
        host, port = parts.hostname, parts.port
    except ValueError:
        host = port = None
    else:
        port = DEFAULT_PORT if port is None else port
    if not host or not port:
        raise LinkError(
            f"{address}: write it as {SCHEME}://host or {SCHEME}://host:port, the port from 1 to 65535.",
            reason=Reason.UNSUPPORTED,
        )
    return f"socket://[{host}]:{port}" if ":" in host else f"socket://{host}:{port}"

"""What the library inside the package was built with."""

from __future__ import annotations

from . import _lacuna

# Licences of what a build may be linked with; docs/architecture.md says what each is for.
_LICENCES = {
    "Ceres": "BSD-3-Clause; brings SuiteSparse",
    "NLopt": "MIT, parts LGPL-2.1-or-later",
    "CHOLMOD": "LGPL-2.1-or-later, supernodal part GPL-2.0-or-later",
    "SUNDIALS": "BSD-3-Clause",
    "matio": "BSD-2-Clause",
    "HDF5": "BSD-3-Clause",
    "expat": "MIT",
}
_GPL = ("Ceres", "CHOLMOD")


def build_info() -> dict[str, object]:
    """Version, compiler and optional libraries of this build.

    Returns
    -------
    dict
        ``version``, ``compiler``, ``libraries`` (name and licence of each optional one that is
        linked) and ``gpl``: names of those that are, or bring, parts under the GPL. An empty list
        means that the package may be passed on under its own licence, MIT.
    """
    linked = _lacuna.back_ends.split()
    return {
        "version": _lacuna.version,
        "compiler": _lacuna.compiler,
        "libraries": {name: _LICENCES[name] for name in linked},
        "gpl": [name for name in linked if name in _GPL],
    }

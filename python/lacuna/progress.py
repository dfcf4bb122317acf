"""How far a call is, on a bar of tqdm where that is installed."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager

Report = Callable[[str, float], None]


@contextmanager
def progress_function(progress: bool | Report) -> Iterator[Report | None]:
    """Who is informed how far a call is: nobody, a function, or a bar that ends with the call."""
    if callable(progress):
        yield progress
        return
    if not progress:
        yield None
        return
    try:
        from tqdm.auto import tqdm
    except ImportError:
        yield None
        return
    with tqdm(total=1.0, bar_format="{desc} {percentage:3.0f}%|{bar}| {elapsed}") as bar:

        def report(activity: str, fraction: float) -> None:
            bar.set_description_str(activity, refresh=False)
            bar.n = min(1.0, fraction)
            bar.refresh()

        yield report

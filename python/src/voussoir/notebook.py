"""How a notebook shows a run."""
from __future__ import annotations

import html
import tempfile

from voussoir._core import Run
from voussoir.commands import program, view
from voussoir.folder import frame_of


def _text_of(value: float | None, unit: str, error_bar: float | None = None, **_: object) -> str:
    if value is None:  # not finite
        return "none"
    bar = "" if error_bar is None else f" ± {error_bar:.2g}"
    return f"{value:.6g}{bar}" + ("" if unit == "1" else f" {unit}")


def shown(run: Run) -> str:
    """In a notebook: how far the run is, its monitored values, and the blocks as they are now, from the start on."""
    results = run.results
    rows = {"stage": run.stage, "time": f"{run.state.time:g} s", "steps": run.state.steps, "status": results["status"]}
    for name, column in ({} if run.done else run.history).items():
        if name not in ("time_s", "stage") and len(column) > 0:
            rows[name] = f"{column[-1]:.6g}"
    for name, value in results["values"].items():
        rows[name] = _text_of(**value)
    cells = "".join(f"<tr><th>{html.escape(name)}</th><td>{html.escape(str(text))}</td></tr>" for name, text in rows.items())
    table = f"<table><caption>{html.escape(results['title'])}</caption>{cells}</table>"
    try:
        program()
    except FileNotFoundError:  # the module alone, without the program that makes pages
        return table
    with tempfile.TemporaryDirectory() as folder:
        run.write_view(folder)
        return table + frame_of(view(folder).page, results["title"])

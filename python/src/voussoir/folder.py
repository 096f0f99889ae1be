"""The results of a command, read from its folder."""
from __future__ import annotations

import csv
import html
import json
import webbrowser
from pathlib import Path
from typing import TYPE_CHECKING, Any, Iterable

import numpy as np

if TYPE_CHECKING:
    import pandas

Table = dict[str, Any]  # by column: an array of numbers (NaN: empty), or a list of texts


def columns_of(lines: Iterable[str]) -> Table:
    """The columns of the lines of a CSV file: arrays of numbers, NaN for empty cells, or lists of texts."""
    rows = [row for row in csv.reader(lines) if row]
    columns: Table = {}
    for place, name in enumerate(rows[0] if rows else []):
        texts = [row[place] for row in rows[1:]]
        try:
            columns[name] = np.array([float(text or "nan") for text in texts])
        except ValueError:
            columns[name] = texts
    return columns


def frame_of(page: Path, title: str) -> str:
    """The interactive page within a notebook's."""
    content = html.escape(page.read_text(encoding="utf-8"))
    return f'<iframe srcdoc="{content}" style="width:100%;height:520px;border:0" title="{html.escape(title)}"></iframe>'


class Folder:
    """A folder of results.

    `text` is what the command printed; `exit_code` is 0, or 1 if a goal was not reached, as a bracket or an
    equilibrium."""

    def __init__(self, path: str | Path, text: str = "", exit_code: int = 0) -> None:
        self.path, self.text, self.exit_code = Path(path), text, exit_code

    def __repr__(self) -> str:
        return f"Folder({str(self.path)!r}, exit_code={self.exit_code})"

    def __fspath__(self) -> str:
        return str(self.path)

    @property
    def files(self) -> list[str]:
        return sorted(str(file.relative_to(self.path)) for file in self.path.rglob("*") if file.is_file())

    def json(self, name: str = "results.json") -> dict[str, Any]:
        return json.loads((self.path / name).read_text(encoding="utf-8"))

    @property
    def results(self) -> dict[str, Any]:
        """The content of results.json."""
        return self.json()

    @property
    def values(self) -> dict[str, dict[str, Any]]:
        """Of results.json: each has `value` and `unit`, most an `error_bar`."""
        return self.results["values"]

    @property
    def history(self) -> Table:
        """The columns of history.csv."""
        return self.table("history.csv")

    def table(self, name: str) -> Table:
        """The columns of a CSV file of the folder: arrays, NaN for empty cells, or lists of texts."""
        with open(self.path / name, newline="", encoding="utf-8") as lines:
            return columns_of(lines)

    def frame(self, name: str = "history.csv") -> pandas.DataFrame:
        """A CSV file of the folder as pandas.DataFrame."""
        import pandas

        return pandas.DataFrame(self.table(name))

    @property
    def page(self) -> Path:
        """The interactive page, view.html; of a command with `view=True`."""
        page = self.path / "view.html"
        if not page.exists():
            raise FileNotFoundError(f"{page} does not exist; give the command view=True")
        return page

    def show(self) -> None:
        """Opens the interactive page in a browser."""
        webbrowser.open(self.page.resolve().as_uri())

    def _repr_html_(self) -> str:
        """In a notebook: the interactive page if there is one, and what the command printed."""
        shown = f"<pre>{html.escape(self.text)}</pre>"
        if (self.path / "view.html").exists():
            shown += frame_of(self.page, str(self.path))
        return shown

"""The commands of the program `voussoir`, each in a process of its own.

Options are those of the command line, without dashes: `checkpoint_steps=1000` is --checkpoint-steps 1000, `view=True` is
--view, and a list repeats the option. `help(voussoir.program)` tells which program runs."""
from __future__ import annotations

import os
import shutil
import signal
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any, Mapping, NoReturn, Union

from voussoir._core import Scene, SceneError, toml_value
from voussoir.folder import Folder

Source = Union[str, "os.PathLike[str]", Mapping[str, Any]]  # a scene's file, or its content
Option = Union[None, bool, int, float, str, "os.PathLike[str]", list, tuple]

_done, _goal_missed, _bad_input, _folder_in_use, _numerical_failure = range(5)
_not_permitted, _no_memory = 7, 8


def program() -> str:
    """The program that the commands run: $VOUSSOIR_PROGRAM, the one in this package, or `voussoir` on the PATH."""
    stated = os.environ.get("VOUSSOIR_PROGRAM")
    if stated:
        return stated
    own = Path(__file__).parent / "bin" / "voussoir"
    found = str(own) if own.exists() else shutil.which("voussoir")
    if not found:
        raise FileNotFoundError("there is no program voussoir; install it, or name it in the environment: VOUSSOIR_PROGRAM")
    return found


def _main() -> NoReturn:
    """The command `voussoir` of an installed package."""
    os.execv(program(), ["voussoir", *sys.argv[1:]])


def _words(options: Mapping[str, Option]) -> list[str]:
    words = []
    for name, value in options.items():
        option = "--" + name.strip("_").replace("_", "-")
        for item in value if isinstance(value, (list, tuple)) else [value]:
            if item is True:
                words.append(option)
            elif item is not None and item is not False:
                words += [option, os.fspath(item) if hasattr(item, "__fspath__") else str(item)]
    return words


def _sets(overrides: Mapping[str, Any] | None) -> list[str]:
    return [word for key, value in (overrides or {}).items() for word in ("--set", f"{key}={toml_value(value)}")]


def _raise(exit_code: int, message: str) -> NoReturn:
    message = message.strip().removeprefix("voussoir: ") or f"the program ended with exit code {exit_code}"
    kinds = {_bad_input: ValueError, _numerical_failure: ArithmeticError, _not_permitted: PermissionError,
             _no_memory: MemoryError, 128 + signal.SIGINT: KeyboardInterrupt}
    if exit_code == _folder_in_use:
        raise BlockingIOError(message)
    raise kinds.get(exit_code, OSError if 5 <= exit_code <= 6 else RuntimeError)(message)


def _call(*words: str) -> tuple[str, int]:
    """What the program prints, and its exit code, 0 or 1. Ctrl-C ends the program as in a terminal: with a checkpoint."""
    process = subprocess.Popen([program(), *words], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                               encoding="utf-8", errors="replace", start_new_session=True)
    try:
        text, message = process.communicate()
    except BaseException:
        process.send_signal(signal.SIGINT)
        process.communicate()
        raise
    # a negative one is a signal that the program could not handle
    exit_code = process.returncode if process.returncode >= 0 else 128 - process.returncode
    if exit_code > _goal_missed:
        _raise(exit_code, message)
    return text or message, exit_code


class _SceneFile:
    """The file of a scene, a temporary one for a scene that a dict states."""

    def __init__(self, source: Source) -> None:
        self.source = source

    def __enter__(self) -> str:
        if not isinstance(self.source, Mapping):
            return os.fspath(self.source)
        self.folder = tempfile.TemporaryDirectory()
        file = Path(self.folder.name) / "scene.toml"
        file.write_text(Scene(dict(self.source)).toml, encoding="utf-8")
        return str(file)

    def __exit__(self, *_: object) -> None:
        if isinstance(self.source, Mapping):
            self.folder.cleanup()


def _on_scene(command: str, source: Source, overrides: Mapping[str, Any] | None,
              options: Mapping[str, Option]) -> tuple[str, int]:
    with _SceneFile(source) as file:
        try:
            return _call(command, file, *_sets(overrides), *_words(options))
        except ValueError as error:
            raise _of_scene(error, source, overrides) from None


def _of_scene(error: ValueError, source: Source, overrides: Mapping[str, Any] | None) -> ValueError:
    """The same error with its file, line and key, if it is one of the scene."""
    try:
        Scene(dict(source) if isinstance(source, Mapping) else source, set=dict(overrides or {}))
    except SceneError as found:
        # not a feature that only the program has; a dict has another name there
        if str(found).removeprefix("dict") in str(error):
            return found
    except ValueError:
        pass
    return error


def _results(command: str, source: Source, out: str | os.PathLike[str] | None, ending: str,
             overrides: Mapping[str, Any] | None, options: Mapping[str, Option]) -> Folder:
    if out is None:
        stem = "scene" if isinstance(source, Mapping) else Path(os.fspath(source)).stem
        out = Path("results") / (stem + ending)
    text, exit_code = _on_scene(command, source, overrides, {"out": out, **options})
    return Folder(out, text, exit_code)


def check(scene: Source, *, set: Mapping[str, Any] | None = None, **options: Option) -> str:
    """What `voussoir check` prints: what the scene is, what it costs, and what looks wrong. Raises SceneError."""
    return _on_scene("check", scene, set, options)[0]


def slice(scene: Source, out: str | os.PathLike[str] | None = None, *, set: Mapping[str, Any] | None = None,
          **options: Option) -> Folder:
    """Cuts the rock into blocks: `voussoir slice`, with its options (view, report, planes, stl, obj, dxf, section, …)."""
    return _results("slice", scene, out, "_slice", set, options)


def run(scene: Source, out: str | os.PathLike[str] | None = None, *, set: Mapping[str, Any] | None = None,
        **options: Option) -> Folder:
    """Runs a scene: `voussoir run`, with its options (view, budget, threads, overwrite, until, keep, begin, …).

    Ctrl-C ends it with a checkpoint, from which `resume` continues."""
    return _results("run", scene, out, "", set, options)


def resume(folder: str | os.PathLike[str], **options: Option) -> Folder:
    """Continues a run that ended with a checkpoint: `voussoir resume`."""
    return Folder(folder, *_call("resume", os.fspath(folder), *_words(options)))


def limit(scene: Source, out: str | os.PathLike[str] | None = None, *, set: Mapping[str, Any] | None = None,
          **options: Option) -> Folder:
    """Limit analysis: `voussoir limit`, with its options (load, factor, cohesion, with_dilation, …)."""
    return _results("limit", scene, out, "_limit", set, options)


def modes(scene: Source, out: str | os.PathLike[str] | None = None, *, set: Mapping[str, Any] | None = None,
          **options: Option) -> Folder:
    """Lowest natural frequencies of a state at rest: `voussoir modes`, with its options (stage, number, view)."""
    return _results("modes", scene, out, "_modes", set, options)


def joint_test(scene: Source, out: str | os.PathLike[str] | None = None, *, set: Mapping[str, Any] | None = None,
               **options: Option) -> Folder:
    """Laboratory tests of a scene's joints: `voussoir joint-test`; its table is joint_test.csv."""
    return _results("joint-test", scene, out, "_joint_test", set, options)


def study(plan: str | os.PathLike[str], out: str | os.PathLike[str], **options: Option) -> Folder:
    """Plans, runs and gathers a study: `voussoir study`; its table is study.csv. Completed runs are kept."""
    return Folder(out, *_call("study", os.fspath(plan), *_words({"out": out, **options})))


def plan(plan: str | os.PathLike[str], out: str | os.PathLike[str], **options: Option) -> Folder:
    """Plans a study that other processes run: `voussoir study plan`."""
    return Folder(out, *_call("study", "plan", os.fspath(plan), *_words({"out": out, **options})))


def gather(folder: str | os.PathLike[str], *others: str | os.PathLike[str], **options: Option) -> Folder:
    """Gathers the rows of a study, and of copies of its folder, into study.csv: `voussoir study gather`."""
    return Folder(folder, *_call("study", "gather", *map(os.fspath, (folder, *others)), *_words(options)))


def import_(file: str | os.PathLike[str], out: str | os.PathLike[str], **options: Option) -> str:
    """Makes a table of joints from mapped traces, a mesh or a drawing: `voussoir import`. Returns what it prints."""
    return _call("import", os.fspath(file), *_words({"out": out, **options}))[0]


def export(scene: Source, out: str | os.PathLike[str], *, set: Mapping[str, Any] | None = None, **options: Option) -> str:
    """Writes a scene for another program: `voussoir export`, as_ names which. Returns what it prints."""
    return _on_scene("export", scene, set, {"out": out, **options})[0]


def judge(*folders: str | os.PathLike[str], out: str | os.PathLike[str], **options: Option) -> Folder:
    """Judges answers of codes to the problem files: `voussoir judge`; its table is judgement.csv."""
    return Folder(out, *_call("judge", *map(os.fspath, folders), *_words({"out": out, **options})))


def report(folder: str | os.PathLike[str], **options: Option) -> str:
    """Writes one page of a run, a study or joints: `voussoir report`, with its options (out, project, author, …). Returns its
    path."""
    return _call("report", os.fspath(folder), *_words(options))[0].splitlines()[0]


def view(folder: str | os.PathLike[str], **options: Option) -> Folder:
    """Writes the interactive page of a run again: `voussoir view`."""
    return Folder(folder, *_call("view", os.fspath(folder), *_words(options)))


def docs() -> str:
    """The reference of all keys of scenes and studies, as Markdown: `voussoir docs`."""
    return _call("docs")[0]

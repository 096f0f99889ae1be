"""Distinct element modelling of jointed rock.

`Scene` reads a scene and runs it in this process, in portions of steps. The other functions are the program's commands:
each runs in a process of its own, writes the program's files, and returns a `Folder` that reads them.
"""
from voussoir._core import Blocks, Run, Scene, SceneError, State, Surface, __version__, blocks
from voussoir.commands import (check, docs, export, gather, import_, joint_test, judge, limit, modes, plan, program, report,
                               resume, run, slice, study, view)
from voussoir.folder import Folder
from voussoir.notebook import shown as _shown

Run._repr_html_ = _shown

__all__ = ["Blocks", "Folder", "Run", "Scene", "SceneError", "State", "Surface", "__version__", "blocks", "check", "docs",
           "export", "gather", "import_", "joint_test", "judge", "limit", "modes", "plan", "program", "report", "resume", "run",
           "slice", "study", "view"]

"""The engines: how each is started, what it is, what it cannot state; and a process that runs scenes."""
import json
import os
import re
import select
import signal
import subprocess
import time

HERE = os.path.dirname(os.path.abspath(__file__))
BOND = "contacts have no cohesion and no tensile strength per area"
ONE_SOFTNESS = BOND + "; its fixed joint has one softness for forces and moments alike, and the adapter states no other joint"
WELD = BOND + "; its fixed joint has no stiffness"
FRICTIONS = "one coefficient of friction for all joints: the adapter states no other"
PLANE = "the engine is plane"
BOLTS = "the engine has no bolts"


class Engine:
    def __init__(self, name, version, command, model, cannot, extra=None, welds=False):
        self.name, self.version, self.command, self.model, self.cannot = name, version, command, model, cannot
        self.welds = welds  # the adapter states a bonded face as springs
        self.extra = extra or {}  # settings that make this row, besides those of the sweep
        self.folder = name.split("_")[0]  # below this one

    def model_for(self, needs):
        """a bond that is made of springs has joint stiffness, whatever the engine's contacts are"""
        return "joint stiffness" if self.welds and "bond" in needs else self.model

    def reason(self, needs):
        """why it cannot state a problem, or None"""
        return next((self.cannot[n] for n in sorted(needs) if n in self.cannot), None)


PACKAGES = {"bullet": "libbullet-dev", "ode": "libode-dev", "box2d": "libbox2d-dev", "mujoco": "libmujoco-dev",
            "siconos": "python3-siconos"}
MODULES = {"rapier": "@dimforge/rapier3d-deterministic-compat", "jolt": "jolt-physics"}
# why an engine cannot state a bond; one that is not listed states it by springs
BONDS = {"ode": ONE_SOFTNESS}
RIGID = {"bond": WELD, "several frictions": FRICTIONS, "bolts": BOLTS}


def version_of(name):
    """of the Debian package, or of the lock of npm"""
    if name in MODULES:
        with open(os.path.join(HERE, "package.json"), encoding="utf-8") as file:
            return json.load(file)["dependencies"][MODULES[name]]
    asked = subprocess.run(["dpkg-query", "-W", "-f=${Version}", PACKAGES[name]], capture_output=True, text=True)
    return re.split("[+-]", asked.stdout.split(":")[-1])[0] or "of unknown version"


def engines(build, program):
    """those that build.sh and the packages brought, by name; program: voussoir"""
    files = {"bullet": [os.path.join(build, "bullet")], "ode": [os.path.join(build, "ode")],
             "box2d": [os.path.join(build, "box2d")], "mujoco": [os.path.join(build, "mujoco")],
             "rapier": ["node", os.path.join(build, "node", "rapier", "rapier.mjs")],
             "jolt": ["node", os.path.join(build, "node", "jolt", "jolt.mjs")]}
    found = {}
    for name, command in files.items():
        if os.path.exists(command[-1]):
            cannot = dict(RIGID, bond=BONDS.get(name), **({"space": PLANE} if name == "box2d" else {}))
            cannot = {need: reason for need, reason in cannot.items() if reason}
            found[name] = Engine(name, version_of(name), command, "rigid", cannot, welds="bond" not in cannot)
    python = "/usr/bin/python3"  # the system's own, for which Debian builds the module
    if subprocess.run([python, "-c", "import siconos.kernel"], capture_output=True).returncode == 0:
        found["siconos"] = Engine("siconos", version_of("siconos"), [python, os.path.join(HERE, "siconos", "siconos_adapter.py")],
                                  "rigid", RIGID)
    if program and os.path.exists(program):
        command = [python, os.path.join(HERE, "voussoir", "voussoir_adapter.py"), program]
        version = subprocess.run([program, "--version"], capture_output=True, text=True).stdout.split()[1]
        # joints as the problem states them, and as soft as a bench of rock
        for name, extra in (("voussoir", {}), ("voussoir_soft", {"kn": 1e9, "ks": 1e9})):
            found[name] = Engine(name, version, command, "joint stiffness", {"several frictions": FRICTIONS}, extra)
    return found


def processor_seconds(process):
    """used so far by a process and those that it started"""
    try:
        with open("/proc/%d/stat" % process, encoding="utf-8") as file:
            fields = file.read().rsplit(")", 1)[1].split()  # a name may have spaces
        with open("/proc/%d/task/%d/children" % (process, process), encoding="utf-8") as file:
            children = file.read().split()
    except OSError:
        return 0.0  # it has ended
    own = sum(int(fields[k]) for k in (11, 12, 13, 14)) / os.sysconf("SC_CLK_TCK")  # with children that have ended
    return own + sum(processor_seconds(int(child)) for child in children)


class Run:
    """of one scene: rows by block, seconds of the steps, or why it failed"""

    def __init__(self):
        self.rows, self.seconds, self.failure = {}, 0.0, None


class Process:
    """One process that runs scene after scene; started again after a failure. A scene may take patience_s of processor time, so
    that a busy machine stops no engine; one that waits for something is stopped after ten times as long by the clock."""

    def __init__(self, engine, patience_s=120):
        self.engine, self.patience, self.process, self.text = engine, patience_s, None, b""

    def run(self, text):
        if self.process is None or self.process.poll() is not None:
            self.process = subprocess.Popen(self.engine.command, stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                            stderr=subprocess.DEVNULL, start_new_session=True)
            self.text = b""
        found, until = Run(), time.monotonic() + 10 * self.patience
        used = processor_seconds(self.process.pid) + self.patience
        try:
            self.process.stdin.write(text.encode())
            self.process.stdin.flush()
        except BrokenPipeError:
            found.failure = "the engine stopped"
            return found
        while not self._read_line(found, until, used):
            pass
        if found.failure:
            self.close()
        return found

    def close(self):
        if self.process is not None:
            os.killpg(self.process.pid, signal.SIGKILL)  # with what it started
            self.process.wait()
            self.process = None

    def _read_line(self, found, until, used):
        """true after the scene's last line; until: by the clock; used: processor time"""
        while b"\n" not in self.text:
            ready, _, _ = select.select([self.process.stdout], [], [], 1.0)
            if not ready:
                if processor_seconds(self.process.pid) < used and time.monotonic() < until:
                    continue
                found.failure = "no result within %g s of processor time" % self.patience
                return True
            part = os.read(self.process.stdout.fileno(), 1 << 16)
            if not part:
                found.failure = "the engine stopped"
                return True
            self.text += part
        line, self.text = self.text.split(b"\n", 1)
        words = line.decode(errors="replace").split()
        if len(words) == 4 and words[0] == "cpu":
            found.seconds = float(words[1])
            return True
        if words and words[0] == "failed":
            found.failure = " ".join(words[1:])
            return True
        if len(words) == 15:
            try:  # engines print warnings of their own between the rows
                numbers = [float(words[0])] + [float(w) for w in words[2:]]
            except ValueError:
                return False
            found.rows.setdefault(words[1], []).append(numbers)
        return False

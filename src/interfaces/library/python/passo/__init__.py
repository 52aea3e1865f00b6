"""Passo: motion control for stepper-driven machines.

    import passo

    report = passo.check("part.ngc", "machine.toml")
    print(report.motion.time if report.good else report.findings[0])

A program is the name of a file or a Program. A machine is the name of a machine file or a Machine. Lengths are in mm,
angles in degrees, times in seconds. Errors in files, paths and options raise passo.Error, which has file, line, column
and code. Long calls release the interpreter's lock, so several threads may run them at once.
"""

from __future__ import annotations

import ctypes
import os
from dataclasses import dataclass
from typing import Any, Callable, Iterator, Mapping, Optional, Sequence, Tuple, Union

import numpy as np
import numpy.typing as npt

# In a wheel, the library is next to this file.
_library = os.path.join(os.path.dirname(__file__), "libpasso.so.1")
if os.path.exists(_library):
    ctypes.CDLL(_library)

from passo import _core, operation
from passo._core import Machine, Path, Program
from passo._findings import Error, Finding, findings_of

__all__ = [
    "AxisLimits", "AxisMotion", "ProgramReport", "Error", "Finding", "Machine", "MillingTool", "Motion", "MotionReport",
    "Path", "Program", "ReadOptions", "Samples", "SlowLine", "SpeedLimit", "Steps", "Stock", "WeakSpot", "check", "cut",
    "operation", "operations", "plan", "plan_program", "png_of", "toolpath",
]

__version__: str = _core.version()

AnyProgram = Union[str, "os.PathLike[str]", Program]
AnyMachine = Union[str, "os.PathLike[str]", Machine]
Range = Tuple[float, float]
Progress = Callable[[float], None]
"""A function that is called from time to time with the completed fraction. An exception from it ends the call."""


@dataclass(frozen=True)
class ReadOptions:
    """How a program is read."""

    dialect: str = "linuxcnc"
    """'linuxcnc' or 'grbl'"""
    inches: bool = False
    """lengths before the first G20 or G21 are in inches"""
    block_delete: bool = False
    """skips lines that begin with '/'"""
    tool_table: str = ""
    """a file in LinuxCNC's format, in mm"""
    parameters: str = ""
    """a file of numbered parameters (.var), with the work offsets"""
    sub_folders: Sequence[str] = ()
    """folders of subroutine files, searched after the program's own"""

    def _core(self) -> _core.ReadOptions:
        return _core.ReadOptions(
            self.dialect, self.inches, self.block_delete, self.tool_table, self.parameters, list(self.sub_folders)
        )


def _program(program: AnyProgram) -> Program:
    return program if isinstance(program, Program) else Program.open(os.fspath(program))


def _machine(machine: AnyMachine) -> Machine:
    return machine if isinstance(machine, Machine) else Machine.open(os.fspath(machine))


# --- a program as operations


def operations(program: AnyProgram, read: ReadOptions = ReadOptions()) -> Iterator[operation.Operation]:
    """Yields the operations of a program in the order of execution. If there are errors, it raises Error at the end."""
    reader = _core.OperationReader(_program(program), read._core())
    while (values := reader.next()) is not None:
        made: operation.Operation = getattr(operation, str(values[0]))(*values[1:])
        yield made
    findings = findings_of(reader.findings())
    if any(finding.severity == "error" for finding in findings):
        raise Error(findings)


# --- a check


@dataclass(frozen=True)
class AxisMotion:
    """The motion of an axis."""

    axis: str
    extents: Optional[Range]
    """in machine coordinates; None: the axis does not move"""
    cutting_extents: Optional[Range]
    """the same for the feed moves"""
    highest_velocity: float
    highest_acceleration: float


@dataclass(frozen=True)
class SpeedLimit:
    """What limited the speed, and for how long."""

    limit: str
    time: float
    first_line: int


@dataclass(frozen=True)
class SlowLine:
    """A line that is slower than programmed."""

    line: int
    mean_speed: float
    programmed_speed: float
    lost_time: float
    limit: str


@dataclass(frozen=True)
class WeakSpot:
    """The worst moment of an axis in a line, for the torque of its motor."""

    axis: str
    line: int
    time: float
    verdict: str
    """'doubtful' or 'lost'"""
    load: float
    """the torque needed, as a fraction of the guaranteed torque"""
    cause: str
    cure: str


@dataclass(frozen=True)
class MotionReport:
    """The results of planning a program."""

    cutting_time: float
    rapid_time: float
    dwell_time: float
    cutting_length: float
    rapid_length: float
    moves: int
    tool_changes: int
    axes: Tuple[AxisMotion, ...]
    speed_limits: Tuple[SpeedLimit, ...]
    """the longest first"""
    slowest_lines: Tuple[SlowLine, ...]
    motors: Optional[str]
    """'safe', 'doubtful' or 'lost'; None: the machine file describes no motor"""
    weak_spots: Tuple[WeakSpot, ...]
    """the worst first"""

    @property
    def time(self) -> float:
        """The duration of the program, in seconds. Spindle commands, tool changes and program stops take no time."""
        return self.cutting_time + self.rapid_time + self.dwell_time


@dataclass(frozen=True)
class ProgramReport:
    """The results of a check."""

    findings: Tuple[Finding, ...]
    """errors and warnings"""
    motion: Optional[MotionReport]
    """None: the program has errors, or was not planned"""

    @property
    def good(self) -> bool:
        """Whether there is no error."""
        return all(finding.severity != "error" for finding in self.findings)


def check(
    program: AnyProgram,
    machine: AnyMachine,
    read: ReadOptions = ReadOptions(),
    *,
    plans: bool = True,
    feed_factor: float = 1,
    rapid_factor: float = 1,
    progress: Optional[Progress] = None,
) -> ProgramReport:
    """Checks a program for a machine. Errors of the program are in the report; an invalid machine file raises Error."""
    findings, motion = _core.check(
        _program(program), _machine(machine), read._core(), plans, feed_factor, rapid_factor, progress
    )
    if motion is None:
        report_of_errors = ProgramReport(findings_of(findings), None)
        if any(finding.code == "check.factor" for finding in report_of_errors.findings):
            raise Error(report_of_errors.findings)
        return report_of_errors
    numbers, (axes, limits, slowest, motors, spots) = motion[:7], motion[7:]
    report = MotionReport(
        *numbers,
        axes=tuple(AxisMotion(*values) for values in axes),
        speed_limits=tuple(SpeedLimit(*values) for values in limits),
        slowest_lines=tuple(SlowLine(*values) for values in slowest),
        motors=motors,
        weak_spots=tuple(WeakSpot(*values) for values in spots),
    )
    return ProgramReport(findings_of(findings), report)


# --- motion in time, and steps


@dataclass(frozen=True)
class AxisLimits:
    """The limits of an axis in mm/s, mm/s² and mm/s³; for A, B and C in degrees. jerk 0: no limit."""

    velocity: float
    acceleration: float
    jerk: float = 0


@dataclass(frozen=True)
class Samples:
    """The motion at equal intervals, as arrays with a row for each time and a column for each axis."""

    time: npt.NDArray[np.float64]
    position: npt.NDArray[np.float64]
    velocity: npt.NDArray[np.float64]
    acceleration: npt.NDArray[np.float64]
    speed: npt.NDArray[np.float64]
    """along the path"""
    piece: npt.NDArray[np.uint32]
    """the number of the piece of the path, or the line of the program"""
    axes: str


@dataclass(frozen=True)
class Steps:
    """Steps of motors, in order of time."""

    tick: npt.NDArray[np.int64]
    axis: npt.NDArray[np.uint8]
    """0 is X, 8 is W"""
    forward: npt.NDArray[np.bool_]
    ticks_per_s: float

    @property
    def time(self) -> npt.NDArray[np.float64]:
        """Seconds since the start of the motion."""
        return self.tick / self.ticks_per_s

    def __len__(self) -> int:
        return len(self.tick)


class Motion:
    """A planned motion. It never changes."""

    def __init__(self, core: _core.Motion, axes: str) -> None:
        self._core = core
        self._axes = axes

    @property
    def duration(self) -> float:
        return self._core.duration

    @property
    def length(self) -> float:
        """The length of the rounded path, in mm."""
        return self._core.length

    def sample(
        self, interval: float, axes: str = "", start: float = 0, count: Optional[int] = None
    ) -> Samples:
        """Returns the motion at start, start + interval and so on, by default to the end. `axes`: the letters of the
        axes, e.g. 'XY'; by default all axes that have limits."""
        axes = axes or self._axes
        if count is None:
            if not interval > 0:
                raise ValueError(f"interval {interval}: expected a number above 0")
            count = max(0, int(np.ceil((self.duration - start) / interval - 1e-9))) + 1
        position, velocity, acceleration, speed, piece = self._core.sample(start, interval, count, axes)
        return Samples(start + interval * np.arange(count), position, velocity, acceleration, speed, piece, axes)

    def steps(
        self,
        steps_per_mm: Optional[Mapping[str, float]] = None,
        ticks_per_s: float = 16e6,
        events_per_s: float = 100e3,
        most: int = 100_000_000,
    ) -> Steps:
        """Returns the first steps of the motors, at most `most`. `steps_per_mm`: the steps per mm or degree of each
        axis (negative: the motor turns in the other direction); by default the motors of the program's machine."""
        train = self._core.steps(list((steps_per_mm or {}).items()), ticks_per_s, events_per_s)
        return Steps(*train.read(most), train.ticks_per_s)

    def step_blocks(
        self,
        steps_per_mm: Optional[Mapping[str, float]] = None,
        ticks_per_s: float = 16e6,
        events_per_s: float = 100e3,
        size: int = 1_000_000,
    ) -> Iterator[Steps]:
        """Yields all steps, in blocks of at most `size` steps. The memory does not depend on the number of steps."""
        train = self._core.steps(list((steps_per_mm or {}).items()), ticks_per_s, events_per_s)
        while True:
            block = Steps(*train.read(size), train.ticks_per_s)
            if len(block) == 0:
                return
            yield block


def plan(path: Path, limits: Mapping[str, AxisLimits]) -> Motion:
    """Plans the motion along a path, within the limits of the axes: plan(path, {"X": AxisLimits(200, 1500), …})."""
    tuples = [(axis, own.velocity, own.acceleration, own.jerk) for axis, own in limits.items()]
    return Motion(_core.plan_path(path, tuples), "".join(limits))


def plan_program(
    program: AnyProgram,
    machine: AnyMachine,
    read: ReadOptions = ReadOptions(),
    *,
    feed_factor: float = 1,
    rapid_factor: float = 1,
    progress: Optional[Progress] = None,
) -> Motion:
    """Plans the motion of a program, in machine coordinates. Spindle commands, tool changes and program stops take no
    time."""
    for_machine = _machine(machine)
    core = _core.plan_program(_program(program), for_machine, read._core(), feed_factor, rapid_factor, progress)
    return Motion(core, for_machine.axes)


# --- pictures


def toolpath(
    program: AnyProgram,
    machine: AnyMachine,
    read: ReadOptions = ReadOptions(),
    *,
    title: str = "",
    tint: str = "speed",
    rapids: bool = True,
    width: int = 1600,
    height: int = 900,
) -> npt.NDArray[np.uint8]:
    """Draws the toolpath. Returns an array of height x width x 3 (red, green, blue). `tint`: what the colour of the
    feed moves shows: 'speed', 'depth', 'tool' or 'torque'."""
    options = _core.PictureOptions(title, tint, rapids, width, height)
    return _core.toolpath(_program(program), _machine(machine), read._core(), options)


@dataclass(frozen=True)
class MillingTool:
    """The shape of a milling tool: 'flat', 'ball' or 'vee'."""

    kind: str
    diameter: float
    angle: float = 60
    """only for a vee: the included angle in degrees"""
    tip_diameter: float = 0
    """only for a vee: the diameter of its flat tip"""


@dataclass(frozen=True)
class Stock:
    """A piece of stock after cutting."""

    heights: npt.NDArray[np.float32]
    """mm below the top: a row for each Y, a column for each X; 0: not cut"""
    cell: float
    left: float
    """X of the corner of the first cell"""
    front: float
    """Y of the corner of the first cell"""
    top: float
    bottom: float
    removed: float
    """mm³"""
    findings: Tuple[Finding, ...]
    """e.g. a rapid move through the stock"""

    def picture(self, title: str = "", width: int = 1600, height: int = 900) -> npt.NDArray[np.uint8]:
        """Draws the stock. Returns an array of height x width x 3 (red, green, blue)."""
        options = _core.PictureOptions(title, "speed", True, width, height)
        return _core.stock_picture(self.heights, self.cell, self.left, self.front, self.top, self.bottom, options)


def cut(
    program: AnyProgram,
    tool: Optional[MillingTool] = None,
    read: ReadOptions = ReadOptions(),
    *,
    tools_file: Union[str, "os.PathLike[str]"] = "",
    x: Optional[Range] = None,
    y: Optional[Range] = None,
    z: Optional[Range] = None,
    cell: float = 0,
    threads: int = 1,
) -> Stock:
    """Cuts a block with the program. `tool`: the tool for each T number that is not in `tools_file`. x, y, z: the block
    in program coordinates; None: as large as the feed moves require. `cell` 0: about a million cells."""
    if tool is not None and tool.kind not in ("flat", "ball", "vee"):
        raise ValueError(f"tool '{tool.kind}'; expected 'flat', 'ball' or 'vee'")
    shape = None if tool is None else (tool.kind, tool.diameter, tool.angle, tool.tip_diameter)
    heights, size, left, front, top, bottom, removed, findings = _core.cut(
        _program(program), read._core(), shape, os.fspath(tools_file), x, y, z, cell, threads
    )
    return Stock(heights, size, left, front, top, bottom, removed, findings_of(findings))


def png_of(pixels: npt.NDArray[Any]) -> bytes:
    """Encodes an array of height x width x 3 as a PNG file."""
    return _core.png_of(pixels)

"""The operations of a G-code program. Positions are in work coordinates: X Y Z A B C U V W, in mm and degrees."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Tuple, Union

Position = Tuple[float, float, float, float, float, float, float, float, float]
"""X Y Z A B C U V W"""
Feed = Tuple[float, str]
"""a value, and 'mm/s' or 'mm/turn'; if only A, B and C move, degrees instead of mm"""


@dataclass(frozen=True)
class Line:
    line: int
    start: Position
    end: Position
    rapid: bool
    feed: Feed
    in_machine: bool
    """to a machine position: G53, G28, G30"""


@dataclass(frozen=True)
class Arc:
    line: int
    start: Position
    end: Position
    plane: str
    """'xy', 'zx' or 'yz'"""
    centre: Tuple[float, float]
    """in the axes of the plane"""
    turns: int
    """1: up to one full circle counterclockwise, 2: one more; -1: clockwise"""
    feed: Feed


@dataclass(frozen=True)
class Spline:
    """A rational B-spline in X and Y of degree order - 1, with clamped knots that are 1 apart."""

    line: int
    points: Tuple[Tuple[float, float, float], ...]
    """X, Y and weight"""
    order: int
    feed: Feed


@dataclass(frozen=True)
class Probe:
    line: int
    start: Position
    end: Position
    until_triggered: bool
    must_change: bool
    feed: Feed


@dataclass(frozen=True)
class Tap:
    line: int
    start: Position
    end: Position
    pitch: float


@dataclass(frozen=True)
class Dwell:
    line: int
    time: float


@dataclass(frozen=True)
class Spindle:
    line: int
    direction: str
    """'off', 'clockwise' or 'counterclockwise'"""
    speed: float
    """rpm, as commanded; kept while the spindle is off"""
    spindle: int


@dataclass(frozen=True)
class Coolant:
    line: int
    mist: bool
    flood: bool


@dataclass(frozen=True)
class SelectTool:
    line: int
    tool: int


@dataclass(frozen=True)
class ChangeTool:
    line: int
    tool: int


@dataclass(frozen=True)
class Stop:
    line: int
    optional: bool


@dataclass(frozen=True)
class End:
    line: int


@dataclass(frozen=True)
class PathMode:
    line: int
    mode: str
    """'exact path', 'exact stop' or 'continuous'"""
    tolerance: float
    """mm; 0: the tolerance of the machine file"""


@dataclass(frozen=True)
class CoordinateSystem:
    line: int
    system: int
    """1 is G54, 9 is G59.3"""
    work_offset: Position
    g92_offset: Position
    tool_offset: Position
    rotation: float
    """degrees about Z"""


@dataclass(frozen=True)
class Message:
    line: int
    kind: str
    """'comment', 'message' or 'print'"""
    text: str


@dataclass(frozen=True)
class Other:
    """Any other operation, as a canonical call in LinuxCNC's notation."""

    line: int
    call: str


Operation = Union[
    Line, Arc, Spline, Probe, Tap, Dwell, Spindle, Coolant, SelectTool, ChangeTool, Stop, End, PathMode,
    CoordinateSystem, Message, Other,
]

"""Findings, and the exception that holds them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Iterable, Sequence, Tuple

FindingTuple = Tuple[str, str, str, int, int, int, str, str, str, str]


@dataclass(frozen=True)
class Finding:
    """One error or warning, with its place."""

    severity: str
    """'error' or 'warning'"""
    code: str
    """a stable code, e.g. 'gcode.missing-feed'"""
    file: str
    line: int
    """from 1; 0: the file as a whole. For a Path: the number of the piece, from 1"""
    column: int
    """from 1, in characters; 0: the whole line"""
    length: int
    message: str
    """what is wrong, with the value found"""
    expected: str
    """the correct form, or how to correct the error; may be empty"""
    text: str
    """the line of the file; may be empty"""
    words: str
    """the whole finding in the style of compilers, in several lines"""

    def __str__(self) -> str:
        return self.words


class Error(ValueError):
    """A file, a path or an option has errors. `findings` has them all; the other attributes are the first one's."""

    def __init__(self, findings: Sequence[Finding]) -> None:
        super().__init__("\n".join(finding.words.rstrip() for finding in findings))
        self.findings: Sequence[Finding] = tuple(findings)
        first = next((finding for finding in self.findings if finding.severity == "error"), self.findings[0])
        self.code: str = first.code
        self.file: str = first.file
        self.line: int = first.line
        self.column: int = first.column
        self.message: str = first.message

    def __reduce__(self) -> Tuple[type, Tuple[Sequence[Finding]]]:
        return (Error, (self.findings,))


def findings_of(tuples: Iterable[FindingTuple]) -> Tuple[Finding, ...]:
    return tuple(Finding(*values) for values in tuples)

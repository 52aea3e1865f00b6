"""Checks a program for a machine, and writes pictures of its toolpath and of the stock that it leaves.

    python3 check_and_draw.py PROGRAM MACHINE FOLDER
"""

import sys
from pathlib import Path

import numpy as np

import passo


def main(program: str, machine: str, folder: Path) -> int:
    try:
        report = passo.check(program, machine)
    except passo.Error as error:  # a wrong machine file, or no such program
        print(f"{error.file}:{error.line}:{error.column}: {error.message} [{error.code}]", file=sys.stderr)
        return 2
    for finding in report.findings:
        print(finding, end="", file=sys.stderr)
    if report.motion is None:
        return 2
    print(f"{report.motion.time:.2f} s, {report.motion.moves} moves, motors: {report.motion.motors}")

    motion = passo.plan_program(program, machine)
    samples = motion.sample(0.001)
    print(f"fastest: {samples.speed.max():.2f} mm/s in line {samples.piece[samples.speed.argmax()]}")
    steps = motion.steps()
    shortest = np.diff(steps.time[steps.axis == 0]).min()
    print(f"{len(steps)} steps, shortest time between two steps of X: {shortest * 1e6:.1f} µs")

    folder.joinpath("toolpath.png").write_bytes(passo.png_of(passo.toolpath(program, machine, title="Toolpath")))
    stock = passo.cut(program, passo.MillingTool("flat", 3))
    folder.joinpath("stock.png").write_bytes(passo.png_of(stock.picture("Stock")))
    print(f"{stock.removed:.0f} mm³ removed, deepest {-stock.heights.min():.2f} mm")
    return 0


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    sys.exit(main(sys.argv[1], sys.argv[2], Path(sys.argv[3])))

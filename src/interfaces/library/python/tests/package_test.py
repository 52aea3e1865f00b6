"""Tests of the Python package: package_test.py PROGRAM MACHINE. scripts/library_test.sh runs them."""

import inspect
import pickle
import sys
import threading
import unittest

import numpy as np

import passo
from passo import _core, operation

program = sys.argv[1]
machine = sys.argv[2]


class Check(unittest.TestCase):
    def test_tells_the_time_and_takes_names_and_objects(self) -> None:
        by_name = passo.check(program, machine)
        by_object = passo.check(passo.Program.open(program), passo.Machine.open(machine))
        self.assertEqual(by_name, by_object)
        self.assertTrue(by_name.good)
        assert by_name.motion is not None
        self.assertGreater(by_name.motion.time, 50)
        self.assertEqual([axis.axis for axis in by_name.motion.axes], ["X", "Y", "Z"])

    def test_gives_errors_with_their_places(self) -> None:
        report = passo.check(passo.Program.from_text("G21\nG1 X1\nM2\n", "part.ngc"), machine)
        self.assertFalse(report.good)
        self.assertIsNone(report.motion)
        finding = report.findings[0]
        self.assertEqual((finding.code, finding.file, finding.line, finding.column), ("gcode.missing-feed", "part.ngc", 2, 1))
        self.assertTrue(str(finding).startswith("part.ngc:2:1: error: "))

    def test_raises_errors_of_files(self) -> None:
        with open(machine, encoding="utf-8") as file:
            lines = file.read().splitlines()
        wrong = next(i for i, line in enumerate(lines) if line.startswith("path_tolerance_mm"))
        lines[wrong] = "path_tolerance_mm = -1"
        with self.assertRaises(passo.Error) as caught:
            passo.check(program, passo.Machine.from_text("\n".join(lines), "mine.toml"))
        self.assertEqual((caught.exception.file, caught.exception.line), ("mine.toml", wrong + 1))
        self.assertTrue(caught.exception.code.startswith("machine."))
        self.assertEqual(pickle.loads(pickle.dumps(caught.exception)).code, caught.exception.code)
        self.assertRaises(passo.Error, passo.check, "/nowhere.ngc", machine)
        self.assertRaises(passo.Error, passo.check, program, machine, feed_factor=100)

    def test_survives_bytes_that_are_no_text(self) -> None:
        with self.assertRaises(UnicodeDecodeError):
            b"\xff".decode()
        strange = passo.Program.from_text("G21 (\udcff)\nG1 X1\nM2\n".encode("utf-8", "surrogateescape").decode("latin-1"), "x")
        self.assertFalse(passo.check(strange, machine).good)

    def test_is_ended_by_its_progress_function(self) -> None:
        seen = []

        def stop(share: float) -> None:
            seen.append(share)
            if share > 0.5:
                raise KeyboardInterrupt

        text = "G21 G90 F600\n" + "G1 X10\nG1 X0\n" * 5000 + "M2\n"
        self.assertRaises(KeyboardInterrupt, passo.check, passo.Program.from_text(text, "long"), machine, progress=stop)
        self.assertGreater(len(seen), 1)

    def test_lets_other_threads_run(self) -> None:
        reports = []
        threads = [threading.Thread(target=lambda: reports.append(passo.check(program, machine))) for _ in range(3)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(len(set(report.motion.time for report in reports if report.motion)), 1)


class Planning(unittest.TestCase):
    limits = {"X": passo.AxisLimits(200, 1500), "Y": passo.AxisLimits(200, 1500)}

    def test_gives_motion_within_the_limits_and_steps(self) -> None:
        path = passo.Path(x=5)
        path.line_to(x=60, speed=100)
        path.line_to(y=40, speed=100)
        path.arc_to(x=20, centre=(40, 40), speed=80)
        path.stop(dwell=0.1)
        self.assertEqual(len(path), 4)
        motion = passo.plan(path, self.limits)
        samples = motion.sample(1e-3)
        self.assertEqual(samples.position.shape, (len(samples.time), 2))
        np.testing.assert_allclose(samples.position[0], (5, 0))
        np.testing.assert_allclose(samples.position[-1], (20, 40), atol=1e-9)
        self.assertLessEqual(np.abs(samples.acceleration).max(), 1500 * 1.000001)
        self.assertLessEqual(samples.speed.max(), 100 * 1.000001)
        steps = motion.steps({"X": 80, "Y": -80})
        self.assertEqual(np.where(steps.forward[steps.axis == 0], 1, -1).sum(), 15 * 80)
        self.assertEqual(np.where(steps.forward[steps.axis == 1], 1, -1).sum(), -40 * 80)
        self.assertTrue((np.diff(steps.tick) >= 0).all())
        blocks = list(motion.step_blocks({"X": 80, "Y": -80}, size=1000))
        np.testing.assert_array_equal(np.concatenate([block.tick for block in blocks]), steps.tick)

    def test_refuses_what_is_wrong_with_its_piece(self) -> None:
        path = passo.Path()
        path.line_to(x=1)
        path.line_to(z=1)
        with self.assertRaises(passo.Error) as caught:
            passo.plan(path, self.limits)
        self.assertEqual((caught.exception.code, caught.exception.line), ("plan.no-axis", 2))
        self.assertRaises(TypeError, path.line_to, q=1)
        self.assertRaises(ValueError, passo.plan, path, {"Q": passo.AxisLimits(1, 1)})
        self.assertRaises(ValueError, passo.plan(passo.Path(), self.limits).sample, 0)

    def test_of_a_program_is_that_of_its_check(self) -> None:
        motion = passo.plan_program(program, machine)
        report = passo.check(program, machine).motion
        assert report is not None
        self.assertAlmostEqual(motion.duration, report.time, places=6)
        self.assertEqual(motion.sample(0.1).axes, "XYZ")
        self.assertGreater(len(motion.steps()), 10000)


class Operations(unittest.TestCase):
    def test_have_types(self) -> None:
        text = "G21 G90\nT2 M6\nS100 M3\nG0 X1\nG1 Y2 F60\nG2 X3 Y2 I1\nG4 P1\n(MSG, hi)\nG92 X0\nM64 P1\nM8\nM0\nM2\n"
        made = list(passo.operations(passo.Program.from_text(text, "all")))
        kinds = {type(one) for one in made}
        self.assertLessEqual(
            {operation.Line, operation.Arc, operation.ChangeTool, operation.Spindle, operation.Dwell, operation.Message,
             operation.CoordinateSystem, operation.Coolant, operation.Stop, operation.End, operation.Other}, kinds)
        feed = next(one for one in made if isinstance(one, operation.Line) and not one.rapid)
        self.assertEqual((feed.line, feed.start[:2], feed.end[:2], feed.feed), (5, (1, 0), (1, 2), (1, "mm/s")))

    def test_end_with_an_error(self) -> None:
        with self.assertRaises(passo.Error) as caught:
            list(passo.operations(passo.Program.from_text("G1 X1\nM2\n", "part.ngc")))
        self.assertEqual(caught.exception.line, 1)


class Pictures(unittest.TestCase):
    def test_are_arrays_of_pixels(self) -> None:
        pixels = passo.toolpath(program, machine, width=400, height=300)
        self.assertEqual((pixels.shape, pixels.dtype), ((300, 400, 3), np.uint8))
        self.assertGreater(np.unique(pixels).size, 20)
        self.assertEqual(passo.png_of(pixels)[:4], b"\x89PNG")
        self.assertRaises(ValueError, passo.png_of, np.zeros((2, 2), np.uint8))
        self.assertRaises(passo.Error, passo.toolpath, program, machine, width=1)
        self.assertRaises(ValueError, passo.toolpath, program, machine, tint="pink")

    def test_stock_is_an_array_of_heights(self) -> None:
        stock = passo.cut(program, passo.MillingTool("vee", 3, angle=60, tip_diameter=0.1), cell=0.2)
        self.assertEqual(stock.heights.dtype, np.float32)
        self.assertAlmostEqual(float(stock.heights.min()), -0.3, places=3)
        self.assertGreater(stock.removed, 1)
        self.assertEqual(stock.picture(width=400, height=300).shape, (300, 400, 3))
        self.assertRaises(passo.Error, passo.cut, program)
        self.assertRaises(ValueError, passo.cut, program, passo.MillingTool("spoon", 3))


class Package(unittest.TestCase):
    def test_has_documentation_of_all_that_it_offers(self) -> None:
        for name in passo.__all__:
            thing = getattr(passo, name)
            self.assertTrue(hasattr(thing, "__doc__"), name)
            if inspect.isfunction(thing):
                self.assertTrue(thing.__doc__, name)

    def test_stub_lists_what_the_module_has(self) -> None:
        stub = (passo.__path__[0]) + "/_core.pyi"
        with open(stub, encoding="utf-8") as file:
            text = file.read()
        for name in dir(_core):
            if not name.startswith("_"):
                self.assertTrue(f"def {name}(" in text or f"class {name}:" in text, name)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])

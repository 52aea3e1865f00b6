"""Plans a path within the limits of two axes, and prints the motion and the steps of the motors."""

import passo

path = passo.Path()  # starts at 0, 0, 0
path.set_tolerance(0.02)
path.line_to(x=60, speed=100)
path.line_to(y=40, speed=100)
path.arc_to(x=20, centre=(40, 40), turns=1, speed=80)

limits = passo.AxisLimits(velocity=200, acceleration=1500, jerk=30000)
motion = passo.plan(path, {"X": limits, "Y": limits})
print(f"{motion.duration:.3f} s, {motion.length:.2f} mm")

samples = motion.sample(0.25)
for time, (x, y), speed in zip(samples.time, samples.position, samples.speed):
    print(f"{time:5.2f} s  X {x:7.3f}  Y {y:7.3f}  {speed:6.2f} mm/s")

steps = motion.steps({"X": 80, "Y": 80})
print(f"{len(steps)} steps; the first of X at {steps.time[steps.axis == 0][0]:.6f} s")

#!/usr/bin/env bash
# scripts/motion_costs.sh [programs|curves|all [PASSO]]: measures what a motion costs, and prints tables.
#
# programs: each program of ../shared/peers/motion-mm and of examples/, on the bench machine as it is, with jerk limits,
# with torque curves, with backlash, and with A in the place of Y (15 degrees for a millimetre); those of
# ../shared/peers/motion-repro and ../shared/cases/motion on their own machines. The columns: the time of the motion, the
# prover's bound, the CPU time and memory of `passo run`, and the CPU time of `passo check --motion` as a multiple of that.
# curves: ten curves of ../shared/cases/motion/make_curve.py as lines, arcs and pairs of arcs of five lengths.
# PASSO: another program to measure, build/release/passo unless given. Needs jq, GNU time and python3.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
what=${1-all} passo=${2-build/release/passo} shared=../shared
case $what in
  programs | curves | all) ;;
  *)
    sed -n '2,10s/^# \{0,1\}//p' scripts/motion_costs.sh
    exit 2
    ;;
esac
for needed in "$passo" jq /usr/bin/time python3; do
  command -v "$needed" >/dev/null || { echo "motion_costs.sh: there is no $needed" >&2; exit 1; }
done
new=$(mktemp -d)
trap 'rm -rf "$new"' EXIT

bench=examples/machines/bench.toml
sed 's/^max_acceleration_mm_s2 = .*/&\nmax_jerk_mm_s3 = 25_000/' "$bench" >"$new/jerk.toml"
{ cat "$bench"; printf '\n[axis.%s.screw]\nbacklash_mm = 0.05\n' X Y Z; } >"$new/backlash.toml"
{
  cat "$bench"
  for axis in X Y Z; do
    printf '\n[axis.%s.torque]\npull_out_steps_s_nm = [[0, 0.12], [1000, 0.1], [3000, 0.06], [5000, 0.03], [6000, 0.02]]\n' $axis
    printf 'rotor_inertia_g_cm2 = 300\nload_mass_kg = 40\nshare_of_pull_out = 0.5\n'
  done
} | sed 's/^steps_per_mm = .*/steps_per_turn = 200\nmicrosteps = 8\nscrew_pitch_mm = 4/' >"$new/torque.toml"
sed -e '/^\[axis.Y\]/,/^\[axis.Z\]/ { s/^\[axis.Y\]/[axis.A]/; s/_mm_s/_deg_s/; s/_mm/_deg/; s/= 100$/= 1500/; s/= 500$/= 7500/; s/\[-1000, 1000\]/[-100000, 100000]/ }' \
  -e 's/^path_tolerance.*/path_tolerance_mm = 0.01/' "$bench" >"$new/rotary.toml"
# Y becomes A, 15 degrees for a millimetre, on programs of lines.
rotary_program() {
  perl -pe 's/\(.*?\)//g; s/Y\s*(-?[\d.]+)/"A" . 15 * $1/ge' "$1"
}

# NAME PROGRAM MACHINE
row() {
  local run check
  if ! /usr/bin/time -o "$new/run" -f '%e %U %S %M' timeout 600 "$passo" run --yes "$2" -m "$3" --json --quiet >"$new/run.json" 2>/dev/null; then
    echo "| $1 | refused |"
    return
  fi
  /usr/bin/time -o "$new/check" -f '%e %U %S %M' timeout 1200 "$passo" check "$2" -m "$3" --motion --json >"$new/check.json" 2>/dev/null || true
  run=$(tail -1 "$new/run")
  check=$(tail -1 "$new/check")
  jq -r --arg name "$1" --arg run "$run" --arg check "$check" '
    def shown($digits): . * pow(10; $digits) | round / pow(10; $digits) | tostring;
    ($run | split(" ") | map(tonumber)) as $r | ($check | split(" ") | map(tonumber)) as $c
    | [$name, (.time_s | shown(3)), (.time_bound_s | shown(3)), (.time_over_bound | shown(4)), (.time_over_tube_bound | shown(4)),
       ($r[1] + $r[2] | shown(2)), ($r[3] / 1024 | shown(1)), ($c[1] + $c[2] | shown(2)), ($c[3] / 1024 | shown(1)),
       (($c[1] + $c[2]) / ($r[1] + $r[2] + 1e-9) | shown(2)), (if .good then "yes" else "no" end)]
    | "| " + join(" | ") + " |"' "$new/check.json" 2>/dev/null || echo "| $1 | the check failed |"
}
head_of_table() {
  echo
  echo "| $1 | time, s | bound, s | time / bound | in the tube | run, CPU s | MB | check, CPU s | MB | check / run | good |"
  echo "|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|---|"
}

programs() {
  local machine program name
  local -a all=()
  for program in "$shared"/peers/motion-mm/*.nc examples/*.ngc; do [[ -e $program ]] && all+=("$program"); done
  # A spiral of chords at many speeds.
  python3 -c '
import math
print("G21 G90 G64 P0.01 F6000\nG0 X0 Y0")
for i in range(1, 12000): print("G1 X%.4f Y%.4f" % (0.004 * i * math.cos(0.012 * i), 0.004 * i * math.sin(0.012 * i)))
print("M2")' >"$new/spiral.nc"
  all+=("$new/spiral.nc")
  for machine in bench jerk torque backlash; do
    head_of_table "$machine"
    for program in "${all[@]}"; do
      row "$(basename "$program")" "$program" "$([[ $machine == bench ]] && echo "$bench" || echo "$new/$machine.toml")"
    done
  done
  head_of_table rotary
  for program in "$shared"/peers/motion-mm/p0[1345]*.nc "$new/spiral.nc"; do
    [[ -e $program ]] || continue
    rotary_program "$program" >"$new/rotary.nc"
    row "$(basename "$program")" "$new/rotary.nc" "$new/rotary.toml"
  done
  head_of_table 'with its own machine'
  while read -r folder name machine; do
    [[ -e $shared/$folder/$name ]] || continue
    [[ $machine == bench.toml ]] && machine=$bench || machine=$shared/$folder/$machine
    row "$name ($(basename "$machine"))" "$shared/$folder/$name" "$machine"
  done <<'END'
peers/motion-repro k2447m.ngc k2447.toml
peers/motion-repro rot.ngc rotj.toml
peers/motion-repro slowarc.ngc bench.toml
peers/motion-repro stall.ngc mixY.toml
peers/motion-repro z1424.ngc z1424.toml
cases/motion check_hang.ngc check_hang.toml
cases/motion crawl.ngc crawl.toml
cases/motion hold_jump.ngc hold_jump.toml
cases/motion mixjump.ngc mixjump.toml
cases/motion slow_hold.ngc slow_hold.toml
cases/motion circle.ngc curve.toml
cases/motion rounded_circle.ngc curve.toml
cases/motion circle.ngc curve_jerk.toml
cases/motion rounded_circle.ngc curve_jerk.toml
END
}

# One curve: the times of lines, arcs and pairs of arcs as rows of values.
curves() {
  local machine step base wave petals mode time cpu arcs
  [[ -e $shared/cases/motion/make_curve.py ]] || { echo "there is no $shared/cases/motion/make_curve.py"; return; }
  for machine in curve curve_jerk; do
    : >"$new/times"
    while read -r base wave petals; do
      for step in 0.05 0.1 0.2 0.5 1; do
        for mode in lines one biarc; do
          local file=$new/$mode-$step-$base-$wave-$petals.ngc
          [[ -e $file ]] || python3 "$shared/cases/motion/make_curve.py" $step 3 "$file" $mode $base $wave $petals
          /usr/bin/time -o "$new/run" -f '%U %S' "$passo" run --yes "$file" -m "$shared/cases/motion/$machine.toml" --json --quiet >"$new/run.json" 2>/dev/null || true
          time=$(jq -r .time_s "$new/run.json" 2>/dev/null || echo nan)
          cpu=$(tail -1 "$new/run" | awk '{ print $1 + $2 }')
          arcs=$(grep -c '^G[23]' "$file" || true)
          echo "$base/$wave/$petals $step $mode ${time:-nan} $cpu $arcs" >>"$new/times"
        done
      done
    done <<'END'
15 9 12
15 3 12
15 6 5
20 2 30
10 4 3
30 10 8
8 2 20
25 20 2
12 6 7
40 5 16
END
    # Arcs of a length may be compared with lines of that length or shorter.
    printf '\n| %s: length of a move, mm | lines, s (15/9/12) | arcs / lines, median | worst | pairs of arcs / lines, median | worst | CPU ms for an arc, worst |\n' $machine
    echo '|---|---:|---:|---:|---:|---:|---:|'
    python3 - "$new/times" <<'END'
import statistics, sys
times = {}
cost = {}
for line in open(sys.argv[1]):
    curve, step, mode, time, cpu, arcs = line.split()
    times[curve, float(step), mode] = float(time)
    if int(arcs) >= 200: cost[float(step)] = max(cost.get(float(step), 0), 1e3 * float(cpu) / int(arcs))  # else it is the start
curves = sorted({key[0] for key in times})
steps = sorted({key[1] for key in times})
for step in steps:
    row = [f"{step:g}", f"{times['15/9/12', step, 'lines']:.3f}"]
    for mode in "one", "biarc":
        ratios = [times[c, step, mode] / min(times[c, s, "lines"] for s in steps if s <= step) for c in curves]
        row += [f"{statistics.median(ratios):.4f}", f"{max(ratios):.4f}"]
    print("| " + " | ".join(row + [f"{cost[step]:.2f}" if step in cost else "few arcs"]) + " |")
END
  done
}

[[ $what == curves ]] || programs
[[ $what == programs ]] || curves

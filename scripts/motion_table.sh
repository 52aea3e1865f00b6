#!/usr/bin/env bash
# scripts/motion_table.sh [DIR…]: measures the motion of programs on examples/machines/bench.toml, and prints two tables:
# as the machine is, and with limits of jerk by which full acceleration takes 20 ms. The line is measured on the same
# machine with a board of 100,000 events a second.
#
# Without a DIR it makes all tables of the documents that measure motion: the programs of examples/ and moves from rest to
# rest, whose tables go into docs/motion.md too, between their marks; where they are at hand, those of
# ../shared/peers/motion-mm, which are printed only; and those of tube_table (circles of chords, corners, the bound in the
# tube) for docs/smoothing.md and docs/motion-proof.md, which are printed. Needs build/release/passo, and jq.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
if [[ ${1-} == -* ]]; then
  sed -n '2,9s/^# \{0,1\}//p' scripts/motion_table.sh
  exit 2
fi
passo=build/release/passo
for needed in "$passo" jq; do
  command -v "$needed" >/dev/null || { echo "motion_table.sh: there is no $needed" >&2; exit 1; }
done

new=$(mktemp -d)
trap 'rm -rf "$new"' EXIT
machine=examples/machines/bench.toml
sed 's/^max_acceleration_mm_s2 = .*/&\nmax_jerk_mm_s3 = 25_000/' "$machine" >"$new/smooth.toml"

# $1 a folder, $2 a machine file. A motion beyond its limits (exit code 1) is a row like any other.
table() {
  echo "| program | time, s | time / bound | in the tube | velocity × | acceleration × | jerk × | in steps × | jump, mm/s | deviation × | link, kB/s | at most | good |"
  echo "|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---|"
  local program json line
  sed 's/^max_event_rate_hz = .*/max_event_rate_hz = 100_000/' "$2" >"$new/slow_board.toml"
  for program in "$1"/*.ngc "$1"/*.nc; do
    [[ -e $program ]] || continue
    json=$("$passo" check "$program" -m "$2" --motion --json 2>/dev/null) || (($? == 1))
    line=$("$passo" run "$program" -m "$new/slow_board.toml" --json --quiet 2>/dev/null | jq -c .board) || line=null
    jq -r --argjson line "${line:-null}" --arg name "$(basename "$program")" '
      def shown($digits): . * pow(10; $digits) | round / pow(10; $digits) | tostring;
      def worst(f): [.axes[] | f // 0] | max;
      [$name, (.time_s | shown(3)), (.time_over_bound | shown(4)), (.time_over_tube_bound | shown(4)),
       (worst(.velocity.multiple) | shown(4)), (worst(.acceleration.multiple) | shown(4)),
       (if any(.axes[].jerk.limit; . != null and . > 0) then worst(.jerk.multiple) | shown(4) else "none" end),
       (worst(.step_acceleration.multiple) | shown(2)), (worst(.velocity_jump.value) | shown(6)),
       (.deviation.multiple | if . == null then "none" else shown(4) end),
       ($line | if . == null then "none" else (.bytes / .end_s / 1000 | shown(1)) end),
       ($line | if . == null then "none" else (.bytes_in_busiest_second / 1000 | shown(1)) end), (if .good then "yes" else "no" end)]
      | "| " + join(" | ") + " |"' <<<"$json"
  done
}

# Moves of X from rest to rest against the closed form, with 500 mm/s² and 25,000 mm/s³. Only long moves reach the
# limit of acceleration: those longer than 2 a³/j².
rest_table() {
  echo "| distance, mm | time, ms | closed form, ms | ratio |"
  echo "|---:|---:|---:|---:|"
  local way
  for way in 1 0.1 0.01; do
    echo "G21 G0 X$way M2" >"$new/rest.ngc"
    "$passo" check "$new/rest.ngc" -m "$new/smooth.toml" --motion --json 2>/dev/null | jq -r --argjson way "$way" '
      500 as $a | 25000 as $j
      | (if $way > 2 * $a * $a * $a / ($j * $j) then $a / $j + (($a / $j) * ($a / $j) + 4 * $way / $a | sqrt)
         else 4 * pow($way / (2 * $j); 1 / 3) end) as $best
      | def shown($digits): . * pow(10; $digits) | round / pow(10; $digits) | tostring;
      "| \($way) | \(.time_s * 1000 | shown(3)) | \($best * 1000 | shown(3)) | \(.time_s / $best | shown(6)) |"'
  done
}

if (($# > 0)); then
  for directory in "$@"; do
    table "$directory" "$machine"
    echo
    table "$directory" "$new/smooth.toml"
  done
  exit
fi

document=docs/motion.md
table examples "$machine" >"$new/examples"
table examples "$new/smooth.toml" >"$new/smooth"
rest_table >"$new/rests"
scripts/put_tables.sh "$document" "$new"
for part in examples smooth rests; do
  cat "$new/$part"
  echo
done
if [[ -d ../shared/peers/motion-mm ]]; then
  echo
  table ../shared/peers/motion-mm "$machine"
  echo
  table ../shared/peers/motion-mm "$new/smooth.toml"
fi
echo
cmake --build build/release --target tube_table >/dev/null && build/release/bench/tube_table

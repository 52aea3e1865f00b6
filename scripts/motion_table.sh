#!/usr/bin/env bash
# scripts/motion_table.sh [DIR…]: measures the motion of programs on examples/machines/bench.toml, and prints two tables:
# as the machine is, and with limits of jerk by which full acceleration takes 20 ms. The line is measured on the same
# machine with a board of 100,000 events a second.
#
# Without a DIR: the programs of examples/, whose tables go into docs/motion.md too, between their marks, and, where they
# are at hand, those of ../shared/peers/motion-mm, which are printed only. Needs build/release/passo, and jq.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
if [[ ${1-} == -* ]]; then
  sed -n '2,7s/^# \{0,1\}//p' scripts/motion_table.sh
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
  echo "| program | time, s | time / bound | in the tube | velocity × | acceleration × | jerk × | in the steps × | velocity jump, mm/s | deviation × | line, kB/s | at most | good |"
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
awk -v directory="$new" '
  /^<!-- end of .* -->$/ { skipping = 0 }
  !skipping { print }
  /^<!-- (examples|smooth) -->$/ {
    skipping = 1
    while ((getline line < (directory "/" $2)) > 0) print line
  }' "$document" >"$new/document"
cat "$new/document" >"$document"
cat "$new/examples" - "$new/smooth" <<<""
if [[ -d ../shared/peers/motion-mm ]]; then
  echo
  table ../shared/peers/motion-mm "$machine"
  echo
  table ../shared/peers/motion-mm "$new/smooth.toml"
fi

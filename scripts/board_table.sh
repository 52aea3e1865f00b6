#!/usr/bin/env bash
# scripts/board_table.sh [--pico | --chips | PROGRAM...]: how long jobs take over a line to an Uno, a Mega and a Pico, beside the time
# that they take without a line. Writes the tables into docs/boards.md, between their marks; with --pico, that of the Pico
# only; with --chips, that of the emulated Uno and Mega only; with PROGRAM, these programs only, just printed. Where they
# are at hand, the programs of ../shared/peers/motion-mm come after that, in a table that is printed only.
#
# The boards are virtual, with the places and the rates of the real ones, on a line of 500 kbaud. With --chips the firmware
# itself plays, which also takes its time for each frame.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

case ${1-} in
  --pico | --chips) ;;
  -*)
    sed -n '2,8s/^# \{0,1\}//p' scripts/board_table.sh
    exit 2
    ;;
esac

build=build/release
passo=$PWD/$build/passo
cmake --build "$build" --parallel "$(nproc)" --target passo >/dev/null
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# circles FEED: six circles of radius 30 and six of radius 18.
circles() {
  echo "G21 G90 G17 G64 S8000 M3 F$1"
  for radius in 30 18; do
    echo "G0 X$radius Y0"
    for _ in 1 2 3 4 5 6; do echo "G3 X$radius Y0 I-$radius J0"; done
  done
  echo M2
}
for feed in 1200 2400 3600 6000; do circles "$feed" >"$work/circles-F$feed.ngc"; done
{
  echo "G21 G90"
  for _ in 1 2 3; do printf 'G0 X80\nG0 X0\n'; done
  echo M2
} >"$work/rapids.ngc"
{
  echo "G21 G90 G64 S8000 M3 F13000"
  for _ in 1 2; do
    printf 'G1 %s\n' 'X300 Y200 Z-30' 'X-250 Y150 Z10' 'X100 Y-220 Z-50' 'X-300 Y-250 Z5' 'X280 Y-100 Z-40' \
      'X-100 Y250 Z25' 'X250 Y230 Z-55'
  done
  echo M2
} >"$work/moves-3d.ngc"

# Chords of 0.1 mm at 100 mm/s: a spiral, and rows of a relief.
{
  echo "G21 G90 G64 S8000 M3 F6000"
  awk 'BEGIN { for (r = 5; r < 30; r = 5 + a / 3.14159) { printf "G1 X%.4f Y%.4f\n", r * cos(a), r * sin(a); a += 0.1 / r } }'
  echo M2
} >"$work/chords-spiral.ngc"
{
  echo "G21 G90 G64 S8000 M3 F6000"
  awk 'BEGIN { for (row = 0; row < 4; ++row) for (i = 0; i <= 600; ++i) { x = (row % 2 ? 600 - i : i) / 10
    printf "G1 X%.3f Y%.3f Z%.3f\n", x, row / 5, -2 + 1.5 * sin(0.7 * x) * cos(row) + 0.3 * sin(3 * x) } }'
  echo M2
} >"$work/chords-relief.ngc"

# machine NAME PLACES RATE VELOCITY JERK: the router of examples/machines/uno.toml.
machine() {
  sed -e "s/^held_items = [0-9]*/held_items = $2/" -e "s/^max_event_rate_hz = [0-9_]*/max_event_rate_hz = $3/" \
    -e "s/^max_velocity_mm_s = [0-9]*/max_velocity_mm_s = $4/" examples/machines/uno.toml >"$work/$1.toml"
  [[ $5 = none ]] || sed -i "s/^\(max_acceleration_mm_s2 = .*\)/\1\nmax_jerk_mm_s3 = $5/" "$work/$1.toml"
}
machine Uno 42 150000 100 none
machine Mega 160 110000 100 none
machine Uno-jerk 42 150000 100 10000
machine Mega-jerk 160 110000 100 10000
# The Pico's own machine, with the most places that a virtual board has: 10 fewer than the Pico's.
sed 's/^\(max_event_rate_hz = .*\)/\1\nheld_items = 240/' examples/machines/pico.toml >"$work/Pico.toml"
sed 's/^\(max_acceleration_mm_s2 = [0-9]*\).*/\1\nmax_jerk_mm_s3 = 10000/' "$work/Pico.toml" >"$work/Pico-jerk.toml"
machine Uno-fast 42 150000 234 none
machine Mega-fast 160 110000 171 none

# The value behind a word at a line's beginning.
value() { awk -v word="$1" '$1 == word { print $2; exit }'; }
seconds() { awk -F: '{ printf "%.2f", $1 * 60 + $2 }'; }

# row PROGRAM MACHINE [BOARD]: over a line to a virtual board, or to that one.
row() {
  local alone line
  if ! alone=$("$passo" run "$1" -m "$work/$2.toml" 2>/dev/null); then
    echo "| $(basename "${1%.*}") | ${2/-/, } | leaves the travel | | | | |"
    return
  fi
  local over=(--cut-cable-at 9999:1)
  [[ -z ${3-} ]] || over=(--yes --board "$3")
  if ! line=$("$passo" run "$1" -m "$work/$2.toml" "${over[@]}" 2>"$work/said") && ! grep -q 'board.slipped' "$work/said"; then
    cat "$work/said" >&2
    exit 1
  fi
  local without with rests sent
  without=$(value end <<<"$alone" | seconds)
  with=$(value end <<<"$line" | seconds)
  rests=$(sed -n 's/.*and rested \([a-z0-9]*\).*/\1/p' <<<"$line")
  ! grep -q 'board.slipped' "$work/said" || rests+=", and stood still"
  sent=$(awk '$1 == "sent" { print $2, $3; exit }' <<<"$line")
  echo "| $(basename "${1%.*}") | ${2/-/, } | $without | $with |" \
    "$(awk -v a="$without" -v b="$with" 'BEGIN { printf "%.3f", b / a }') | $rests | $sent |"
}

programs=("$@")
[[ ${1-} != --* ]] || programs=()
((${#programs[@]} > 0)) || programs=("$work"/circles-F*.ngc "$work/rapids.ngc" examples/pocket.ngc examples/engrave.ngc examples/drill-board.ngc)
table() {
  echo "| program | board | without a link, s | over the link, s | ratio | stops | sent |"
  echo "|---|---|---:|---:|---:|---|---:|"
  for board in Uno Mega Uno-jerk Mega-jerk; do
    for program in "${programs[@]}"; do row "$program" "$board"; done
  done
  (($# > 0)) || for board in Uno Mega; do row "$work/moves-3d.ngc" "$board-fast"; done
}
pico_table() {
  echo "| program | board | without a link, s | over the link, s | ratio | stops | sent |"
  echo "|---|---|---:|---:|---:|---|---:|"
  local name
  for name in "$work"/{circles-F6000,rapids,moves-3d,chords-spiral,chords-relief}.ngc examples/{pocket,engrave,drill-board}.ngc; do
    row "$name" Pico
  done
  for name in "$work"/{circles-F6000,rapids,moves-3d,chords-spiral}.ngc examples/engrave.ngc; do row "$name" Pico-jerk; done
}
chip_table() {
  echo "| program | chip | without a link, s | over the link, s | ratio | stops | sent |"
  echo "|---|---|---:|---:|---:|---|---:|"
  local board chip name
  for board in Uno Mega Uno-jerk Mega-jerk; do
    for name in "${programs[@]}" "$work"/chords-{spiral,relief}.ngc; do
      chip=${board%-jerk}
      row "$name" "$board" "sim:${chip,}"
    done
  done
  for chip in Uno Mega; do row "$work/moves-3d.ngc" "$chip-fast" "sim:${chip,}"; done
}
if [[ ${1-} == --chips ]]; then
  cmake --build "$build" --parallel "$(nproc)" --target emulated_boards >/dev/null
  chip_table >"$work/chip-jobs"
  scripts/put_tables.sh docs/boards.md "$work"
  cat "$work/chip-jobs"
  exit
fi
if (($# > 0)) && [[ $1 != --pico ]]; then
  table "$@"
  exit
fi
pico_table >"$work/pico-jobs"
[[ ${1-} == --pico ]] || table >"$work/jobs"
scripts/put_tables.sh docs/boards.md "$work"
cat "$work"/*jobs
[[ ${1-} != --pico ]] || exit 0
programs=(../shared/peers/motion-mm/*.nc)
if [[ -e ${programs[0]} ]]; then
  # Some of them leave the router's travel.
  sed -i 's/^travel_mm = .*/travel_mm = [-2000, 2000]/; s/^switch_at_mm = \(-\?\).*/switch_at_mm = \12001/' "$work"/{Uno,Mega}*.toml
  echo
  table printed
else
  echo "board_table.sh: there is no ../shared/peers/motion-mm: no table of its programs" >&2
fi

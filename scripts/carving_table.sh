#!/usr/bin/env bash
# scripts/carving_table.sh [PROGRAM...]: measures what carving costs on this computer, and prints it as a table: places
# of a cutter on a surface, reliefs of small and large pictures, the cut of 65,000 moves by each shape of tool, a carved
# text of 42 characters, a pocket by constant engagement, and the time of a relief's program by passo check beside that of
# its run. Each PROGRAM is cut out of its stock too, with a flat 3 mm tool in cells of 0.1 mm.
#
# Times are those of the processor, of all threads. Needs build/release with benchmarks (PASSO_BUILD_BENCHMARKS=ON), and jq.
set -euo pipefail
if [[ ${1-} == -* ]]; then
  sed -n '2,7s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"
  exit 2
fi
programs=()
for program in "$@"; do programs+=("$(readlink -e "$program")"); done
cd "$(dirname "${BASH_SOURCE[0]}")/.."
passo=build/release/passo
for needed in "$passo" build/release/bench/relief_benchmark build/release/bench/stock_benchmark jq; do
  command -v "$needed" >/dev/null || { echo "carving_table.sh: there is no $needed" >&2; exit 1; }
done

new=$(mktemp -d)
trap 'rm -rf "$new"' EXIT
row() { printf '| %s | %s | %s |\n' "$@"; }
# $1 what it is; then a command. Its seconds of processor time, and its memory.
measure() {
  local what=$1 user system kib
  shift
  bash -c 'TIMEFORMAT="%U %S"; time "$@" >/dev/null 2>&1' - "$@" 2>"$new/time" || { row "$what" failed ""; return; }
  read -r user system < <(tail -n 1 "$new/time")
  # The same once more, for its memory.
  kib=$("$@" >/dev/null 2>&1 & awk -v file="/proc/$!/status" 'BEGIN {
    do { found = 0
      while ((getline line < file) > 0) if (line ~ /^VmHWM/) { split(line, word); if (word[2] > most) most = word[2]; found = 1 }
      close(file); system("sleep 0.01") } while (found)
    print most + 0 }')
  row "$what" "$(awk "BEGIN { printf \"%.2f s\", $user + $system }")" "$((kib / 1024)) MiB"
}

echo "| what | processor time | memory |"
echo "|---|---:|---:|"
build/release/bench/relief_benchmark >"$new/relief"
sed -nE 's/^(\S+) +([0-9]+) x .* nodes, +(\S+) mm apart, 1 threads .* +(\S+) s CPU .*/\1 \2 \3 \4/p' "$new/relief" |
  while read -r cutter side pitch seconds; do row "places of $cutter on $side x $side nodes, $pitch mm apart" "$seconds s" ""; done
sed -nE 's/^([0-9].*[a-z]) +\S+ s wall +(\S+) s CPU +(\S+) MiB +(\S+) lines.*/\1;\2;\3;\4/p' "$new/relief" |
  while IFS=';' read -r what seconds memory lines; do row "$what, $lines lines" "$seconds s" "$memory MiB"; done
build/release/bench/stock_benchmark --benchmark_filter='/1/' --benchmark_format=json 2>/dev/null |
  jq -r '.benchmarks[] | "| 65,000 moves on 100 x 100 mm at 0.1 mm, \(.label) | \(.cpu_time / 10 | round / 100) s | |"' | sed 's/, 1 threads//'
measure "a text of 42 characters by a V-shaped cutter" "$passo" cam engrave --text "THE QUICK BROWN FOX JUMPS OVER A LAZY DOG!" \
  --height 10 -o "$new/text.ngc"
measure "a pocket by constant engagement, 40 x 14 mm, 3 mm cutter" "$passo" cam pocket examples/parts/bracket.svg --layer pocket \
  --tool 3 --depth -6 --step 6 --engagement 60 -o "$new/pocket.ngc"
"$passo" cam relief examples/reliefs/flower.png --width 60 --depth -4 --step 0.4 -o "$new/flower.ngc" >/dev/null
measure "the relief of the example cut, cells of 0.1 mm" "$passo" simulate "$new/flower.ngc" --tool ball:3 --cell 0.1
for program in "${programs[@]}"; do
  measure "$(basename "$program") cut, cells of 0.1 mm" "$passo" simulate "$program" --tool flat:3 --cell 0.1
done

machine=examples/machines/bench.toml
told=$("$passo" check "$new/flower.ngc" -m "$machine" --json | jq ".time_s + .dwell_s")
run=$("$passo" run "$new/flower.ngc" -m "$machine" --json --quiet | jq .time_s)
echo
awk "BEGIN { printf \"The relief of the example takes %.3f s by passo check, %.3f s as it runs: %.3f %% apart.\\n\", $told, $run, 100 * ($run / $told - 1) }"

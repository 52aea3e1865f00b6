#!/usr/bin/env bash
# scripts/isolation_table.sh [LAYER...]: isolates copper layers with a cutter of 0.2 mm, then as the report advises, and
# prints a row for each: the nets, how many stay joined, the advice, how many stay joined with it, the result of a check
# in pixels (scripts/isolation_oracle.py) of that program, and the seconds of both commands.
#
# Without LAYER: examples/boards, a generated board with some 800 islands, the boards of ../shared/peers/boards if they
# exist, and those of gerbv's examples if they are installed. The check is skipped if gerbv, or numpy, scipy or Pillow
# for Python ($PYTHON, or python3), is missing. The exit code is 1 if the advice fails for any layer.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
if [[ ${1-} == -* ]]; then
  sed -n '2,9s/^# \{0,1\}//p' scripts/isolation_table.sh
  exit 2
fi
python=${PYTHON-python3}
passo=${PASSO-build/release/passo}
[[ -x $passo ]] || { echo "isolation_table.sh: there is no $passo" >&2; exit 1; }
oracle=
if command -v gerbv >/dev/null && "$python" -c 'import numpy, scipy, PIL' 2>/dev/null; then oracle=scripts/isolation_oracle.py; fi
[[ -n $oracle ]] || echo "isolation_table.sh: no oracle: it needs gerbv, and numpy, scipy and Pillow for Python" >&2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# Rows of pads with traces between them: gaps of 0.127 to 0.2 mm.
large_board() {
  awk 'BEGIN {
    print "%FSLAX46Y46*%\n%MOMM*%\n%ADD10R,0.800000X0.500000*%\n%ADD11C,0.150000*%"
    for (row = 0; row < 20; ++row) {
      gap = 0.127 + 0.073 * row / 19
      for (column = 0; column < 20; ++column) {
        x = 3 * column; y = 3 * row
        printf "D10*\nX%dY%dD03*\n", x * 1e6, y * 1e6
        printf "D11*\nX%dY%dD02*\nX%dY%dD01*\nX%dY%dD01*\n", (x - 0.7) * 1e6, (y + 0.325 + gap) * 1e6, (x + 0.7) * 1e6, (y + 0.325 + gap) * 1e6, (x + 1.3) * 1e6, (y + 0.9 + gap) * 1e6
      }
    }
    print "M02*"
  }'
}

layers=("$@")
if [[ $# == 0 ]]; then
  layers=(examples/boards/timer-B_Cu.gbr "$work/800-islands.gbr")
  large_board >"$work/800-islands.gbr"
  if [[ -d ../shared/peers/boards ]]; then
    layers+=(../shared/peers/boards/*/*_Cu.gbr ../shared/peers/boards/*/*-?.Cu.gbr ../shared/peers/boards/*/*.G[TB]L)
  else
    echo "isolation_table.sh: ../shared/peers/boards is absent: without its boards" >&2
  fi
  examples=/usr/share/doc/gerbv/examples
  if [[ -d $examples ]]; then
    for layer in cslk/cslk.gbx dan/top.gbx eaglecad1/top-cop.gbx ekf/l1.off ekf2/l0.grb ekf2/l5.grb hellboard/hellboard.front.gbr \
      hellboard/hellboard.back.gbr jj/l1-orig.grb nollezappare/EtchLayer2Bottom.gdo numpres/numpres.pcb.output_group1.grb \
      orcad/rs232_cm.bot orcad/rs232_cm.top protel-pnp/SE_SG_IF_V2.GTL protel-pnp/SE_SG_IF_V2.GBL; do
      layers+=("$examples/$layer")
    done
  else
    echo "isolation_table.sh: gerbv's examples are absent: without them" >&2
  fi
fi

limit=${LIMIT_S-300}
isolate() {  # OPTION...; `said` becomes the report, `took` the seconds
  local begin=$EPOCHREALTIME
  said=$(timeout "$limit" "$passo" cam isolate "$layer" "$@" -o "$work/i.ngc" 2>&1) || true
  took=$(awk "BEGIN { printf \"%.1f\", $EPOCHREALTIME - $begin }")
}
joined() { sed -nE 's/.* nets?( in [^,]+ islands)?, (.*)/\2/p' <<<"$said" | sed -E 's/ of them still joined.*//; s/all apart.*/0/' | tail -n 1; }

failed=0
printf '| layer | nets | joined | advice | joined then | oracle | s |\n|---|---:|---:|---|---:|---|---:|\n'
for layer in "${layers[@]}"; do
  name=$(basename "$(dirname "$layer")")/$(basename "$layer")
  [[ -e $layer ]] || continue
  isolate --tool 0.2
  first=$took
  nets=$(sed -nE 's/^proof: [^;]*; ([^;]*[0-9]) nets?[ ,].*/\1/p' <<<"$said" | tail -n 1 | tr -dc 0-9)
  before=$(joined)
  advice=$(sed -nE 's/.*: (-.*) was tried: .*/\1/p' <<<"$said" | tail -n 1)
  promise=$(sed -nE 's/.* was tried: (all nets are apart|[0-9]+).*/\1/p' <<<"$said" | tail -n 1)
  cutter=0.2 loss=0.03 after=$before
  if [[ -z $before ]]; then
    printf '| %s | | | %s | | | %s |\n' "$name" "$(grep -o 'error: .*' <<<"$said" | tail -n 1 || true)" "$first"
    continue
  fi
  took=0
  if [[ -n $advice ]]; then
    words=$advice
    [[ $words == *--tool* ]] || words="--tool 0.2 $words"
    # shellcheck disable=SC2086
    isolate $words
    after=$(joined)
    cutter=$(sed -nE 's/.*--tool ([0-9.]+).*/\1/p' <<<"$words")
    [[ $words != *--allow-loss* ]] || loss=$(sed -nE 's/.*--allow-loss ([0-9.]+).*/\1/p' <<<"$words")
    [[ $after == "${promise/all nets are apart/0}" ]] || failed=1
  fi
  verdict=
  [[ -z $oracle ]] || verdict=$(timeout "$limit" "$python" "$oracle" "$layer" "$work/i.ngc" "$cutter" "$loss" 2>/dev/null) || verdict='none'
  printf '| %s | %s | %s | %s | %s | %s | %s |\n' "$name" "$nets" "$before" "${advice:-none}" "$after" "$verdict" \
    "$(awk "BEGIN { printf \"%.1f\", $first + $took }")"
done
exit "$failed"

#!/bin/bash
# Nests five sets of parts (scripts/nesting_sets.py), and prints density and CPU time: scripts/nesting_table.sh [SET…]
#
# With json-nest (npm install json-nest, in a folder that NODE_PATH names) it also prints how many parts that finds.
set -euo pipefail
passo=${PASSO:-build/release/passo}
folder=$(mktemp -d)
trap 'rm -r "$folder"' EXIT
python3 "$(dirname "$0")/nesting_sets.py" "$folder"
printf '%-12s %6s %9s %9s %8s %8s\n' set parts 'length mm' 'density %' layouts 'CPU s'
for name in ${*:-rectangles ells gears letters mixed}; do
  # Without a nest: the same reading, planning and writing.
  TIMEFORMAT=%U
  order=(cam profile "$folder/$name.svg" --tool 0.1 --depth -1 --step 1 --no-tabs --json -o "$folder/cut.ngc")
  alone=$( { time "$passo" "${order[@]}" > "$folder/alone.json" 2> /dev/null; } 2>&1)
  nested=$( { time "$passo" "${order[@]}" --nest 1200,400 --gap 4 --nest-margin 4 > "$folder/nested.json" 2> /dev/null; } 2>&1)
  python3 - "$folder" "$name" "$alone" "$nested" <<'PYTHON'
import json, sys
folder, name, alone, nested = sys.argv[1:]
nest = json.load(open(f"{folder}/nested.json"))["nest"]
copies = sum(len(sheet["copies"]) for sheet in nest["sheets"])
print(f"{name:12} {copies:6} {nest['sheets'][-1]['used_mm'] + 4:9.1f} {100 * nest['density']:9.1f} {nest['layouts']:8} "
      f"{max(0.0, float(nested) - float(alone)):8.1f}")
PYTHON
  if [[ -n "${NODE_PATH:-}" ]]; then
    node -e '
      const { svgnest } = require("json-nest/dist/index.js");
      const point = (p) => ({ x: p[0], y: p[1] });
      const path = (p) => ({ segments: p.map((a, i) => ({ type: "line", pointA: point(a), pointB: point(p[(i + 1) % p.length]) })) });
      const parts = JSON.parse(require("fs").readFileSync(process.argv[1]));
      const sheet = { paths: [path([[0, 0], [1200, 0], [1200, 400], [0, 400]])], isRemnant: true };
      const nest = new svgnest({ rawParts: parts.map((p) => ({ paths: [path(p)] })), rawSheets: [sheet], config: { spacing: 4 },
                                 progressCallback() {}, displayCallback() {} });
      console.log(`json-nest: ${nest.parts.length} parts`);' "$folder/$name.json"
  fi
done

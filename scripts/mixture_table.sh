#!/usr/bin/env bash
# scripts/mixture_table.sh [PROGRAMS [HALTED [SEED]]]: measures random programs on random machines with every mixture of
# limits (jerk, torque, backlash, start-stop velocities, rotary axes, each on any axes), and prints tables: the time
# against the prover's bound by mixture, the largest ratios to the limits, judged from the steps, and the time of a hold
# to rest against the least possible. Then the numbers of the programs that break the law, with what is wrong.
#
# PROGRAMS: 5000 unless given, about 20 a second. HALTED: programs with holds, overrides and stops at some eight
# instants, 2500 unless given. SEED: of the first program; a new one unless given. The rows are in
# build/mixtures/SEED.tsv. Needs build/release/tests/random_motion_tests. The exit code is 1 if the law is broken.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
if [[ ${1-} == -* ]]; then
  sed -n '2,10s/^# \{0,1\}//p' scripts/mixture_table.sh
  exit 2
fi
programs=${1-5000} halted=${2-2500} seed=${3-$(date +%s)}
program=${PASSO_TESTS-build/release/tests/random_motion_tests}
[[ -x $program ]] || { echo "mixture_table.sh: there is no $program" >&2; exit 1; }
mkdir -p build/mixtures
rows=build/mixtures/$seed.tsv
rows_of() {  # TEST PROGRAMS
  (($2 > 0)) || return 0
  PASSO_ROWS=1 PASSO_SEED=$seed PASSO_RUNS=$2 "$program" --gtest_filter="$1" 2>/dev/null | grep -aP '^(time|halt|acts|killed)\t' || true
}
{
  rows_of 'MixtureLaw.*' "$programs"
  rows_of 'RandomHalt.keeps*' "$halted"
} >"$rows"
echo "seed $seed, $(grep -c '^time' "$rows") programs, $(grep -c '^acts' "$rows") with holds, overrides and stops"

# NAME, then values on the standard input.
spread() {
  sort -g | awk -v name="$1" '
    { value[NR] = $1 }
    function at(share) { return value[int(share * (NR - 1)) + 1] }
    END {
      if (NR > 0) printf "| %s | %d | %.4f | %.4f | %.4f | %.4f | %.4f |\n", name, NR, value[1], at(0.5), at(0.95), at(0.99), value[NR]
    }'
}
head_of_table() {  # FIRST COLUMN
  printf '\n| %s | number | least | median | 95 %% | 99 %% | worst |\n|---|---:|---:|---:|---:|---:|---:|\n' "$1"
}
# The values of a column ($2) of the rows that match the condition ($1).
column() { awk -F'\t' "$1 { print $2 }" "$rows"; }
by_mixture() {  # CONDITION COLUMN
  local limit share
  for limit in jerk torque backlash starts rotary; do
    for share in none some all; do
      column "$1 && \$3 ~ /$limit=$share/" "$2" | spread "$limit on $share of the axes"
    done
  done
}

law='$1 == "time" && $4 > 1'
head_of_table 'time / bound, programs of more than 1 s'
column "$law" '$5' | spread 'all'
by_mixture "$law" '$5'
column "$law && \$3 !~ /jerk=some/ && \$3 ~ /torque=none backlash=none starts=none rotary=none/" '$5' | spread 'jerk on all axes or none, nothing else'
column '$1 == "time" && $4 > 1' '$6' | spread 'all, bound in the tube'
head_of_table 'ratio to the limit, all programs'
column '$1 == "time"' '$8' | spread 'velocity'
column '$1 == "time"' '$9' | spread 'acceleration'
column '$1 == "time"' '$10' | spread 'jerk'
column '$1 == "time"' '$11' | spread 'feed'
column '$1 == "time"' '$12' | spread 'deviation'
column '$1 == "time"' '$7' | spread 'seconds of CPU'
# At rest the drive says so. The last step is no measure: it comes up to 0.2 s sooner where the motion is slow, or even
# before the hold.
halt='$1 == "halt" && $7 > 0.02'
head_of_table 'hold or stop to rest / least possible, if that is more than 20 ms'
column "$halt" '$6 / $7' | spread 'all'
column "$halt && \$8 == \"line\"" '$6 / $7' | spread 'on a line'
column "$halt && \$8 == \"bend\"" '$6 / $7' | spread 'on a bend, where the least time is too low'
column "$halt && \$9 > 0" '$6 / $9' | spread 'on a bend, a rest sooner by a fifth was found'
by_mixture "$halt" '$6 / $7'

echo
column '$1 == "acts"' '$4' | awk '{ sum += $1 } END { printf "%d instants of holds, resumes, overrides and stops\n", sum }'
broken=$(awk -F'\t' '
  $1 == "time" && $13 != "" { print "MixtureLaw " $2 ": " $13 " (" $3 ")" }
  $1 == "acts" && $5 != "" { print "RandomHalt " $2 ": " $5 " (" $3 ")" }
  $1 == "killed" { print "killed " $2 ": " $4 " (" $3 ")" }
  $1 == "halt" && $7 > 0.02 && $8 == "line" && $6 / $7 > 1.2 { printf "RandomHalt %s: %s at %.4f s rests in %.3f times the least time (%s)\n", $2, $4, $5, $6 / $7, $3 }
  $1 == "halt" && $9 > 0 { printf "RandomHalt %s: %s at %.4f s rests in %.3f times a time that was found (%s)\n", $2, $4, $5, $6 / $9, $3 }
' "$rows")
[[ -z $broken ]] && exit 0
printf '\n%d break the law:\n%s\n' "$(wc -l <<<"$broken")" "$broken"
exit 1

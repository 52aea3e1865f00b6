#!/usr/bin/env bash
# scripts/mutations.sh [NUMBER…]: mutates the planner and the path in more than twenty ways, and shows which random test
# or figure of the prover finds each mutation. Not a part of CI: it takes some minutes.
#
# All mutations are in one program: each is an expression that depends on PASSO_MUTANT. So the two modules are compiled
# once, in a copy below build/mutations. A mutation whose text is not found exactly once is an error. The build in
# build/release must be up to date. NUMBER: only these. The exit code is 1 if a mutation survives.
#
# PASSO_RUNS: the random programs of each test, 150 unless it is set. The table is in docs/motion-proof.md.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

release=$PWD/build/release
copy=$PWD/build/mutations
program=tests/random_motion_tests
rm -rf "$copy"
mkdir -p "$copy/motion"
cp -r src/motion/path src/motion/trajectory "$copy/motion"

count=0
names=()
mutate() {  # FILE NAME FROM TO; MUTANT in TO is true if this mutation is chosen
  count=$((count + 1))
  names[count]=$2
  and_also "$1" "$3" "$4"
}
and_also() {  # FILE FROM TO: a further place of the last mutation
  FROM=$2 TO=${3//MUTANT/mutant($count)} perl -0777 -i -pe \
    '$n = s/\Q$ENV{FROM}\E/$ENV{TO}/g; die "$ARGV: found ", $n || 0, " times: $ENV{FROM}\n" if $n != 1' \
    "$copy/motion/$1"
}

mutate trajectory/limited_axis.cpp 'the velocity limit of an axis doubled' \
  '.velocity = limit_or_infinity(velocity.value()),' '.velocity = (MUTANT ? 2 : 1) * limit_or_infinity(velocity.value()),'
mutate trajectory/limited_axis.cpp 'the acceleration limit of an axis raised by 1 %' \
  '.acceleration = limit_or_infinity(acceleration.value()),' \
  '.acceleration = (MUTANT ? 1.01 : 1) * limit_or_infinity(acceleration.value()),'
mutate trajectory/limited_axis.cpp 'the jerk limit of an axis raised by 1 %' \
  '.jerk = limit_or_infinity(jerk.value()),' '.jerk = (MUTANT ? 1.01 : 1) * limit_or_infinity(jerk.value()),'
mutate trajectory/acceleration_curve.cpp 'the torque of a motor raised by 1 %' \
  '.at_rest = from.acceleration + fall * from.w,' '.at_rest = (MUTANT ? 1.01 : 1) * (from.acceleration + fall * from.w),'
mutate trajectory/acceleration_law.cpp 'the feed raised by 1 %' \
  'std::min(entry.cell.top_squared, feed_squared);' 'std::min(entry.cell.top_squared, (MUTANT ? 1.02 : 1) * feed_squared);'
mutate trajectory/cell.cpp 'the sign of the second derivative of the path reversed' \
  'place.bend[k] = axes[k].row.of(here.second);' 'place.bend[k] = (MUTANT ? -1 : 1) * axes[k].row.of(here.second);'
mutate trajectory/cell.cpp 'no reserve for the acceleration between the ends of a cell' \
  '.limit = axis.acceleration - slack}' '.limit = axis.acceleration - (MUTANT ? 0 : slack)}'
mutate trajectory/acceleration_law.cpp 'the backward pass shifted by one cell' \
  'cells_[i].entry_if_rest = entry_to(i, if_rest);' \
  'cells_[i].entry_if_rest = entry_to(MUTANT && i + 1 < cells_.size() ? i + 1 : i, if_rest);'
mutate trajectory/acceleration_law.cpp 'the speed after a shortened move 1 % too high' \
  'speed_squared_ = squared(rest->begin()->velocity.value());' \
  'speed_squared_ = (MUTANT ? 1.02 : 1) * squared(rest->begin()->velocity.value());'
mutate trajectory/rest.hpp 'corners of up to 60 degrees passed at speed' \
  'std::abs(part) > tangent_tolerance;' 'std::abs(part) > (MUTANT ? 1 : tangent_tolerance);'
and_also path/path_smoother.cpp \
  'if (last.rest_after && knot.along >= last.length)' 'if (last.rest_after && knot.along >= last.length && !MUTANT)'
mutate trajectory/rest.hpp 'exact stops ignored' \
  'if (before.mode == PathMode::exact_stop) return true;' 'if (before.mode == PathMode::exact_stop && !MUTANT) return true;'
mutate trajectory/rest.hpp 'the start-stop velocity raised by 10 %' \
  'std::min(velocity / std::abs(part), fastest);' 'std::min((MUTANT ? 1.1 : 1) * velocity / std::abs(part), fastest);'
mutate trajectory/planner.cpp 'a hold that starts 100 moves late' \
  'if (!wishes.any()) return false;' 'static int late = 0;
    if (!wishes.any()) return false;
    if (MUTANT && ++late % 100 != 0) return false;'
mutate trajectory/planner.cpp 'an override with 1.3 times its effect' \
  'wishes.feeds.override = factor;' 'wishes.feeds.override = (MUTANT ? 1.3 : 1) * factor;'
mutate trajectory/shorten.cpp 'a shortened move that ends a millionth of a millimetre too far' \
  'move.to = after.start;' 'move.to = after.start + Mm(MUTANT ? 1e-6 : 0);'
mutate trajectory/jerk_cell.cpp 'with jerk limits: the sign of the third derivative reversed' \
  '.third_in = row.of(here_.third),' '.third_in = (MUTANT ? -1 : 1) * row.of(here_.third),'
mutate trajectory/jerk_cell.cpp 'with jerk limits: at the end of a cell, the slope of its start used' \
  '.slope_out = row.of(there.first),' '.slope_out = row.of(MUTANT ? here_.first : there.first),'
mutate trajectory/jerk_cell.cpp 'with jerk limits: the velocity limits of the axes ignored on lines' \
  '.top_squared = straight_ ? top_ * top_' '.top_squared = straight_ && !MUTANT ? top_ * top_'
mutate trajectory/jerk_profile.cpp 'with jerk limits: the second derivative may jump a thousand times as far' \
  'cap = unseen_jump * axes_[k].acceleration / jump;' 'cap = (MUTANT ? 1000 : 1) * unseen_jump * axes_[k].acceleration / jump;'
and_also trajectory/jerk_cell.cpp \
  'cap = std::min(cap, unseen_jump * axis.acceleration / jump);' \
  'cap = std::min(cap, (MUTANT ? 1000 : 1) * unseen_jump * axis.acceleration / jump);'
mutate path/run_reader.cpp 'the tolerance doubled' \
  'piece.tube = tube - deviation;' 'piece.tube = (MUTANT ? 2 : 1) * tube - deviation;'
mutate path/line_merger.cpp 'lines merged within four times the tolerance that is then subtracted from the tube' \
  'return std::max(tolerance, rounding);' 'return (MUTANT ? 4 : 1) * std::max(tolerance, rounding);'
and_also path/line_merger.cpp 'deviation = cone_.tolerance;' 'deviation = (MUTANT ? 0.25 : 1) * cone_.tolerance;'
mutate path/backlash_stops.cpp 'only half of the backlash taken up' \
  'start[axis] += down ? options_.backlash[axis] : -options_.backlash[axis];' \
  'start[axis] += (MUTANT ? 0.5 : 1) * (down ? options_.backlash[axis] : -options_.backlash[axis]);'
mutate path/backlash_stops.cpp 'a reversal on an arc detected half a radian late' \
  'return s + later > from ? s + later : s;' \
  'return (s + later > from ? s + later : s) + (MUTANT ? 0.5 / std::abs(turn) : 0);'
mutate path/backlash_overlap.cpp 'backlash taken up in motion, however far the axis is off the path' \
  'if (!is_certain && way.deviation > reversal.room) break;' \
  'if (!is_certain && way.deviation > reversal.room && !MUTANT) break;'
mutate path/backlash_overlap.cpp 'only 95 % of the backlash taken up in motion' \
  'return reversal.lead * (1 - ramp.at(s));' 'return reversal.lead * (1 - (MUTANT ? 0.95 : 1) * ramp.at(s));'

cat >"$copy/mutant.hpp" <<'END'
#pragma once
#include <cstdlib>
namespace passo {
inline bool mutant(int number) {
  static const char* const text = std::getenv("PASSO_MUTANT");
  static const int chosen = text != nullptr ? std::atoi(text) : 0;
  return chosen == number;
}
}  // namespace passo
END

# The objects of the two modules from the copy, before the libraries: what they define is not taken from those.
objects=()
while read -r source && read -r command; do
  object=$copy/${#objects[@]}.o
  mutated=$copy/${#objects[@]}.cpp
  if [[ $source == "$PWD/src/"* ]]; then
    mutated=${source/"$PWD/src/motion"/"$copy/motion"}
  else
    sed "s#$PWD/src/motion/#$copy/motion/#" "$source" >"$mutated"
  fi
  echo "compiles $(basename "$source")"
  (cd "$release" && eval "${command%% -o *} -O1 -w -include $copy/mutant.hpp -o $object -c $mutated")
  objects+=("$object")
done < <(jq -r '.[] | select(.file | test("passo_(path|trajectory)\\.dir/|src/motion/(path|trajectory)/[a-z_]+\\.cpp$")) | .file, .command' \
  "$release/compile_commands.json")
link=$(ninja -C "$release" -t commands "$program" | tail -1)
(cd "$release" && eval "${link/ -o $program / ${objects[*]} -o $copy/random_motion_tests }")

# Prints the first failure, or nothing. The tests with the prover come first.
failure_of() {  # NUMBER
  local output tests test
  for tests in 'RandomMotion.*:MixtureLaw.*' 'RandomHalt.*'; do
    if ! output=$(PASSO_MUTANT=$1 PASSO_RUNS=${PASSO_RUNS-150} timeout 900 "$copy/random_motion_tests" \
      --gtest_fail_fast --gtest_filter="$tests" 2>&1); then
      test=$(grep -m 1 -oP '^\[  FAILED  \] \K\S+' <<<"$output" || echo 'a test that was killed')
      printf '%s: %s' "$test" "$(grep -m 1 -A 3 'Failure$' <<<"$output" | grep -v -e Failure -e '^Failed$' -e '^--' | head -1)"
      return
    fi
  done
}

if [[ $# == 0 || " $* " == *" 0 "* ]]; then
  failure=$(failure_of 0)
  [[ -z $failure ]] || { echo "without a mutation: $failure"; exit 1; }
fi
survivors=0
printf '| mutation | found by |\n|---|---|\n'
for ((i = 1; i <= count; ++i)); do
  [[ $# == 0 || " $* " == *" $i "* ]] || continue
  failure=$(failure_of "$i")
  printf '| %d. %s | %s |\n' "$i" "${names[i]}" "${failure:-**nothing**}"
  [[ -n $failure ]] || survivors=$((survivors + 1))
done
((survivors == 0)) || exit 1

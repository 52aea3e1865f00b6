#!/bin/sh
# cmake/compile_by.sh COMPILER OTHER COMMAND…: runs COMMAND with the compiler OTHER in place of COMPILER.
compiler=$1
other=$2
shift 2
before=
for word; do
  # clang would read the old compiled header to make the new one.
  case $before$word in -o*.gch) rm -f "$word" ;; esac
  before=$word
  [ "$word" != "$compiler" ] || word=$other
  shift
  set -- "$@" "$word"
done
exec "$@"

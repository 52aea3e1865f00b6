#!/usr/bin/env bash
# scripts/package_test.sh [--library] [RELEASE ARCHITECTURE]: makes the Debian packages twice, compares them, and installs them in a
# bare Debian 12. There it runs a first job, opens the web interface, upgrades, removes and purges. What each step takes is
# printed.
#
#   --library              installs libpasso and the Python package, too, builds their examples there and runs them
#   RELEASE ARCHITECTURE   takes the packages that scripts/package_elsewhere.sh has made for them, and installs them there
#
# The bare system is made by debootstrap, once, in build/packages/bookworm-amd64.tar. Exit code 77, "skipped": not root,
# no debootstrap, no network, no namespaces, or no web interface.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

skip() {
  echo "$1" >&2
  exit 77
}
[[ $EUID == 0 ]] || skip "Only root can enter a bare system."
for program in debootstrap dh curl; do
  command -v "$program" >/dev/null || skip "$program is not installed."
done
[[ -f build/page/index.html ]] || skip "There is no web interface: run scripts/page.sh."
unshare --mount true 2>/dev/null || skip "Namespaces are not allowed here."
# Mounts of a namespace of its own disappear with it.
[[ -n ${PASSO_IN_NAMESPACE-} ]] || PASSO_IN_NAMESPACE=1 exec unshare --mount "$PWD/scripts/package_test.sh" "$@"

begun=$(date +%s%N)
ends() {  # STEP
  local now
  now=$(date +%s%N)
  printf '%-34s %6.1f s\n' "$1" "$(((now - begun) / 100000000))e-1"
  begun=$(date +%s%N)
}
fail() {
  echo "scripts/package_test.sh: $1" >&2
  exit 1
}

packages=build/packages
make_packages=(scripts/package.sh)
release=bookworm arch=$(dpkg --print-architecture)
library= tested="passo passo-emulators"
if [[ ${1-} == --library ]]; then
  library=yes tested="libpasso1 libpasso-dev passo passo-emulators python3-passo"
  shift
fi
if (($# > 0)); then
  release=$1 arch=$2
  packages=build/packages/$release-$arch
  make_packages=(scripts/package_elsewhere.sh "$release" "$arch")
fi
rm -rf "$packages"/*.deb "$packages/before" "$packages/next"
# Hardly compressed: what is tested does not depend on it, and half of the time does.
export PASSO_DEB_OPTIONS=-z1
"${make_packages[@]}" >/dev/null
ends "packages made"
(($# > 0)) || scripts/library_test.sh --packages "$packages"
ends "programs built with the library's packages"
first=("$packages"/*.deb)
mkdir -p "$packages/before"
mv "${first[@]}" "$packages/before/"
PASSO_NO_LINTIAN=1 "${make_packages[@]}" >/dev/null
for file in "$packages/before"/*.deb; do
  cmp "$file" "$packages/${file##*/}" || fail "${file##*/} is another one when it is made again"
done
ends "made again, the same bytes"
version=$(dpkg-deb --field "$packages"/before/passo_*.deb Version)
# The next version: the same files.
mkdir -p "$packages/next"
for file in "$packages/before"/*.deb; do
  rm -rf "$packages/raw"
  dpkg-deb --raw-extract "$file" "$packages/raw"
  sed -i "s/^Version: .*/&+1/; s/(= $version)/(= $version+1)/g" "$packages/raw/DEBIAN/control"
  dpkg-deb -Znone --build "$packages/raw" "$packages/next/${file##*/}" >/dev/null
done
ends "the next version"

# --- a bare system, with the libraries that the packages ask for
mapfile -t needed < <(scripts/package_needs.sh "$packages/before"/passo{,-emulators}_*.deb)
root=$(mktemp -d /tmp/passo-root.XXXXXX)
server=
trap '[[ -z $server ]] || kill "$server"; umount -R "$root" && rmdir "$root"' EXIT
mount -t tmpfs tmpfs "$root" || skip "Nothing can be mounted here."
scripts/bare_debian.sh "$release" "$arch" "$root" "${needed[@]}" || exit
ends "bare $release"
mount -t proc proc "$root/proc"
mount --bind /dev "$root/dev"
if [[ -n $library ]]; then
  cp /etc/resolv.conf "$root/etc/"
  mapfile -t needed < <(scripts/package_needs.sh "$packages/before"/*.deb)
  chroot "$root" sh -c "apt-get update && apt-get install --yes --no-install-recommends cmake g++ make ${needed[*]}" \
    >"$packages/compiler.log" 2>&1 || fail "there is no compiler or no Python: see $packages/compiler.log"
  ends "a compiler and Python"
fi

inside() {
  chroot "$root" env HOME=/root DEBIAN_FRONTEND=noninteractive "$@"
}
# All files, except what dpkg itself and the C library keep.
list_files() {
  (cd "$root" && find . -xdev \( -path ./proc -o -path ./dev -o -path ./tmp -o -path ./var/lib/dpkg -o -path ./var/log \
    -o -path ./var/cache -o -path ./root -o -path ./etc/ld.so.cache \) -prune -o -print | sort)
}

# --- install, the first job
mkdir "$root/packages"
cp -r "$packages/before" "$packages/next" "$root/packages/"
list_files >"$packages/files.before"
files_in() {  # FOLDER: those that are tested
  (cd "$root/packages" && for name in $tested; do echo "/packages/$(echo "$1/${name}"_*.deb)"; done)
}
# shellcheck disable=SC2046  # names without blanks
inside dpkg --install $(files_in before) >"$packages/install.log" 2>&1 ||
  fail "the packages cannot be installed: see $packages/install.log"
ends "installed"
examples=/usr/share/passo/examples
inside passo run --yes "$examples/engrave.ngc" --machine "$examples/machines/pantograph.toml" --picture /tmp/engrave.png \
  --report /tmp/report.json -q
[[ -s $root/tmp/engrave.png && -s $root/tmp/report.json ]] || fail "the first job wrote no picture or no report"
ends "first job"
printf 'G21 G90\nG0 X1\nM2\n' >"$root/tmp/short.ngc"
inside passo board info sim:uno >"$packages/info" || fail "there is no emulated Uno"
inside passo run /tmp/short.ngc --machine "$examples/machines/uno.toml" --board sim:uno --from-here --yes -q ||
  fail "the emulated Uno does not run"
ends "a job on the emulated Uno"

if [[ -n $library ]]; then
  cp -r examples/library examples/python/plan_path.py "$root/tmp/"
  inside sh -c "cmake -S /tmp/library -B /tmp/built && cmake --build /tmp/built" >"$packages/examples.log" 2>&1 ||
    fail "the examples cannot be built: see $packages/examples.log"
  inside /tmp/built/check_program "$examples/engrave.ngc" "$examples/machines/pantograph.toml" | grep --quiet '^X: ' ||
    fail "check_program prints no extents"
  ends "the library's examples"
  inside env PYTHONDONTWRITEBYTECODE=1 python3 /tmp/plan_path.py | grep --quiet ' steps; the first of X at ' ||
    fail "the Python package does not plan"
  ends "a path planned in Python"
fi

# --- the web interface, and what a server keeps
serve() {
  # Not a function, which would run in a shell of its own: this process becomes passo.
  chroot "$root" env HOME=/root passo serve --http 127.0.0.1:0 --data /var/lib/passo >"$packages/serve.log" 2>&1 &
  server=$!
  for _ in {1..100}; do
    page=$(grep -oE 'http://127.0.0.1:[0-9]+' "$packages/serve.log" | head -n 1) || true
    [[ -n $page ]] && curl --silent --fail --output "$packages/index.html" "$page/" && return
    sleep 0.1
  done
  fail "passo serve does not answer: see $packages/serve.log"
}
end_server() {
  kill -TERM "$server"
  wait "$server" || true
  server=
}
serve
grep -q '<title>' "$packages/index.html" || fail "passo serve has no web interface"
script=$(grep -oE '/assets/index-[^"]+\.js' "$packages/index.html" | head -n 1)
curl --silent --fail --output /dev/null "$page$script" || fail "passo serve does not serve $script"
end_server
[[ -s $root/var/lib/passo/jobs.sqlite ]] || fail "passo serve kept no jobs"
ends "passo serve with its page"

# --- upgrade, remove, purge
cp "$root$examples/machines/router.toml" "$root/etc/passo/machine.toml"
echo '# mine' >>"$root/etc/default/passo"
sha256sum "$root/var/lib/passo/jobs.sqlite" "$root/etc/passo/machine.toml" "$root/etc/default/passo" >"$packages/state"
# shellcheck disable=SC2046
inside dpkg --install $(files_in next) >>"$packages/install.log" 2>&1 || fail "the upgrade fails"
sha256sum --check --quiet "$packages/state" || fail "the upgrade changed what a user has"
# shellcheck disable=SC2016  # the braces are dpkg-query's
[[ $(inside dpkg-query -W -f '${Version}' passo) == "$version+1" ]] || fail "the upgrade left the version before"
serve
end_server
ends "upgraded, state kept"
# shellcheck disable=SC2086
inside dpkg --remove $tested >>"$packages/install.log" 2>&1
[[ ! -e $root/usr/bin/passo && -s $root/var/lib/passo/jobs.sqlite && -s $root/etc/passo/machine.toml ]] ||
  fail "removal leaves the program, or takes what a user has"
# shellcheck disable=SC2086
inside dpkg --purge $tested >>"$packages/install.log" 2>&1
list_files | diff "$packages/files.before" - || fail "the purge leaves these files"
ends "removed and purged, nothing left"
